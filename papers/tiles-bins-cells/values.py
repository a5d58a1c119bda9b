"""Every number of main.typ, from the rows of three sweeps: values.json, and the figures.

  values.py OUT TILE-SIZE BIN-CAPACITY PINEDA-CELLS

The last three are folders with rows.jsonl and sweep.toml, as `tessera sweep` leaves them. A number is {value, unit, text}: text is what
the page shows (quantities.py). Verdicts are those of tessera_report: a ratio within the A/A noise floor is `equal`."""
import json
from pathlib import Path
import re
import sys

from report import ROOT
from tessera_report import ratios, rows, visible, words
import bins
import cells
import drawings
from quantities import quantity, share
import tiles


def refuse(message):
  raise rows.Refused(message)


def read_sweep(folder):
  sweep = rows.read_sweep(Path(folder), schema_version())
  for place in ("machine", "size", "device", "threads"):
    if sweep.varies(place):
      refuse(f"{folder}/rows.jsonl: rows of several values of {place} ({', '.join(sweep.order(place))}); this paper is about one")
  for group in sweep.groups:
    if not (group.reference and group.reference.timed and group.floor):
      refuse(f"{folder}/rows.jsonl: scene {group.values['scene']}: no time of the reference and its twin; run the sweep again")
  return sweep


def schema_version():
  return int(re.search(r"kRowSchemaVersion = (\d+);", (ROOT / "host/measure/row.h").read_text())[1])


def constant(file, name):
  """A constant of the kernels."""
  return int(re.search(rf"\b{name} = (\d+);", (ROOT / "slang" / file).read_text())[1])


def machine(sweeps):
  found = [cell.row["provenance"] for sweep in sweeps for cell in sweep.cells]
  days = sorted(row["utc"][:10] for row in found)
  one = lambda key: words.listing(dict.fromkeys(str(row.get(key, "")) for row in found if row.get(key, "") != ""))
  if len({(row["cpu"], row.get("threads")) for row in found}) > 1:
    refuse(f"the three sweeps are not of one machine: {one('cpu')}, {one('threads')} threads; run them on one")
  year, month, day = days[-1].split("-")
  return {
      "cpu": one("cpu"), "threads": quantity(int(found[0].get("threads", 0))), "os": one("os"), "compiler": one("compiler"), "slang": one("slang"),
      "kernelCompiler": words.listing(dict.fromkeys(short_compiler(row["kernel_compiler"]) for row in found)),
      "git": words.listing(dict.fromkeys(row["git"][:12] for row in found)), "dirty": any(row.get("dirty") for row in found),
      "days": [days[0], days[-1]], "year": int(year), "month": int(month), "day": int(day),
      "clock": words.listing(dict.fromkeys(cell.row["time_ns"]["clock"] for sweep in sweeps for cell in sweep.cells if cell.timed)),
  }


def short_compiler(text):
  """"g++ 12.2.0, -O3 ... (znver3)" -> "g++ 12.2.0 for znver3"."""
  parts = re.fullmatch(r"([^,]+),.*\((\S+)\)", text)
  return f"{parts[1]} for {parts[2]}" if parts else text


def constants():
  cell = constant("records/layout.slang", "kCell")
  return {"cell": quantity(cell), "lanes": quantity(cell * cell), "subPixels": quantity(constant("records/layout.slang", "kSubPixels")),
          "draws": quantity(ratios.DRAWS), "confidence": share(ratios.CONFIDENCE, 1)}


def main(out, *folders):
  out = Path(out)
  tile, capacity, pineda = sweeps = [read_sweep(folder) for folder in folders]
  values = {"machine": machine(sweeps), "constants": constants(), "tile": tiles.values(tile), "capacity": bins.values(capacity), "cells": cells.values(pineda)}
  (out / "values.json").write_text(json.dumps(values, indent=1) + "\n", encoding="utf-8")
  drawings.draw(out, *sweeps, values)


if __name__ == "__main__":
  if len(sys.argv) != 5:
    sys.exit("usage: values.py OUT TILE-SIZE BIN-CAPACITY PINEDA-CELLS")
  try:
    main(*sys.argv[1:])
  except rows.Refused as refused:
    print(visible.one_line(f"values: {refused}"), file=sys.stderr)
    sys.exit(2)
