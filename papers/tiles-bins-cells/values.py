"""Every number of main.typ, from the rows of three sweeps: values.json, and the figures.

  values.py OUT TILE-SIZE BIN-CAPACITY PINEDA-CELLS

The last three are folders with rows.jsonl and sweep.toml, as `tessera sweep` leaves them. A number is {value, unit, text}: text is what
the page shows, with three significant digits, counts in full and ratios with two places below 10. Verdicts are those of
experiments/report: a ratio within the A/A noise floor is `equal`."""
import json
import math
import re
import sys
from pathlib import Path

kRoot = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(kRoot / "experiments" / "report"))
import ratios  # noqa: E402
import rows  # noqa: E402
import words  # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parent))
import crossovers  # noqa: E402
import drawings  # noqa: E402

kReference = {"traversal": "cell-reject", "step": "direct", "size-class": "off"}


def quantity(value, unit="", digits=3):
  return {"value": value, "unit": unit, "text": words.significant(value, digits)}


def rounded(value, unit=""):
  """What is interpolated, to two digits."""
  places = 1 - math.floor(math.log10(value))
  return {"value": value, "unit": unit, "text": f"{round(value, places):,.{max(places, 0)}f}"}


def area(value):
  """As the sweep's file has it."""
  return {"value": value, "unit": "pixels", "text": f"{value:,.10g}"}


def factor(value):
  return {"value": value, "unit": "", "text": f"{value:.2f}" if value < 9.995 else words.significant(value)}


def share(part, whole):
  """A share in per cent; small ones keep two digits, and only nothing is 0."""
  percent = 100 * part / whole if whole else 0.0
  return {"value": percent, "unit": "%", "text": f"{percent:.0f}" if percent >= 9.95 else f"{percent:.1f}" if percent >= 0.95
          else words.significant(percent, 2)}


def least(quantities):
  return min(quantities, key=lambda q: q["value"], default=None)


def most(quantities):
  return max(quantities, key=lambda q: q["value"], default=None)


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
  return int(re.search(r"kRowSchemaVersion = (\d+);", (kRoot / "host/row.h").read_text())[1])


def constant(file, name):
  """A constant of the kernels."""
  return int(re.search(rf"\b{name} = (\d+);", (kRoot / "slang" / file).read_text())[1])


def confidence():
  """Of the noise floor."""
  return float(re.search(r"numpy\.quantile\(medians, ([\d.]+)\)", Path(ratios.__file__).read_text(encoding="utf-8"))[1])


def counter(cell, name):
  return cell.row["counters"][name]


def sceneOf(group):
  reference = group.reference
  middle, low, high = reference.spread
  return {
      "name": group.values["scene"],
      "triangles": quantity(reference.row["scene"]["triangles"]),
      "drawn": quantity(counter(reference, "covered") / counter(reference, "submitted"), "pixels"),
      "reference": quantity(middle, "ms"), "low": quantity(low, "ms"), "high": quantity(high, "ms"),
      "floor": {"value": group.floor, "unit": "%", "text": f"{100 * (group.floor - 1):.1f}"},
  }


def sweepOf(sweep, name):
  cells = [cell for cell in sweep.cells if not cell.twin]
  implementation = [cell for cell in cells if cell.row["variant"].get("overflow") != "drop"]
  floors = [sceneOf(group)["floor"] for group in sweep.groups]
  size = sweep.cells[0].row["scene"]["size"]
  return {
      "name": name, "question": sweep.question,
      "width": quantity(size[0]), "height": quantity(size[1]),
      "cells": quantity(len(cells)), "scenes": quantity(len(sweep.groups)),
      "frames": quantity(sum(len(cell.row["time_ns"]["samples"]) for cell in sweep.cells if cell.timed)),
      "rounds": quantity(max(len(set(cell.row["time_ns"]["rounds"])) for cell in sweep.cells if cell.timed)),
      "exact": quantity(sum(cell.status == "ok" and cell.mismatches() == 0 for cell in implementation)),
      "implementation": quantity(len(implementation)),
      "least": least(floors), "most": most(floors),
      "failed": [{"name": f"{cell.values['scene']}: {words.cellName(cell, sweep.swept)}", "status": cell.status} for cell in cells if cell.status != "ok"],
      "resumed": any(session for cell in sweep.cells if cell.timed for session in cell.row["time_ns"].get("sessions", [])),
  }


def timeOf(cell, fastest=()):
  """A field of a table of ratios."""
  if cell is None:
    return {"text": "", "verdict": "", "fastest": False}
  if not cell.ratio:
    return {"text": cell.status, "verdict": cell.status, "fastest": False}
  return {**factor(cell.ratio.median), "low": cell.ratio.low, "high": cell.ratio.high, "fastest": cell in fastest,
          "verdict": "reference" if cell.reference else cell.ratio.verdict}


def winner(group, cells, axes):
  """The fastest of some cells, and the names of those that are equal to it."""
  first, *equal = group.fastest(cells)
  return {"name": words.cellName(first, axes), "ratio": timeOf(first), "values": first.values,
          "equal": quantity(len(equal))}, [first, *equal]


def common(sets, order):
  """What is in all of some sets."""
  return [value for value in order if all(value in other for other in sets)]


def valuesOf(cells_, axis, order): return [value for value in order if any(cell.values[axis] == value for cell in cells_)]


def find(group, **values):
  values = {axis.replace("_", "-"): value for axis, value in values.items()}
  return next((cell for cell in group.cells if not cell.twin and all(cell.values.get(a) == v for a, v in values.items())), None)


# -- tile size

def tileSize(sweep):
  tiles, binnings = sweep.order("tile"), sweep.order("binning")
  scenes = []
  over = {}  # binning, tile -> its time over the fastest cell's, a scene each
  winners = []
  for group in sweep.groups:
    best, fastest = winner(group, group.candidates, ["binning", "tile"])
    winners.append(fastest)
    ways = []
    for binning in binnings:
      cells = [cell for cell in group.candidates if cell.values["binning"] == binning]
      if not cells:
        continue
      first, last = (pick(cells, key=lambda cell: cell.ratio.median) for pick in (min, max))
      ways.append({"binning": binning, "best": first.values["tile"], "worst": last.values["tile"],
                   "spread": spread(group, last, first)})
    for cell in group.candidates:
      over.setdefault((cell.values["binning"], cell.values["tile"]), []).append(group.compare(cell, fastest[0]).median)
    exact = [find(group, binning="exact", tile=tile) for tile in tiles]
    scenes.append({
        **sceneOf(group), "best": best, "ways": ways,
        "ratios": [[timeOf(find(group, binning=binning, tile=tile), fastest) for tile in tiles] for binning in binnings],
        "pairs": [factor(counter(cell, "binned") / counter(cell, "pieces")) if cell and cell.timed else None for cell in exact],
        "binning": [share(binTime(cell), sum(stages(cell).values())) if cell and cell.timed else None for cell in exact],
    })
  whole = {key: max(values) for key, values in over.items() if len(values) == len(sweep.groups)}
  safest = min(whole, key=whole.get)
  spreads = [way["spread"] for scene in scenes for way in scene["ways"] if way["spread"]]
  return {
      **sweepOf(sweep, "tile-size"), "tiles": tiles, "binnings": binnings, "places": scenes,
      # Among the fastest, that is the fastest or equal to it, on every scene.
      "commonTiles": common([valuesOf(cells_, "tile", tiles) for cells_ in winners], tiles),
      "commonBinnings": common([valuesOf(cells_, "binning", binnings) for cells_ in winners], binnings),
      "safest": {"name": f"binning={safest[0]} tile={safest[1]}", "worst": factor(whole[safest])},
      "leastSpread": least(spreads), "mostSpread": most(spreads),
  }


def spread(group, slower, faster):
  """None where the two are equal."""
  ratio = group.compare(slower, faster)
  return None if ratio.equal else factor(ratio.median)


def stages(cell): return cell.row["time_ns"]["stages"]


def binTime(cell):
  return sum(ns for stage, ns in stages(cell).items() if stage.startswith(("bin-", "scan-")))


# -- bins and their capacity

def lost(cell, name):
  """Pixels of a run with overflow=drop: median, least and most over the runs, as shares of the raster."""
  samples = cell.row.get("error_samples", {}).get(name) or [cell.row["error"][name]]
  pixels = cell.row["error"]["pixels"]
  middle = ratios.spread(samples)[0]
  return {**share(middle, pixels), "least": share(min(samples), pixels), "most": share(max(samples), pixels), "none": max(samples) == 0}


def binCapacity(sweep):
  capacities = sweep.order("capacity")
  scenes = []
  retries = dear = 0  # queues that ran again, and those of them that cost more than one that was large enough
  for group in sweep.groups:
    exact, bitmask = find(group, binning="exact"), find(group, binning="bitmask")
    queues = {policy: [find(group, binning="queue", capacity=capacity, overflow=policy) for capacity in capacities] for policy in ("retry", "drop")}
    lines = []
    for capacity, retry, drop in zip(capacities, queues["retry"], queues["drop"]):
      dropped = drop and drop.timed
      entries = counter(drop, "overflowed") + counter(drop, "binned") if dropped else 0
      lines.append({
          "capacity": quantity(int(capacity)), "retry": timeOf(retry), "drop": timeOf(drop),
          "retries": quantity(counter(retry, "retries")) if retry and retry.timed else None,
          "dropped": share(counter(drop, "overflowed"), entries) if dropped else None,
          "lost": lost(drop, "coverage_mismatch") if dropped else None, "wrong": lost(drop, "id_mismatch") if dropped else None,
      })
    enough = next((cell for cell in queues["retry"] if cell and cell.timed and counter(cell, "retries") == 0), None)
    lossless = next((line["capacity"] for line in lines if line["wrong"] and line["wrong"]["none"]), None)
    retried = [cell for cell in queues["retry"] if cell and cell.timed and counter(cell, "retries") > 0]
    price = [group.compare(cell, enough) for cell in retried] if enough else []
    retries += len(price)
    price = [ratio for ratio in price if ratio.verdict == "slower"]
    dear += len(price)
    first = next((line for line in lines if line["wrong"]), None)
    quickest, _ = winner(group, [cell for cell in [*queues["retry"], exact, bitmask] if cell and cell.timed], ["binning", "capacity", "overflow"])
    scenes.append({
        **sceneOf(group), "lines": lines, "exact": timeOf(exact), "bitmask": timeOf(bitmask), "best": quickest,
        "fullest": quantity(counter(exact, "largestBin")),
        "enough": quantity(int(enough.values["capacity"])) if enough else None, "lossless": lossless,
        "price": {"least": factor(min(r.median for r in price)), "most": factor(max(r.median for r in price))} if price else None,
        "first": first,
    })
  gains = [{**line, "scene": scene["name"]} for scene in scenes for line in scene["lines"] if line["wrong"] and not line["wrong"]["none"] and line["drop"]["verdict"] == "faster"]
  lossy = [line for scene in scenes for line in scene["lines"] if line["wrong"] and not line["wrong"]["none"]]
  prices = [scene["price"] for scene in scenes if scene["price"]]
  varied = [{**scene, "line": line} for scene in scenes for line in scene["lines"]
            if line["lost"] and line["wrong"]["least"]["value"] != line["wrong"]["most"]["value"]]
  return {
      **sweepOf(sweep, "bin-capacity"), "capacities": [quantity(int(capacity)) for capacity in capacities], "places": scenes,
      "tile": sweep.cells[0].row["variant"]["tile"],
      "leastPrice": least([price["least"] for price in prices]), "mostPrice": most([price["most"] for price in prices]),
      "retried": quantity(retries), "dear": quantity(dear),
      # Where dropping pays, if anywhere: the faster lossy cells, and the least that such a cell loses.
      "gains": quantity(len(gains)), "lossy": quantity(len(lossy)),
      "cheapest": min(gains, key=lambda line: line["wrong"]["value"], default=None),
      "worst": max(({**line, "scene": scene["name"]} for scene in scenes for line in scene["lines"] if line["wrong"]), key=lambda line: line["wrong"]["value"], default=None),
      "varies": bool(varied), "bitmask": [least([scene["bitmask"] for scene in scenes if "value" in scene["bitmask"]]),
                                          most([scene["bitmask"] for scene in scenes if "value" in scene["bitmask"]])],
  }


# -- cells

def cells(sweep):
  axes = ["traversal", "step", "size-class"]
  traversals = sweep.order("traversal")
  groups = sorted(sweep.groups, key=lambda group: float(group.cells[0].values["x"]))
  areas, winners = [], []
  for group in groups:
    best, fastest = winner(group, group.candidates, axes)
    winners.append(valuesOf(fastest, "traversal", traversals))
    areas.append({
        **sceneOf(group), "area": area(float(group.cells[0].values["x"])), "best": best, "equals": quantity(len(fastest) - 1),
        "ratios": [timeOf(find(group, **{**kReference, "traversal": traversal}), fastest) for traversal in traversals],
        "tests": [perCovered(find(group, **{**kReference, "traversal": traversal})) for traversal in traversals],
    })
  pairs = crossovers.pairs(groups, traversals, find)
  for pair in pairs:
    for crossing in pair["crossings"]:
      crossing |= {"at": rounded(crossing["at"], "pixels"), "low": area(crossing["low"]), "high": area(crossing["high"])}
  gains = [{"area": line["area"], "name": line["best"]["name"], **line["best"]["ratio"]} for line in areas if line["best"]["ratio"]["verdict"] == "faster"]
  byPixel = [line["tests"][traversals.index("pixel")] for line in areas]
  byCell = [line["tests"][traversals.index("cell-reject")] for line in areas]
  return {
      **sweepOf(sweep, "pineda-cells"), "traversals": traversals, "areas": areas, "pairs": pairs,
      "variants": quantity(len({words.cellName(cell, axes) for cell in sweep.cells})),
      "crossing": quantity(sum(bool(pair["crossings"]) for pair in pairs)),
      "mostGain": least(gains), "gains": quantity(len(gains)),
      "winners": [{"traversals": traversals_, "from": areas[first]["area"], "to": areas[last]["area"]} for traversals_, first, last in crossovers.runs(winners)],
      "front": [share(sum(ns for stage, ns in stages(group.reference).items() if stage in ("transform", "project", "setup")),
                      sum(stages(group.reference).values())) for group in groups],
      "smallest": areas[0]["area"], "largest": areas[-1]["area"],
      "pixelTests": [most([t for t in byPixel if t]), least([t for t in byPixel if t])],
      "cellTests": [most([t for t in byCell if t]), least([t for t in byCell if t])],
  }


def perCovered(cell):
  return factor(counter(cell, "tests") / counter(cell, "covered")) if cell and cell.status == "ok" and counter(cell, "covered") else None


def machine(sweeps):
  found = [cell.row["provenance"] for sweep in sweeps for cell in sweep.cells]
  days = sorted(row["utc"][:10] for row in found)
  one = lambda key: words.listing(dict.fromkeys(str(row.get(key, "")) for row in found if row.get(key, "") != ""))
  if len({(row["cpu"], row.get("threads")) for row in found}) > 1:
    refuse(f"the three sweeps are not of one machine: {one('cpu')}, {one('threads')} threads; run them on one")
  year, month, day = days[-1].split("-")
  return {
      "cpu": one("cpu"), "threads": quantity(int(found[0].get("threads", 0))), "os": one("os"), "compiler": one("compiler"), "slang": one("slang"),
      "kernelCompiler": words.listing(dict.fromkeys(shortCompiler(row["kernel_compiler"]) for row in found)), "git": words.listing(dict.fromkeys(row["git"][:12] for row in found)),
      "dirty": any(row.get("dirty") for row in found),
      "days": [days[0], days[-1]], "year": int(year), "month": int(month), "day": int(day),
      "clock": words.listing(dict.fromkeys(cell.row["time_ns"]["clock"] for sweep in sweeps for cell in sweep.cells if cell.timed)),
  }


def shortCompiler(text):
  """"g++ 12.2.0, -O3 ... (znver3)" -> "g++ 12.2.0 for znver3"."""
  parts = re.fullmatch(r"([^,]+),.*\((\S+)\)", text)
  return f"{parts[1]} for {parts[2]}" if parts else text


def constants():
  cell, block = constant("layout.slang", "kCell"), constant("layout.slang", "kBlockCells")
  lanes = cell * cell
  return {"cell": quantity(cell), "lanes": quantity(lanes), "block": quantity(cell * block),
          "subPixels": quantity(constant("layout.slang", "kSubPixels")), "int32": quantity(constant("edge/int32.slang", "kInt32Extent") // 256),
          "draws": quantity(ratios.kDraws), "confidence": share(confidence(), 1)}


def main(out, *folders):
  out = Path(out)
  tile, capacity, pineda = sweeps = [readSweep(folder) for folder in folders]
  values = {"machine": machine(sweeps), "constants": constants(), "tile": tileSize(tile), "capacity": binCapacity(capacity), "cells": cells(pineda)}
  (out / "values.json").write_text(json.dumps(values, indent=1) + "\n", encoding="utf-8")
  drawings.draw(out, tile, capacity, pineda, values)


if __name__ == "__main__":
  if len(sys.argv) != 5:
    sys.exit("usage: values.py OUT TILE-SIZE BIN-CAPACITY PINEDA-CELLS")
  try:
    main(*sys.argv[1:])
  except rows.Refused as refused:
    print(f"values: {refused}", file=sys.stderr)
    sys.exit(2)
