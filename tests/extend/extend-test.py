"""extend-test.py NAME BUILD SOURCE: adds a stage, a binning or a commit to a copy of the sources, by the files and the lines in the folder NAME
and no others, compiles what they change, and runs try-extended with it. The program that the build made has to fail without the addition."""
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile

name, build, source = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3]).resolve()
here = pathlib.Path(__file__).parent / name


def run(command, **options):
  return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)


def insert(tree, lines):
  for addition in lines:
    path = tree / addition["file"]
    text = path.read_text()
    if text.count(addition["before"]) != 1:
      sys.exit(f"{addition['file']}: {addition['before']!r} should be there once")
    path.write_text(text.replace(addition["before"], addition["line"] + addition["before"]))


def compile_changed(tree, changed):
  """Each as the build compiles it, with the copy in place of the sources; a new file as another one of its folder."""
  commands = {pathlib.Path(entry["directory"], entry["file"]).resolve(): entry
              for entry in json.loads((build / "compile_commands.json").read_text())}
  objects = []
  for file in changed:
    pattern = source / file if source / file in commands else next(p for p in commands if p.parent == (source / file).parent)
    entry = commands[pattern]
    made = tree / (file.name + ".o")
    words = shlex.split(entry["command"])
    at = words.index("-o")
    words[at + 1] = str(made)
    words[words.index("-c") + 1] = str(tree / file)
    folder = pathlib.Path(entry["directory"])
    for i, word in enumerate(words):
      if word.startswith("-I") and (folder / word[2:]).resolve().is_relative_to(source) and not (folder / word[2:]).resolve().is_relative_to(build):
        words[i] = "-I" + str(tree / (folder / word[2:]).resolve().relative_to(source))
    result = run(words, cwd=folder)
    if result.returncode != 0:
      sys.exit(f"{file}: {result.stdout}")
    objects.append(made)
  return objects


def link(tree, objects):
  """As the build links try-extended, with these objects before the library, whose own are then left out."""
  made = tree / "try-extended"
  line = run(["ninja", "-t", "commands", "tests/extend/try-extended"], cwd=build).stdout.strip().splitlines()[-1]
  words = shlex.split(line)
  if words[:2] == [":", "&&"]:
    words = words[2:]
  if "&&" in words:
    words = words[:words.index("&&")]
  at = words.index("-o")
  words[at + 1] = str(made)
  words[at:at] = map(str, objects)
  result = run(words, cwd=build)
  if result.returncode != 0:
    sys.exit(result.stdout)
  return made


with tempfile.TemporaryDirectory(prefix="tessera-extend-") as folder:
  tree = pathlib.Path(folder)
  for room in ("host", "slang", "datasets"):
    shutil.copytree(source / room, tree / room)
  lines = json.loads((here / "lines.json").read_text())
  insert(tree, lines)
  shutil.copytree(here / "new", tree, dirs_exist_ok=True)
  new = [path.relative_to(here / "new") for path in (here / "new").rglob("*.cpp")]
  changed = sorted({pathlib.Path(line["file"]) for line in lines} | set(new))
  program = link(tree, compile_changed(tree, changed))
  environment = os.environ | {"TESSERA_SLANG_SOURCES": str(tree / "slang")}
  with_it = run([program, name], env=environment)
  if with_it.returncode != 0 or with_it.stdout.count("right") != 2:
    sys.exit(f"with the {name}: {with_it.stdout}")
  without = run([build / "tests/extend/try-extended", name])
  if without.returncode != 1:
    sys.exit(f"without the {name}: exit code {without.returncode}: {without.stdout}")
  print(with_it.stdout, end="")
