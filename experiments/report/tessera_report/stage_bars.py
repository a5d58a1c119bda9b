"""Where the time goes: a bar of stages a cell."""

from . import words
from .panels import Panel, Plot

MOST_BARS = 40


def bars(of):
  cells = [cell for cell in of.shown if cell.row["time_ns"].get("stages")]
  if not cells:
    of.skipped.append("stages: no cell has times of stages that may be shown.")
    return None
  stages = list(dict.fromkeys(stage for cell in cells for stage in cell.row["time_ns"]["stages"]))
  places = of.places(cells)
  panels, cut = [], False
  for group in of.sweep.groups:
    members = [cell for cell in group.cells if cell in cells]
    if len(members) > MOST_BARS:
      members, cut = (
        sorted(sorted(members, key=lambda cell: cell.ms)[:MOST_BARS], key=lambda cell: cell.number),
        True,
      )
    if not members:
      continue
    values = group.values
    axes = [axis for axis in of.sweep.swept if any(axis in cell.values for cell in members)]
    panel = Panel(", ".join(words.place(name, values[name]) for name in places if name in values))
    for cell in members:
      bar = ", ".join(cell.values.get(axis, "\u2013") for axis in axes) or "the only cell"
      for stage, ns in cell.row["time_ns"]["stages"].items():
        panel.cells.append((bar, stage, ns / 1e6, f"{bar}: {stage} {words.significant(ns / 1e6)} ms"))
    panels.append(panel)
  names = f" ({', '.join(of.sweep.swept)})" if of.sweep.swept else ""
  caption = (
    f"Medians of the stages, one bar a cell{names}, in the sweep's order. Medians need not add up to the median"
    " of the frame."
  )
  caption += f" Of more than {MOST_BARS} cells, the fastest {MOST_BARS}." if cut else ""
  return Plot("stages", "bars", "Where the time goes", caption, "ms", "", panels, rows=stages, y_log=False)
