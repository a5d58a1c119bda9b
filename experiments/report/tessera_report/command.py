"""Makes a sweep's page and figures: python3 -m tessera_report ROWS.jsonl --out DIR --schema N [--export FILE] [--all-devices].

`tessera report` runs it."""

import argparse
import os
from pathlib import Path
import shutil
import sys
import tempfile
import traceback

from . import visible
from .files import check_apart, NotWritten, writing
from .refused import Refused


PAGE = "index.html"
SCHEMA_FILE = "row.schema.json"


def check_place(report):
  """A report's folder is new, empty, or holds an earlier report, whose files may go."""
  if report.exists() and not report.is_dir():
    raise Refused(f"{report}: is a file; the name of a folder would do")
  if not report.is_dir():
    return
  names = sorted(entry.name for entry in report.iterdir())
  known = (PAGE, SCHEMA_FILE, "figures")
  others = [name for name in names if name not in known and not name.endswith(".tmp")]
  is_report = PAGE in names and b"<code>tessera report</code>" in (report / PAGE).read_bytes()[-2_000_000:]
  if names and not is_report:
    raise Refused(f"{report}: holds {(others or names)[0]} and no report; a new or an empty folder would do")


def write_figures(folder, files, main):
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
  for name in ("figures", SCHEMA_FILE, PAGE):
    os.replace(new / name, report / name)


def check_export(path):
  if path.suffix not in (".parquet", ".duckdb"):
    raise Refused(f"{path}: --export writes Parquet and DuckDB files; a name that ends in .parquet or .duckdb would do")
  if not path.absolute().parent.is_dir():
    raise Refused(f"{path}: its folder is not there; one that is would do")


def main():
  from . import rows  # here, as the modules that follow: run() says in a line which library is not there

  parser = argparse.ArgumentParser(prog="tessera report")
  parser.add_argument("rows", type=Path)
  parser.add_argument("--out", type=Path, required=True)
  parser.add_argument("--schema", type=int, required=True)
  parser.add_argument("--export", type=Path)
  parser.add_argument("--all-devices", action="store_true")
  arguments = parser.parse_args()
  check_place(arguments.out)
  sweep = rows.read_sweep(arguments.rows.parent, arguments.schema, arguments.all_devices, arguments.rows.name)

  if arguments.export:
    check_export(arguments.export)
    check_apart(arguments.export, arguments.rows)

  # These take a second, and what is wrong with a folder should be said at once.
  from . import export, figures, schema
  from .page import Page
  from .plots import Plots

  plots = Plots(sweep, arguments.all_devices)
  figure = plots.figure()
  if figure is None:
    reasons = [line for line in plots.skipped if line.startswith(f"{sweep.plot.get('figure')}:")]
    complain(f"{sweep.folder}: no figures/figure.svg: {' '.join(reasons) or 'there is nothing to plot'}", 0)
  report = arguments.out
  files = [file for plot in plots.list for file in figures.files(plot)]
  names = list(dict.fromkeys(name for name, _, _ in files))
  content = Page(sweep, plots, names, report).html().encode()
  parent = next(folder for folder in (report.absolute(), *report.absolute().parents) if folder.is_dir())
  with writing(report), tempfile.TemporaryDirectory(prefix="report.", suffix=".tmp", dir=parent) as folder:
    new = Path(folder)
    write_figures(new / "figures", files, figure)
    (new / PAGE).write_bytes(content)
    shutil.copyfile(schema.FILE, new / SCHEMA_FILE)
    replace(new, report)
  say(f"wrote {report / PAGE} ({len(content) / 1e6:.1f} MB) and {len(names)} figures in {report / 'figures'}")
  if arguments.export:
    export.write(sweep, arguments.export)
    say(f"wrote {arguments.export}")


def say(line):
  with writing("stdout"):  # at once: what is kept until the end would fail there, with no line
    os.write(sys.stdout.fileno(), (visible.one_line(line) + "\n").encode())


def complain(line, code):
  print("tessera:", visible.one_line(line), file=sys.stderr)
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

