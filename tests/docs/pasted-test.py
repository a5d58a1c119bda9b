#!/usr/bin/env python3
"""pasted-test.py SOURCE PROGRAM: what README.md and the help have for pasting works when it is pasted, in the order in which it stands.

Runs in a folder that has of a clone what commands may name. A sweep is read, not run, and so is what needs its results; timed frames are few.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

source, program = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])


def readme_lines():
    for line in (source / "README.md").read_text().splitlines():
        if line.startswith("    tessera "):
            yield "README.md", line.split("   #")[0].strip()


def help_lines():
    top = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    commands = re.findall(r"^  ([a-z]+) {2,}", top.split("Commands:")[1].split("Options:")[0], re.M)
    assert len(commands) > 10, top
    texts = {"--help": top}
    for command in commands:
        texts[command] = subprocess.run([program, "help", command], capture_output=True, text=True, check=True).stdout
    for name, text in texts.items():
        for line in text.splitlines():
            if line.startswith("  tessera "):
                yield f"help {name}", line.strip()


def runnable(line):
    """The line as it is run here, or None."""
    words = line.split()
    if words[1] in ("sweep", "expand"):
        sweep = next(word for word in words if word.endswith(".toml"))
        changes = " ".join(re.findall(r"--quick|--rounds \S+|--devices \S+", line))
        return f"tessera expand {sweep} {changes} --no-estimate"
    if words[1] == "report":  # of what sweep would have made
        return None
    if words[1] == "completion":  # into folders of the user's
        return " ".join(words[:3])
    if words[1] == "man":
        return line.split("|")[0]
    if words[1] == "kernels" and "--prebuild" in words:
        return None
    if words[1] in ("render", "parity"):  # small, since what is looked at is the command line
        line = re.sub(r"--size \S+", "--size 64x48", line) if "--size" in words else line + " --size 64"
    return re.sub(r"level=\d", "level=2", re.sub(r"--repeat \d+", "--repeat 2", line))


def main():
    failed = []
    with tempfile.TemporaryDirectory() as folder:
        for name in ("experiments", "slang", "datasets", "tests"):
            os.symlink(source / name, f"{folder}/{name}")
        environment = dict(os.environ, PATH=f"{program.parent}:{os.environ['PATH']}", COLUMNS="100")
        seen, counts = set(), {}
        for place, line in [*readme_lines(), *help_lines()]:
            counts[place] = counts.get(place, 0) + 1
            command = runnable(line)
            if command is None or command in seen:
                continue
            seen.add(command)
            done = subprocess.run(
                ["bash", "-c", command], cwd=folder, env=environment, capture_output=True, text=True, timeout=300
            )
            if done.returncode != 0:
                failed.append(f"{place}: {line}\n  exit code {done.returncode}: {done.stderr.strip()}")
    assert counts.get("README.md", 0) > 10 and counts.get("help --help", 0) >= 3, counts
    print("\n".join(failed) if failed else f"{len(seen)} commands work as they stand")
    return bool(failed)


sys.exit(main())
