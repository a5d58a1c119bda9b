"""Makes a sweep's page and figures: python experiments/report DIR --schema N [--export FILE] [--all-devices].

`tessera report` runs it."""

import argparse
import os
from pathlib import Path
import shutil
import sys

from refused import Refused


def writeBeside(path, content):
  """Written beside its name and renamed, so that there is never half a file."""
  new = path.with_name(path.name + ".tmp")
  new.write_bytes(content)
  os.replace(new, path)


def writeFigures(folder, plots, main):
  """The names of the figures, of which `main` is copied to figure.*. Those of an earlier report go."""
  import figures

  shutil.rmtree(folder, ignore_errors=True)
  folder.mkdir()
  names = []
  for plot in plots.list:
    for name, kind, content in figures.files(plot):
      writeBeside(folder / f"{name}.{kind}", content)
      if name == main:
        writeBeside(folder / f"figure.{kind}", content)
      names.append(name)
  return list(dict.fromkeys(names))


def checkExport(path):
  if path.suffix not in (".parquet", ".duckdb"):
    raise Refused(f"{path}: --export writes Parquet and DuckDB files; a name that ends in .parquet or .duckdb would do")
  if not path.absolute().parent.is_dir():
    raise Refused(f"{path}: its folder is not there; one that is would do")


def main():
  import rows  # here, as the modules that follow: run() says in a line which library is not there

  parser = argparse.ArgumentParser(prog="tessera report")
  parser.add_argument("folder", type=Path)
  parser.add_argument("--schema", type=int, required=True)
  parser.add_argument("--export", type=Path)
  parser.add_argument("--all-devices", action="store_true")
  arguments = parser.parse_args()
  sweep = rows.readSweep(arguments.folder, arguments.schema, arguments.all_devices)

  if arguments.export:
    checkExport(arguments.export)

  # These take a second, and what is wrong with a folder should be said at once.
  import export
  import page
  import plots as plots_

  plots = plots_.Plots(sweep, arguments.all_devices)
  figure = plots.figure()
  if figure is None:
    reasons = [line for line in plots.skipped if line.startswith(f"{sweep.plot.get('figure')}:")]
    complain(f"{arguments.folder}: no figures/figure.svg: {' '.join(reasons) or 'there is nothing to plot'}", 0)
  report = arguments.folder / "report"
  report.mkdir(exist_ok=True)
  names = writeFigures(report / "figures", plots, figure)
  content = page.Page(sweep, plots, names).html().encode()
  writeBeside(report / "index.html", content)
  print(f"wrote {report / 'index.html'} ({len(content) / 1e6:.1f} MB) and {len(names)} figures in {report / 'figures'}")
  if arguments.export:
    export.write(sweep, arguments.export)
    print(f"wrote {arguments.export}")


def complain(line, code):
  print("tessera:", " ".join(str(line).split("\n")), file=sys.stderr)
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
  except OSError as error:
    return complain(f"{error.filename}: {error.strerror}", 1)
  except KeyboardInterrupt:
    return 130
  return 0


sys.exit(run())
