"""experiments/variants takes every value of its axes: variants-test.py TESSERA. A value that is added to the list of axes is asked for here."""
import json
from pathlib import Path
import subprocess
import sys
import tomllib
import unittest

SWEEP = Path(__file__).parents[2] / "experiments" / "variants" / "sweep.toml"
TESSERA = sys.argv.pop()


def run(*words):
  result = subprocess.run([TESSERA, *words], capture_output=True, text=True)
  return json.loads(result.stdout) if result.returncode == 0 else None


class Variants(unittest.TestCase):
  def setUp(self):
    self.sweep = tomllib.loads(SWEEP.read_text(encoding="utf-8"))
    self.values = {axis["name"]: [value["name"] for value in axis.get("values", [])] for axis in run("variants", "--json")}

  def test_each_pair_of_binning_and_traversal(self):
    for axis in ("binning", "traversal"):
      self.assertEqual(set(self.values[axis]), set(self.sweep["axes"][axis]), f"{SWEEP}: axes.{axis}")

  def test_each_commit_with_each_way_of_binning_that_a_commit_gets(self):
    chosen = set()
    for commit in self.values["commit"]:
      plan = run("plan", "generate:layers?count=2", "--json", "--set", f"commit={commit}")
      chosen.add(plan["variant"]["binning"])
    self.assertEqual(len(chosen), 2, chosen)
    wanted = {(commit, binning) for commit in self.values["commit"] for binning in chosen}
    self.assertEqual({(cell["commit"], cell["binning"]) for cell in self.sweep["also"]}, wanted, f"{SWEEP}: also")


if __name__ == "__main__":
  unittest.main()
