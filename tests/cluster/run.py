"""experiments/Snakefile on a tiny sweep, here and through a stand-in for a batch system: the same cells as `tessera sweep`, never two jobs at once."""
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

mode, program, work = sys.argv[1], sys.argv[2], Path(sys.argv[3])
here = Path(__file__).parent
experiments = here.parents[1] / "experiments"
results = work / "results"
sweep = work / "sweep.toml"

# Two scenes are two jobs; the second commit errs, so that each job has pictures.
SWEEP = """title = "Tiny"
question = "Does merging lose anything?"
sizes = [64]
rounds = 2
[scenes]
ball = "generate:icosphere?level=2"
layers = "generate:soup?count=200&pixels=200"
[axes]
commit = ["tile-owned", "depth16+id16"]
"""


def check(right, what):
    if not right:
        sys.exit(f"cluster/{mode}: {what}")


def tessera(*arguments):
    subprocess.run([program, "sweep", str(sweep), *arguments], check=True, stdout=subprocess.DEVNULL)


def snakemake(*arguments, tessera=here / "watched"):
    command = [sys.executable, "-m", "snakemake", "--snakefile", experiments / "Snakefile", "--directory", results, "--config", f"sweep={sweep}",
               f"tessera={tessera}", "--printshellcmds", *arguments]
    return subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def succeed(run):
    check(run.returncode == 0, f"snakemake ended with {run.returncode}:\n{run.stdout}")


def rows(folder):
    """What two runs of a sweep have alike, by the cell's number; pictures by their bytes."""
    kept = {}
    for line in open(folder / "rows.jsonl"):
        row = json.loads(line)
        row["time_ns"] = {name: row["time_ns"][name] for name in ("rounds", "clock")}
        for name in ("run_id", "memory"):
            row.pop(name, None)
        row["provenance"].pop("utc")
        if "picture" in row:
            row["picture"] = (folder / row["picture"]).read_bytes()
        check(row["sweep"]["cell"] not in kept, f"cell {row['sweep']['cell']} is there twice")
        kept[row["sweep"]["cell"]] = row
    return kept


def same_as_a_plain_sweep():
    tessera("--out", str(work / "plain"))
    plain, merged = rows(work / "plain"), rows(results)
    check(len(plain) == 6, f"{len(plain)} cells, not 6")
    check(sum("picture" in row for row in plain.values()) == 2, "not two cells with a picture")
    check(plain == merged, f"rows differ: {plain}\n{merged}")
    check((results / "sweep.toml").read_text() == SWEEP, "sweep.toml is not the sweep")


def one_at_a_time(count):
    spans = sorted(tuple(int(word) for word in line.split()) for line in open(work / "times"))
    check(len(spans) == count, f"{len(spans)} sweeps ran, not {count}")
    for (_, end), (begin, _) in zip(spans, spans[1:]):
        check(end <= begin, f"two sweeps at once: one ended {end - begin} ns after the next began")


def local():
    # A job that was stopped: its journal is there, its rows are not.
    stopped = results / "jobs" / "ball@cpu"
    tessera("--out", str(stopped), "--job", "ball@cpu")
    (stopped / "rows.jsonl").unlink()
    journal = (stopped / "journal.jsonl").read_text()
    succeed(snakemake("--profile", experiments / "cluster/local"))
    check((stopped / "journal.jsonl").read_text().startswith(journal), "a job with a journal began anew")
    one_at_a_time(2)
    check("Tiny" in (results / "report/index.html").read_text(), "no report")

    # Another sweep in the same folder: refused before anything is removed.
    before = (results / "rows.jsonl").read_bytes()
    sweep.write_text(SWEEP.replace("rounds = 2", "rounds = 3"))
    run = snakemake("--profile", experiments / "cluster/local")
    check(run.returncode != 0 and "of another sweep than" in run.stdout, f"another sweep was not refused:\n{run.stdout}")
    check((results / "rows.jsonl").read_bytes() == before, "rows were touched")


def generic():
    submit = ["--cluster-generic-submit-cmd", here / "submit", "--cluster-generic-status-cmd", here / "status", "--cluster-generic-cancel-cmd", "true"]
    succeed(snakemake("--profile", experiments / "cluster/cluster-generic", *submit, "--set-threads", "job=1", "--seconds-between-status-checks", "1",
                      "--latency-wait", "5", "--until", "merge"))
    check(len(list(work.glob("job.*"))) == 2, "not two jobs were submitted")
    one_at_a_time(2)
    same_as_a_plain_sweep()


def profiles():
    """Each is read, and plans the same jobs; what a real cluster makes of it is not tried here."""
    for profile in sorted((experiments / "cluster").glob("*/config.yaml")):
        run = snakemake("--dry-run", "--profile", profile.parent, tessera=program)
        check(run.returncode == 0 and "--job layers@cpu --resume" in run.stdout.replace("'", ""), f"{profile}:\n{run.stdout}")


shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)
sweep.write_text(SWEEP)
os.environ.update(STAND_IN=str(work), TESSERA=program)
{"local": local, "generic": generic, "profiles": profiles}[mode]()
