"""[[expect]] finds what does not hold, and nothing else."""
import json
from pathlib import Path
import subprocess
import sys
import tempfile
import unittest

REPORT = Path(__file__).parents[2] / "experiments" / "report"
sys.path.insert(0, str(REPORT))
from tessera_report import expect


def row(cell, tile, status="ok", mismatch=0, twin=False, scene="ball"):
  row = {"status": status, "message": "why", "scene": {"size": [8, 8]},
         "sweep": {"cell": cell, "twin": twin, "scene": scene, "device": "cpu", "asked": {"tile": tile}}}
  return row | ({"error": {"id_mismatch": mismatch}} if status == "ok" else {})


class Expect(unittest.TestCase):
  def check(self, toml, *rows):
    with tempfile.TemporaryDirectory() as folder:
      (Path(folder) / "sweep.toml").write_text(toml)
      (Path(folder) / "rows.jsonl").write_text("".join(json.dumps(row) + "\n" for row in rows))
      return expect.check(Path(folder))

  def test_what_holds(self):
    toml = '[[expect]]\nwhere = {tile = [8, 16]}\nstatus = "ok"\nerror.id_mismatch = 0\n'
    self.assertEqual(self.check(toml, row(0, "8"), row(1, "16"), row(2, "32", mismatch=5)), ([], 2))

  def test_numbers_and_comparisons(self):
    for wanted, value, holds in (("0", 0, True), ("0", 1, False), ('"> 0"', 1, True), ('"> 0"', 0, False),
                                 ('"<= 3"', 3, True), ('"< 3"', 3, False), ('">= 1e1"', 10, True)):
      lines, checked = self.check(f"[[expect]]\nerror.id_mismatch = {wanted}\n", row(0, "8", mismatch=value))
      self.assertEqual((not lines, checked), (holds, 1), f"{value} against {wanted}")

  def test_status(self):
    toml = '[[expect]]\nstatus = "ok"\n'
    lines, _ = self.check(toml, row(0, "8"), row(1, "16", status="timeout"))
    self.assertEqual(len(lines), 1)
    self.assertIn("tile=16: status is timeout, not ok: why", lines[0])
    self.assertEqual(self.check('[[expect]]\nstatus = ["ok", "timeout"]\nerror.id_mismatch = 0\n', row(0, "8", status="timeout"))[0], [])

  def test_text_for_the_terminal(self):
    """Names and messages of rows reach it on one line, with what it would obey written out."""
    with tempfile.TemporaryDirectory() as folder:
      (Path(folder) / "sweep.toml").write_text('[[expect]]\nstatus = "ok"\n')
      damaged = row(0, "8\x1b[31m", status="timeout", scene="a\nb") | {"message": "\x1b]0;title\x07"}
      (Path(folder) / "rows.jsonl").write_text(json.dumps(damaged) + "\n")
      result = subprocess.run([sys.executable, "-m", "tessera_report.expect", folder], cwd=REPORT, capture_output=True, text=True)
    self.assertEqual((result.returncode, result.stderr.count("\n"), result.stdout.count("\n")), (5, 1, 1))
    self.assertIn("a b 8x8 cpu, tile=8\\u001b[31m: status is timeout, not ok: \\u001b]0;title\\u0007\n", result.stderr)

  def test_what_is_not_there(self):
    self.assertIn("counters.pieces is not there", self.check("[[expect]]\ncounters.pieces = 1\n", row(0, "8"))[0][0])
    self.assertIn("chooses no cell", self.check('[[expect]]\nwhere = {tile = 64}\nstatus = "ok"\n', row(0, "8"))[0][0])

  def test_scenes_that_did_not_run_and_twins(self):
    self.assertEqual(self.check('[[expect]]\nscene = "field"\nerror.id_mismatch = 0\n', row(0, "8", mismatch=1)), ([], 0))
    self.assertEqual(self.check("[[expect]]\nerror.id_mismatch = 0\n", row(0, "8"), row(1, "8", mismatch=1, twin=True)), ([], 1))


if __name__ == "__main__":
  unittest.main()
