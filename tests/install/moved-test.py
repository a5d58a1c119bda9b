"""The installed command alone: its prefix moved to a folder with a blank in its name, read-only, run through a link in PATH by a user without a home,
and the clone hidden where this machine lets us (a mount in a namespace of our own)."""

import json
import os
from pathlib import Path
import shutil
import stat
import subprocess
import sys
import tempfile

build, clone = Path(sys.argv[1]), Path(sys.argv[2])
work = Path(tempfile.mkdtemp(prefix="tessera-moved-"))
work.chmod(0o755)
prefix = work / "moved here"


def check(right, what):
  if not right:
    sys.exit(f"install/moved: {what}")


def hiding():
  """A command before others that hides the clone and what .tools leads to, and gives up being root; [] where that is not allowed."""
  folders, tools = [clone.resolve()], (clone / ".tools").resolve()
  if not tools.is_relative_to(folders[0]):  # where it is a link
    folders.append(tools)
  mounts = " && ".join(f"mount -t tmpfs none '{folder}'" for folder in folders)
  # nobody may read the prefix and write the work folder's own places
  leave = "exec setpriv --reuid=65534 --regid=65534 --clear-groups " if os.geteuid() == 0 else "exec "
  before = ["unshare", *([] if os.geteuid() == 0 else ["--user", "--map-root-user"]), "--mount", "sh", "-c", f'{mounts} && {leave}"$@"', "sh"]
  return before if subprocess.run([*before, "true"], capture_output=True).returncode == 0 else []


def install_it(before):
  made = work / "made"
  subprocess.run(["cmake", "--install", str(build), "--prefix", str(made)], check=True, stdout=subprocess.DEVNULL)
  made.rename(prefix)
  for folder, _, files in os.walk(prefix):
    for path in [folder, *(os.path.join(folder, file) for file in files)]:
      if not os.path.islink(path):
        os.chmod(path, stat.S_IMODE(os.stat(path).st_mode) & ~0o222)
  (work / "bin").mkdir()
  (work / "bin/tessera").symlink_to(prefix / "bin/tessera")
  desk = work / "desk"
  desk.mkdir()
  (work / "tmp").mkdir()
  (work / "tmp").chmod(0o1777)
  # Kernels that are compiled already, so that only what is tried below has to be.
  if (build / "kernel-cache").is_dir():
    shutil.copytree(build / "kernel-cache", work / "cache", ignore=shutil.ignore_patterns("*.tmp", "replays"))
  (work / "cache").mkdir(exist_ok=True)
  if before and os.geteuid() == 0:  # commands run as nobody then
    for folder in [desk, work / "cache"]:
      for path in [folder, *folder.rglob("*")]:
        os.chown(path, 65534, 65534)


class Desk:
  def __init__(self, before):
    self.before = before
    if not self.before:
      print("install/moved: no namespaces here, so the clone is not hidden")
    self.environment = {"PATH": f"{work / 'bin'}:/usr/bin:/bin", "TESSERA_CACHE": str(work / "cache"), "TMPDIR": str(work / "tmp")}

  def run(self, *words, code=0, **environment):
    done = subprocess.run([*self.before, "tessera", *words], cwd=work / "desk", env=self.environment | environment, capture_output=True, text=True)
    check(done.returncode == code, f"{' '.join(words)}: exit code {done.returncode}, not {code}\n{done.stdout}{done.stderr}")
    check(str(clone) not in done.stdout + done.stderr, f"{' '.join(words)} names the clone:\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr

  def has(self, name):
    return (work / "desk" / name).exists()

  def write(self, name, text):
    (work / "desk" / name).write_text(text)


SWEEP = """title = "Tiny"
question = "Does it run?"
sizes = [32]
rounds = 2
[scenes]
grid = "generate:grid"
[axes]
commit = ["tile-owned", "two-pass"]
"""


def try_all(desk):
  check("tessera " in desk.run("--version"), "no version")
  slangc = prefix / "lib/tessera/slang/bin/slangc"
  for device in ["cpu", "vulkan"]:
    said = desk.run("render", "generate:icosphere?level=2", "--size", "64x64", "--device", device, "-o", f"{device}.exr", "-o", f"{device}.png")
    check(desk.has(f"{device}.png"), said)
  desk.run("compare", "cpu.exr", "vulkan.exr")
  # A kernel of one's own is compiled now: slangc, the sources and the C++ compiler are found.
  source = (prefix / "share/tessera/slang/stages/transform.slang").read_text()
  desk.write("mine.slang", source + f"// {work}\n")
  desk.run("render", "generate:grid", "--size", "32x32", "-o", "own.png", "--kernel", "transform=mine.slang")
  desk.run("kernels", "--emit", "wgsl", "emitted")
  check(desk.has("emitted/raster-tiles.wgsl"), "nothing emitted")
  desk.write("sweep.toml", SWEEP)
  desk.run("expand", "sweep.toml", "--no-estimate")
  desk.run("sweep", "sweep.toml", "--out", "results")
  desk.run("report", "results", "--export", "rows.parquet")
  check(desk.has("results/report/index.html") and desk.has("rows.parquet"), "no report")
  rows = (work / "desk/results/rows.jsonl").read_text().splitlines()
  check(all(json.loads(row)["status"] == "ok" for row in rows), "\n".join(rows))


def try_missing(desk):
  """What is not there is said in one line, with what would do."""

  def says(words, *parts, code=2, **environment):
    said = desk.run(*words, code=code, **environment)
    lines = [line for line in said.splitlines() if line.startswith("tessera: ")]  # the others are progress
    check(len(lines) == 1 and all(part in lines[0] for part in parts), f"{' '.join(words)}: {said}")

  render = ["render", "generate:grid", "--size", "32x32", "-o", "none.png", "--kernel", "transform=mine.slang"]
  says(render, "TESSERA_CXX=/nonexistent", TESSERA_CXX="/nonexistent")
  prefix.chmod(0o755)
  for folder in ["lib/tessera", "lib/tessera/slang", "lib/tessera/python/bin"]:
    (prefix / folder).chmod(0o755)
  (prefix / "lib/tessera/slang").rename(work / "slang-gone")
  says(["kernels", "--emit", "wgsl", "none"], "no slangc", "SLANGC")
  (prefix / "lib/tessera/python/bin/python").unlink()
  says(["report", "results"], "python3.11 -m venv ", f"{prefix}/share/tessera/report.txt", "TESSERA_PYTHON", code=1)


try:
  before = hiding()
  install_it(before)
  desk = Desk(before)
  try_all(desk)
  try_missing(desk)
  print("install/moved: all of it ran" + (", the clone hidden" if desk.before else ""))
finally:
  subprocess.run(["chmod", "-R", "u+w", str(work)])
  shutil.rmtree(work, ignore_errors=True)
