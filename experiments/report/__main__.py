"""Makes a sweep's page and figures: python experiments/report DIR --schema N [--export FILE] [--all-devices]. `tessera report` runs it."""
import argparse
import os
from pathlib import Path
import shutil
import sys

try:
  import rows
except ModuleNotFoundError as error:
  sys.exit(f"tessera: {sys.executable} has no {error.name}: './dev build' installs a Python that has what tools/report.txt lists")


def writeBeside(path, content):
  """Written beside its name and renamed, so that there is never half a file."""
  new = path.with_name(path.name + ".tmp")
  new.write_bytes(content)
  os.replace(new, path)


def writeFigures(folder, plots):
  """The names of the figures. Those of an earlier report go: they may not be of these rows."""
  import figures
  shutil.rmtree(folder, ignore_errors=True)
  folder.mkdir()
  main = plots.figure()
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
    raise rows.Refused(f"{path}: --export writes Parquet and DuckDB files; a name that ends in .parquet or .duckdb would do")
  if not path.absolute().parent.is_dir():
    raise rows.Refused(f"{path}: its folder is not there; one that is would do")


def main():
  parser = argparse.ArgumentParser(prog="tessera report")
  parser.add_argument("folder", type=Path)
  parser.add_argument("--schema", type=int, required=True)
  parser.add_argument("--export", type=Path)
  parser.add_argument("--all-devices", action="store_true")
  arguments = parser.parse_args()
  sweep = rows.readSweep(arguments.folder, arguments.schema, arguments.all_devices)

  if arguments.export:
    checkExport(arguments.export)

  # Only now, since these take a second and what is wrong with a folder should be said at once.
  import export
  import page
  import plots as plots_
  plots = plots_.Plots(sweep, arguments.all_devices)
  report = arguments.folder / "report"
  report.mkdir(exist_ok=True)
  names = writeFigures(report / "figures", plots)
  content = page.Page(sweep, plots, names).html().encode()
  writeBeside(report / "index.html", content)
  print(f"wrote {report / 'index.html'} ({len(content) / 1e6:.1f} MB) and {len(names)} figures in {report / 'figures'}")
  if arguments.export:
    export.write(sweep, arguments.export)
    print(f"wrote {arguments.export}")


def complain(line, code):
  print("tessera:", " ".join(str(line).split("\n")), file=sys.stderr)
  return code


try:
  main()
except rows.Refused as refused:
  sys.exit(complain(refused, 2))
except OSError as error:
  sys.exit(complain(f"{error.filename}: {error.strerror}", 1))
except KeyboardInterrupt:
  sys.exit(130)
