"""papers/tiles-bins-cells: its numbers come from rows, whatever the rows say, and the same rows give the same bytes."""
import importlib
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAPER = ROOT / "papers" / "tiles-bins-cells"
sys.path[:0] = [str(PAPER), str(Path(__file__).parent)]
import crossovers  # noqa: E402
import sample  # noqa: E402

typed_numbers = importlib.import_module("typed-numbers")


class TilesBinsCells(unittest.TestCase):
  def setUp(self):
    self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

  def run_(self, program, *arguments):
    return subprocess.run([sys.executable, program, *map(str, arguments)], capture_output=True, text=True)

  def build(self, name, folders):
    """The PDF; nothing may be said on the way, such as of a font or a figure that is not there."""
    out = self.folder / name
    out.mkdir()
    for result in (self.run_(PAPER / "values.py", out, *folders),
                   self.run_(ROOT / "papers/typeset.py", PAPER / "main.typ", out, out / "main.pdf")):
      self.assertEqual((result.returncode, result.stderr), (0, ""))
    return (out / "main.pdf").read_bytes()

  def test_no_number_is_typed(self):
    text = (PAPER / "main.typ").read_text(encoding="utf-8")
    self.assertEqual(typed_numbers.find(text), [])
    # It would have been seen in each of these places.
    for planted in ("It takes 1.5 ms.", "#if tile.dirty [up to 7] else [none]", '#code("tile=64")', "#table(columns: 2, [a], [12])",
                    "#let n(q) = [#q.text~#q.unit and 3 more]", "#word(1.5)", "#figure([x], caption: [Of 52 cells.])"):
      self.assertNotEqual(typed_numbers.find(text + "\n" + planted + "\n"), [], planted)
    for harmless in ("@pineda1988 and <table-1>", "#v(0.5em)", "#tile.places.at(0).name", "`a 1`", "// 12"):
      self.assertEqual(typed_numbers.find(harmless), [], harmless)

  def test_builds_are_equal(self):
    folders = sample.write(self.folder)
    first = self.build("a", folders)
    self.assertEqual(first[:5], b"%PDF-")
    self.assertTrue(first == self.build("b", folders), "two builds differ")
    other = sample.write(self.folder / "other", lambda asked, area: 2 * sample.slowness(asked, area))
    self.assertFalse(first == self.build("c", other), "other times give the same pages")

  def test_other_outcomes_build(self):
    """Sentences for what did not happen in the sample: nothing differs, nothing is lost, cells without a time, one scene."""
    def change(row):
      row["counters"]["retries"] = row["counters"]["overflowed"] = 0
      row["error"] |= {"coverage_mismatch": 0, "id_mismatch": 0, "depth_mismatch": 0}
      row.pop("error_samples", None)
      if row["sweep"]["asked"].get("tile") == "8" or row["sweep"]["asked"].get("capacity") == "16":
        row |= {"status": "timeout", "message": "a frame took longer than 60 s"}
        del row["time_ns"]
      return row if row["sweep"]["scene"] in ("elephant", "area-8", "area-32") else None

    self.build("equal", sample.write(self.folder, lambda asked, area: 1, change))

  def test_crossings_are_interpolated(self):
    def points(areas, where=1000, floor=1.02):
      ratios = [(area / where) ** -0.05 for area in areas]
      return [(area, ratio, max(ratio, 1 / ratio) <= floor) for area, ratio in zip(areas, ratios)]

    (where, low, high, below), = crossovers.crossings(points([1, 10, 900, 1300, 1e5]))
    self.assertAlmostEqual(where, 1000)
    self.assertEqual((low, high, below), (10, 1e5, True))
    self.assertEqual(crossovers.crossings(points([1, 10, 900, 1300])), [], "what noise may have done is no crossing")
    self.assertEqual(crossovers.crossings(points([1e4, 1e5, 1e6])), [])
    self.assertEqual(crossovers.runs([["a", "b"], ["b"], ["b", "c"], ["c"]]), [(["b"], 0, 2), (["c"], 3, 3)])

  def test_what_is_wrong_is_said_in_one_line(self):
    folders = sample.write(self.folder)
    (self.folder / "out").mkdir()

    def refused(message):
      result = self.run_(PAPER / "values.py", self.folder / "out", *folders)
      self.assertEqual((result.returncode, result.stderr.count("\n")), (2, 1), result.stderr)
      self.assertIn(message, result.stderr)

    rows = (folders[0] / "rows.jsonl").read_text()
    (folders[0] / "rows.jsonl").write_text(rows + rows.splitlines()[0].replace('"cpu": "AMD EPYC"', '"cpu": "Another"'))
    refused("several values of machine")
    (folders[0] / "rows.jsonl").write_text(rows.replace('"twin": true', '"twin": false'))
    refused("no time of the reference and its twin")
    (folders[0] / "rows.jsonl").write_text(rows.replace("AMD EPYC", "Another"))
    refused("not of one machine")

    # A clone in which nothing has been built or measured.
    bare = self.folder / "clone/papers/tiles-bins-cells"
    bare.mkdir(parents=True)
    shutil.copy(PAPER / "reproduce.sh", bare)

    def says(message, *arguments):
      result = subprocess.run([bare / "reproduce.sh", *arguments], capture_output=True, text=True)
      self.assertNotEqual(result.returncode, 0)
      self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
      self.assertIn(message, result.stderr)

    says("usage", "--new")
    says("./dev build installs it")
    os.makedirs(self.folder / "clone/.tools/report")
    (self.folder / "clone/.tools/report/pinned").touch()
    says("results.jsonl: not there; --fresh runs the sweep")
    says("./dev build builds it", "--fresh")

  def test_committed_page_is_that_of_the_committed_rows(self):
    rows = [ROOT / "experiments" / name / "results.jsonl" for name in sample.SWEEPS]
    page = PAPER / "main.pdf"
    if not all(path.exists() for path in rows):
      self.assertFalse(page.exists(), f"{page} has no rows that it comes from")
      return
    folders = []
    for name, path in zip(sample.SWEEPS, rows):
      folders.append(self.folder / name)
      folders[-1].mkdir()
      shutil.copy(path, folders[-1] / "rows.jsonl")
      shutil.copy(path.with_name("sweep.toml"), folders[-1])
    self.assertTrue(page.exists() and self.build("page", folders) == page.read_bytes(),
                    f"{page} is not what the rows give now; reproduce.sh beside it makes it")


if __name__ == "__main__":
  unittest.main()
