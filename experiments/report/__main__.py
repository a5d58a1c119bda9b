"""Makes a sweep's page and figures: python experiments/report ROWS.jsonl --out DIR --schema N [--export FILE] [--all-devices].

`tessera report` runs it."""

import argparse
import os
from pathlib import Path
import shutil
import sys
import tempfile
import traceback

from files import checkApart, NotWritten, writing
from refused import Refused
import visible


kPage = "index.html"
kSchemaFile = "row.schema.json"


def checkPlace(report):
  """A report's folder is new, empty, or holds an earlier report, whose files may go."""
  if report.exists() and not report.is_dir():
    raise Refused(f"{report}: is a file; the name of a folder would do")
  if not report.is_dir():
    return
  names = sorted(entry.name for entry in report.iterdir())
  known = (kPage, kSchemaFile, "figures")
  others = [name for name in names if name not in known and not name.endswith(".tmp")]
  isReport = kPage in names and b"<code>tessera report</code>" in (report / kPage).read_bytes()[-2_000_000:]
  if names and not isReport:
    raise Refused(f"{report}: holds {(others or names)[0]} and no report; a new or an empty folder would do")


def writeFigures(folder, files, main):
  """The figures, of which `main` is written as figure.*, too."""
  folder.mkdir()
  for name, kind, content in files:
    (folder / f"{name}.{kind}").write_bytes(content)
    if name == main:
      (folder / f"figure.{kind}").write_bytes(content)


def replace(new, report):
  """Puts what is in `new` into `report`: all is written by now, so that an earlier report stays until then."""
  report.mkdir(parents=True, exist_ok=True)
  old = new / "old"
  if (report / "figures").exists():
    os.replace(report / "figures", old)
  for name in ("figures", kSchemaFile, kPage):
    os.replace(new / name, report / name)


def checkExport(path):
  if path.suffix not in (".parquet", ".duckdb"):
    raise Refused(f"{path}: --export writes Parquet and DuckDB files; a name that ends in .parquet or .duckdb would do")
  if not path.absolute().parent.is_dir():
    raise Refused(f"{path}: its folder is not there; one that is would do")


def main():
  import rows  # here, as the modules that follow: run() says in a line which library is not there

  parser = argparse.ArgumentParser(prog="tessera report")
  parser.add_argument("rows", type=Path)
  parser.add_argument("--out", type=Path, required=True)
  parser.add_argument("--schema", type=int, required=True)
  parser.add_argument("--export", type=Path)
  parser.add_argument("--all-devices", action="store_true")
  arguments = parser.parse_args()
  checkPlace(arguments.out)
  sweep = rows.readSweep(arguments.rows.parent, arguments.schema, arguments.all_devices, arguments.rows.name)

  if arguments.export:
    checkExport(arguments.export)
    checkApart(arguments.export, arguments.rows)

  # These take a second, and what is wrong with a folder should be said at once.
  import export
  import figures
  import page
  import schema
  import plots as plots_

  plots = plots_.Plots(sweep, arguments.all_devices)
  figure = plots.figure()
  if figure is None:
    reasons = [line for line in plots.skipped if line.startswith(f"{sweep.plot.get('figure')}:")]
    complain(f"{sweep.folder}: no figures/figure.svg: {' '.join(reasons) or 'there is nothing to plot'}", 0)
  report = arguments.out
  files = [file for plot in plots.list for file in figures.files(plot)]
  names = list(dict.fromkeys(name for name, _, _ in files))
  content = page.Page(sweep, plots, names, report).html().encode()
  parent = next(folder for folder in (report.absolute(), *report.absolute().parents) if folder.is_dir())
  with writing(report), tempfile.TemporaryDirectory(prefix="report.", suffix=".tmp", dir=parent) as folder:
    new = Path(folder)
    writeFigures(new / "figures", files, figure)
    (new / kPage).write_bytes(content)
    shutil.copyfile(schema.kFile, new / kSchemaFile)
    replace(new, report)
  say(f"wrote {report / kPage} ({len(content) / 1e6:.1f} MB) and {len(names)} figures in {report / 'figures'}")
  if arguments.export:
    export.write(sweep, arguments.export)
    say(f"wrote {arguments.export}")


def say(line):
  with writing("stdout"):  # at once: what is kept until the end would fail there, with no line
    os.write(sys.stdout.fileno(), (visible.oneLine(line) + "\n").encode())


def complain(line, code):
  print("tessera:", visible.oneLine(line), file=sys.stderr)
  return code


def run():
  try:
    main()
  except ModuleNotFoundError as error:
    return complain(
      f"{sys.executable} has no {error.name}: './dev build' installs a Python that has what tools/report.txt lists",
      1,
    )
  except Refused as error:
    return complain(error, 2)
  except NotWritten as error:
    return complain(error, 1)
  except OSError as error:
    return complain(f"{error.filename}: {error.strerror}", 1)
  except KeyboardInterrupt:
    return 130
  except Exception as error:  # a fault of ours: one line all the same, with the place
    place = traceback.extract_tb(error.__traceback__)[-1]
    return complain(f"report: {type(error).__name__}: {error} ({Path(place.filename).name}:{place.lineno}); nothing was written", 1)
  return 0


sys.exit(run())
