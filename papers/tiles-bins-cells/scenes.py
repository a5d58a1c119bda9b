"""What the three sweeps have in common: scenes, fields of tables, winners."""
import report  # noqa: F401, where tessera_report lies
from tessera_report import words
from quantities import factor, least, most, quantity


def counter(cell, name):
  return cell.row["counters"][name]


def scene_of(group):
  reference = group.reference
  middle, low, high = reference.spread
  return {
      "name": group.values["scene"],
      "triangles": quantity(reference.row["scene"]["triangles"]),
      "drawn": quantity(counter(reference, "covered") / counter(reference, "submitted"), "pixels"),
      "reference": quantity(middle, "ms"), "low": quantity(low, "ms"), "high": quantity(high, "ms"),
      "floor": {"value": group.floor, "unit": "%", "text": f"{100 * (group.floor - 1):.1f}"},
  }


def sweep_of(sweep, name):
  cells = [cell for cell in sweep.cells if not cell.twin]
  implementation = [cell for cell in cells if cell.row["variant"].get("overflow") != "drop"]
  floors = [scene_of(group)["floor"] for group in sweep.groups]
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
      "failed": [{"name": f"{cell.values['scene']}: {words.cell_name(cell, sweep.swept)}", "status": cell.status} for cell in cells if cell.status != "ok"],
      "resumed": any(session for cell in sweep.cells if cell.timed for session in cell.row["time_ns"].get("sessions", [])),
  }


def time_of(cell, fastest=()):
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
  return {"name": words.cell_name(first, axes), "ratio": time_of(first), "values": first.values,
          "equal": quantity(len(equal))}, [first, *equal]


def common(sets, order):
  """What is in all of some sets."""
  return [value for value in order if all(value in other for other in sets)]


def values_of(cells_, axis, order): return [value for value in order if any(cell.values[axis] == value for cell in cells_)]


def find(group, **values):
  values = {axis.replace("_", "-"): value for axis, value in values.items()}
  return next((cell for cell in group.cells if not cell.twin and all(cell.values.get(a) == v for a, v in values.items())), None)


def stages(cell): return cell.row["time_ns"]["stages"]
