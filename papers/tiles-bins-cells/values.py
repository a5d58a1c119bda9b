"""Every number of main.typ, from the rows of three sweeps: values.json, and the figures.

  values.py OUT TILE-SIZE BIN-CAPACITY PINEDA-CELLS

The last three are folders with rows.jsonl and sweep.toml, as `tessera sweep` leaves them. A number is {value, unit, text}: text is what
the page shows (quantities.py). Verdicts are those of experiments/report: a ratio within the A/A noise floor is `equal`."""
import json
from pathlib import Path
import re
import sys

from report import kRoot
import ratios
import rows
import visible
import words
import bins
import cells
import drawings
from quantities import quantity, share
import tiles


def refuse(message):
  raise rows.Refused(message)


def readSweep(folder):
  sweep = rows.readSweep(Path(folder), schemaVersion())
  for place in ("machine", "size", "device", "threads"):
    if sweep.varies(place):
      refuse(f"{folder}/rows.jsonl: rows of several values of {place} ({', '.join(sweep.order(place))}); this paper is about one")
  for group in sweep.groups:
    if not (group.reference and group.reference.timed and group.floor):
      refuse(f"{folder}/rows.jsonl: scene {group.values['scene']}: no time of the reference and its twin; run the sweep again")
  return sweep


def schemaVersion():
  return int(re.search(r"kRowSchemaVersion = (\d+);", (kRoot / "host/measure/row.h").read_text())[1])


def constant(file, name):
  """A constant of the kernels."""
  return int(re.search(rf"\b{name} = (\d+);", (kRoot / "slang" / file).read_text())[1])


def confidence():
  """Of the noise floor."""
  return float(re.search(r"numpy\.quantile\(medians, ([\d.]+)\)", Path(ratios.__file__).read_text(encoding="utf-8"))[1])


def machine(sweeps):
  found = [cell.row["provenance"] for sweep in sweeps for cell in sweep.cells]
  days = sorted(row["utc"][:10] for row in found)
  one = lambda key: words.listing(dict.fromkeys(str(row.get(key, "")) for row in found if row.get(key, "") != ""))
  if len({(row["cpu"], row.get("threads")) for row in found}) > 1:
    refuse(f"the three sweeps are not of one machine: {one('cpu')}, {one('threads')} threads; run them on one")
  year, month, day = days[-1].split("-")
  return {
      "cpu": one("cpu"), "threads": quantity(int(found[0].get("threads", 0))), "os": one("os"), "compiler": one("compiler"), "slang": one("slang"),
      "kernelCompiler": words.listing(dict.fromkeys(shortCompiler(row["kernel_compiler"]) for row in found)),
      "git": words.listing(dict.fromkeys(row["git"][:12] for row in found)), "dirty": any(row.get("dirty") for row in found),
      "days": [days[0], days[-1]], "year": int(year), "month": int(month), "day": int(day),
      "clock": words.listing(dict.fromkeys(cell.row["time_ns"]["clock"] for sweep in sweeps for cell in sweep.cells if cell.timed)),
  }


def shortCompiler(text):
  """"g++ 12.2.0, -O3 ... (znver3)" -> "g++ 12.2.0 for znver3"."""
  parts = re.fullmatch(r"([^,]+),.*\((\S+)\)", text)
  return f"{parts[1]} for {parts[2]}" if parts else text


def constants():
  cell = constant("records/layout.slang", "kCell")
  return {"cell": quantity(cell), "lanes": quantity(cell * cell), "subPixels": quantity(constant("records/layout.slang", "kSubPixels")),
          "draws": quantity(ratios.kDraws), "confidence": share(confidence(), 1)}


def main(out, *folders):
  out = Path(out)
  tile, capacity, pineda = sweeps = [readSweep(folder) for folder in folders]
  values = {"machine": machine(sweeps), "constants": constants(), "tile": tiles.values(tile), "capacity": bins.values(capacity), "cells": cells.values(pineda)}
  (out / "values.json").write_text(json.dumps(values, indent=1) + "\n", encoding="utf-8")
  drawings.draw(out, *sweeps, values)


if __name__ == "__main__":
  if len(sys.argv) != 5:
    sys.exit("usage: values.py OUT TILE-SIZE BIN-CAPACITY PINEDA-CELLS")
  try:
    main(*sys.argv[1:])
  except rows.Refused as refused:
    print(visible.oneLine(f"values: {refused}"), file=sys.stderr)
    sys.exit(2)
