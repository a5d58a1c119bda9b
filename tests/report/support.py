"""What the tests of the report share: the modules under test, made-up rows, and the command."""

import os
from pathlib import Path
import subprocess
import sys

kSource = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(kSource / "experiments" / "report"))
sys.path.insert(0, str(Path(__file__).parent))

import rows
import sample

kSchema = sample.kSchema


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


def read(folder, allDevices=False):
  return rows.readSweep(Path(folder), kSchema, allDevices)


def tessera(*arguments, **environment):
  """Runs the command that TESSERA names, with output as text."""
  return subprocess.run(
    [os.environ["TESSERA"], *map(str, arguments)],
    capture_output=True,
    text=True,
    env=os.environ | environment,
    timeout=100,
  )
