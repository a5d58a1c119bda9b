"""What `tessera report` writes, and what it says to folders that are not as they should be. TESSERA names it."""

import hashlib
import json
import resource
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import support
import duckdb
from tessera_report import export, files
import sample
from support import only, tessera


class Command(unittest.TestCase):
  def setUp(self):
    self.temporary = tempfile.TemporaryDirectory()
    self.folder = Path(self.temporary.name) / "results"

  def tearDown(self):
    self.temporary.cleanup()

  def refused(self, result, code, *parts):
    """One line on stderr that has these parts, and no report."""
    self.assertEqual(result.returncode, code, result.stderr)
    self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
    self.assertTrue(result.stderr.startswith("tessera: "), result.stderr)
    for part in parts:
      self.assertIn(part, result.stderr)
    self.assertEqual(result.stdout, "")
    self.assertFalse((self.folder / "report").exists())

  def test_nothing_to_report(self):
    self.refused(tessera("report", self.folder), 2, "results: not a folder", "tessera sweep")
    self.folder.mkdir()
    self.refused(tessera("report", self.folder), 2, "neither rows.jsonl, journal.jsonl nor results.jsonl", "tessera sweep")
    (self.folder / "rows.jsonl").write_text("\n")
    self.refused(tessera("report", self.folder), 2, "rows.jsonl: no rows")

  def test_rows_that_are_none(self):
    rows = sample.write(self.folder, only(scene="ball", edge=256, device="cpu")) / "rows.jsonl"
    lines = rows.read_text().splitlines(keepends=True)

    def refused_with(line, *parts):
      rows.write_text("".join(lines[:2]) + line + "".join(lines[2:]))
      self.refused(tessera("report", self.folder), 2, "rows.jsonl:3: ", *parts)

    row = json.loads(lines[2])
    refused_with(lines[2][:80] + "\n", "not a line of JSON")
    refused_with("[1]\n", "not a row")
    refused_with(json.dumps(row | {"schema_version": 1}) + "\n", "schema version 1", f"reads versions 2 to {support.SCHEMA}")
    refused_with(json.dumps({key: value for key, value in row.items() if key != "sweep"}) + "\n", "sweep: missing")
    refused_with(
      json.dumps(row | {"sweep": row["sweep"] | {"sha256": "f" * 64, "title": "Other"}}) + "\n",
      'another sweep, "Other"',
      "than line 1",
    )
    refused_with(json.dumps(row | {"sweep": row["sweep"] | {"quick": True}}) + "\n", "--quick", "line 1")
    rows.write_text("".join(lines + lines[:1]))
    self.refused(
      tessera("report", self.folder), 2, f"rows.jsonl:{len(lines) + 1}: cell 0 of the same machine is in line 1"
    )

  def test_sweep_files_of_other_rows(self):
    write = lambda toml: sample.write(self.folder, only(scene="ball", edge=256, device="cpu"), toml)
    write(sample.TOML.replace('title = "Sample"', 'title = "Other"'))
    self.refused(tessera("report", self.folder), 2, "sweep.toml: title", '"Other"', '"Sample"')
    write(sample.TOML.replace('against = ["tile"', 'against = ["commit"'))
    self.refused(tessera("report", self.folder), 2, 'sweep.toml: plot.against: "commit"', "tile, binning, edge")
    write(sample.TOML.replace('"ratio-against-tile"', '"against-commit"'))
    self.refused(tessera("report", self.folder), 2, 'sweep.toml: plot.figure: "against-commit"', "against-tile")
    write("title = ")
    self.refused(tessera("report", self.folder), 2, "sweep.toml: not TOML")

  def test_places_that_do_not_do(self):
    sample.write(self.folder, only(scene="ball", edge=256, device="cpu"))
    self.refused(tessera("report", self.folder, "--export", "rows.csv"), 2, "rows.csv", ".parquet or .duckdb")
    self.refused(tessera("report", self.folder, "--export", "/nowhere/rows.parquet"), 2, "/nowhere/rows.parquet")
    self.refused(
      tessera("report", self.folder, TESSERA_PYTHON="/nowhere/python"), 1, "/nowhere/python", "TESSERA_PYTHON"
    )
    self.refused(
      tessera("report", self.folder, TESSERA_PYTHON="/usr/bin/python3"),
      1,
      "/usr/bin/python3 has no",
      "./dev build",
    )

  def test_the_same_rows_give_the_same_files_and_an_export(self):
    one = (
      "\n".join(line for line in sample.TOML.splitlines() if not line.startswith("against")) + '\nagainst = ["tile"]\n'
    )
    files = []
    for name, zone in (("rows.parquet", "UTC"), ("rows.duckdb", "Asia/Tokyo")):
      folder = sample.write(self.folder.with_name(name + ".results"), only(edge=512, scene="ball", device="cpu"), one)
      result = tessera("report", folder, "--export", folder / name, TZ=zone)
      self.assertEqual((result.returncode, result.stderr), (0, ""))
      self.assertIn(f"wrote {folder / name}", result.stdout)
      self.check_export(folder, folder / name)
      files.append(
        {
          str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
          for path in sorted((folder / "report").rglob("*"))
          if path.is_file()
        }
      )
    self.assertEqual(*files)
    for name in (
      "figure",
      "work-precision",
      "against-tile",
      "ratio-against-tile",
      "error-against-tile",
      "heat-tile-binning",
      "stages",
    ):
      for kind in ("svg", "pdf", "png"):
        self.assertIn(f"report/figures/{name}.{kind}", files[0])
    figures = folder / "report" / "figures"
    self.assertEqual((figures / "figure.svg").read_bytes(), (figures / "ratio-against-tile.svg").read_bytes())

  def test_a_figure_that_cannot_be(self):
    """Nothing but a software driver's times: the page is made, and a line says why the experiment's figure is not."""
    sample.write(self.folder, only(scene="ball", edge=256, device="vulkan"))
    result = tessera("report", self.folder)
    self.assertEqual(result.returncode, 0, result.stderr)
    self.assertRegex(result.stderr, r"^tessera: .*no figures/figure.svg: ratio-against-tile: .*\n$")
    self.assertFalse((self.folder / "report" / "figures" / "figure.svg").exists())
    self.assertTrue((self.folder / "report" / "index.html").exists())

  def test_rows_on_record(self):
    """An experiment's own folder stays as it is: its report goes below the working folder, or where --out says."""
    experiment = support.SOURCE / "experiments" / "languages"
    state = lambda: {path: (path.stat().st_mtime_ns, path.stat().st_size) for path in [experiment, *experiment.rglob("*")]}
    before, work = state(), Path(self.temporary.name) / "work"
    work.mkdir()
    for more, report in (((), "out/report/languages"), (("--out", "elsewhere"), "elsewhere")):
      result = tessera("report", experiment, *more, folder=work)
      self.assertEqual((result.returncode, result.stderr), (0, ""))
      self.assertIn(f"wrote {report}/index.html", result.stdout)
      rows = [json.loads(line) for line in (experiment / "results.jsonl").read_text().splitlines()]
      page = (work / report / "index.html").read_text()
      self.assertIn(rows[0]["sweep"]["question"], page)
      self.assertEqual(page.count('<td class="command">'), len(rows))
      self.assertEqual(state(), before)
    self.assertEqual(sorted(path.name for path in work.iterdir()), ["elsewhere", "out"])

  def test_a_disk_that_is_full(self):
    """One line with the name that was asked for and the cause; what stood there stays, and nothing lies beside it."""
    sample.write(self.folder, only(scene="ball", edge=256, device="cpu"))
    (self.folder / "pictures").mkdir(exist_ok=True)
    before = sorted(self.folder.rglob("*"))
    full = lambda size, *more: tessera("report", self.folder, *more, largest_file=size)
    self.refused(full(4096), 1, f"tessera: {self.folder}/report: could not be written: File too large\n")
    self.assertEqual(sorted(self.folder.rglob("*")), before)

    out = Path(self.temporary.name) / "out"
    connect, unlimited = duckdb.connect, resource.getrlimit(resource.RLIMIT_FSIZE)

    def narrow(*arguments):
      """The page and what DuckDB reads fit; what it writes does not."""
      resource.setrlimit(resource.RLIMIT_FSIZE, (4096, unlimited[1]))
      return connect(*arguments)

    for name in ("rows.parquet", "rows.duckdb"):
      rows = out / name
      out.mkdir(exist_ok=True)
      rows.write_text("what was there")
      with self.subTest(name=name), mock.patch.object(duckdb, "connect", narrow), self.assertRaises(files.NotWritten) as raised:
        try:
          export.write(support.read(self.folder), rows)
        finally:
          resource.setrlimit(resource.RLIMIT_FSIZE, unlimited)
      self.assertEqual(str(raised.exception), f"{rows}: could not be written: File too large")
      self.assertEqual(([path.name for path in out.iterdir()], rows.read_text()), ([name], "what was there"))
      rows.unlink()

    with open("/dev/full", "w") as stdout:
      result = tessera("report", self.folder, stdout=stdout)
    self.assertEqual((result.returncode, result.stderr), (1, "tessera: stdout: could not be written: No space left on device\n"))

  def check_export(self, folder, file):
    rows = [json.loads(line) for line in (folder / "rows.jsonl").read_text().splitlines()]
    is_table = file.suffix == ".duckdb"
    with duckdb.connect(str(file) if is_table else ":memory:", read_only=is_table) as database:
      table = "rows" if is_table else f"'{file}'"
      ask = lambda query: database.execute(query).fetchone()
      self.assertEqual(ask(f"SELECT count(*) FROM {table}"), (len(rows),))
      tile, ms, ratio, verdict, mismatch, first = ask(
        f"SELECT variant.tile, ms, ratio, verdict, error.coverage_mismatch, time_ns.samples[1] FROM {table}"
        " WHERE machine = 'AMD EPYC' AND sweep.cell = 16"
      )
      row = next(row for row in rows if row["sweep"]["cell"] == 16)
      self.assertEqual(
        (tile, verdict, mismatch, first),
        ("8", "faster", row["error"]["coverage_mismatch"], row["time_ns"]["samples"][0]),
      )
      self.assertAlmostEqual(ms, row["time_ns"]["median"] / 1e6)
      self.assertTrue(0.85 < ratio < 0.95)
      self.assertEqual(ask(f"SELECT count(*) FROM {table} WHERE status = 'overflow' AND ms IS NULL"), (2,))

  def test_rows_of_a_sweep_that_was_killed(self):
    """Rows come from the journal where they are missing."""
    toml = Path(self.temporary.name) / "tiny.toml"
    toml.write_text(
      'title = "Tiny"\nquestion = "Is there a row?"\nsizes = [32]\nrounds = 2\nthreads = [1]\n[scenes]\nball ='
      ' "generate:icosphere?level=1"\n[axes]\ntile = [32, 64]\n'
    )
    swept = tessera("sweep", toml, "--out", self.folder)
    self.assertEqual(swept.returncode, 0, swept.stderr)
    (self.folder / "rows.jsonl").unlink()
    result = tessera("report", self.folder)
    self.assertEqual(result.returncode, 0, result.stderr)
    self.assertEqual(len((self.folder / "rows.jsonl").read_text().splitlines()), 3)
    self.assertIn("Is there a row?", (self.folder / "report" / "index.html").read_text())


if __name__ == "__main__":
  unittest.main()
