#!/usr/bin/env python3
"""pasted-test.py SOURCE PROGRAM: what README.md and the help have for pasting works when it is pasted, in the order in which it stands.

README.md and each command's help are a folder each, which has of a clone what commands may name and nothing else: a file that
a line reads is one that a line before it made. Scenes are small and timed frames are few, since what is looked at is the command
line. A sweep is read, and the rows that its experiment has on record stand for those that it would make.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

source, program = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
OF_A_CLONE = ("experiments", "slang", "datasets", "tests", "host")
AT_HOME = (".local/share/bash-completion/completions", ".zfunc", ".config/fish/completions")  # what completion asks for
SMALL_MESH = "mesh:cube"
SECONDS = 300  # for one command, its kernels compiled, on a machine that does other work


def said(*arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=True).stdout


def pages():
    """The lines of each page that are commands, by the page's name."""
    readme = (source / "README.md").read_text().splitlines()
    found = {"README.md": [line.split("   #")[0].strip() for line in readme if line.startswith("    tessera ")]}
    top = said("--help")
    commands = re.findall(r"^  ([a-z]+) {2,}", top.split("Commands:")[1].split("Options:")[0], re.M)
    assert len(commands) > 10, top
    for name, text in [("--help", top), *((command, said("help", command)) for command in commands)]:
        found[f"help {name}"] = [line.strip() for line in text.splitlines() if line.startswith("  tessera ")]
    return found


def value_of(words, option):
    return words[words.index(option) + 1] if option in words else None


def small(line):
    """The same command line with less to render."""
    if line.split()[1] in ("render", "parity"):
        line = re.sub(r"--size \S+", "--size 64x48", line) if "--size" in line else line + " --size 64"
    return re.sub(r"mesh:\w+", SMALL_MESH, re.sub(r"level=\d", "level=2", re.sub(r"--repeat \d+", "--repeat 2", line)))


def instead_of_sweep(line, folder):
    """Reads the sweep, and leaves in its results' folder what is on record."""
    words = line.split()
    sweep = next(word for word in words if word.endswith(".toml"))
    changes = " ".join(re.findall(r"--quick|--rounds \S+|--devices \S+", line))
    if out := value_of(words, "--out"):
        results = folder / out
        results.mkdir(parents=True, exist_ok=True)
        shutil.copy(folder / sweep, results / "sweep.toml")
        shutil.copy((folder / sweep).parent / "results.jsonl", results / "rows.jsonl")
    command = f"tessera expand {sweep} {changes} --no-estimate"
    if job := value_of(words, "--job"):
        jobs = json.loads(subprocess.run([program, *command.split()[1:], "--json"], cwd=folder, capture_output=True, check=True).stdout)
        assert job in [each["name"] for each in jobs["jobs"]], line
    return command


def runnable(line, folder):
    words = line.split()
    if words[1] in ("sweep", "expand"):
        return instead_of_sweep(line, folder)
    if words[1] == "man" and not shutil.which("man"):
        return line.split("|")[0]
    return small(line)


def main():
    failed, ran = [], 0
    for mesh in set(re.findall(r"mesh:\w+", "\n".join(line for lines in pages().values() for line in lines))):
        if mesh not in said("meshes").split():
            failed.append(f"{mesh}: not among 'tessera meshes'")
    for place, lines in pages().items():
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for part in OF_A_CLONE:
                os.symlink(source / part, folder / part)
            for part in AT_HOME:
                (folder / "home" / part).mkdir(parents=True)
            environment = dict(os.environ, PATH=f"{program.parent}:{os.environ['PATH']}", COLUMNS="100", HOME=f"{folder}/home")
            for line in lines:
                command, begun = runnable(line, folder), time.monotonic()
                try:
                    done = subprocess.run(
                        ["bash", "-c", command], cwd=folder, env=environment, capture_output=True, timeout=SECONDS
                    )
                    problem = done.returncode and f"exit code {done.returncode}: {done.stderr.decode(errors='replace').strip()}"
                except subprocess.TimeoutExpired:
                    problem = f"did not end in {SECONDS} s"
                print(f"{time.monotonic() - begun:6.1f} s  {place}: {command}", flush=True)
                ran += 1
                if problem:
                    failed.append(f"{place}: {line}\n  {problem}")
    assert ran > 40, ran
    print("\n".join(failed) if failed else f"{ran} commands work as they stand")
    return bool(failed)


sys.exit(main())
