"""What the tests of the report share: the modules under test, made-up rows, and the command."""

import os
from pathlib import Path
import resource
import subprocess
import sys

SOURCE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "experiments" / "report"))
sys.path.insert(0, str(Path(__file__).parent))

from tessera_report import rows
import sample

SCHEMA = sample.SCHEMA


def only(**wanted):
  """Rows of these scenes, sizes or devices alone: `change` of sample.write."""

  def change(row):
    have = {
      "scene": row["sweep"]["scene"],
      "edge": row["scene"]["size"][0],
      "device": row["sweep"]["device"],
      "cpu": row["provenance"]["cpu"],
    }
    return row if all(have[name] == value for name, value in wanted.items()) else None

  return change


def read(folder, all_devices=False):
  return rows.read_sweep(Path(folder), SCHEMA, all_devices)


def tessera(*arguments, largest_file=None, stdout=subprocess.PIPE, folder=None, **environment):
  """Runs the command that TESSERA names, in `folder`, with output as text. A limit on the size of a file, bytes, stands for a full disk."""

  def limit():
    if largest_file is not None:
      resource.setrlimit(resource.RLIMIT_FSIZE, (largest_file, largest_file))

  return subprocess.run(
    [os.environ["TESSERA"], *map(str, arguments)],
    stdout=stdout,
    stderr=subprocess.PIPE,
    text=True,
    env=os.environ | environment,
    timeout=100,
    cwd=folder,
    preexec_fn=limit,
  )
