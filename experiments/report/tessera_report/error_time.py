"""Error against time, and times alone where nothing has an error."""

import math

from . import words
from .panels import Panel, Plot, Point
from .rows import PLACES, number


def front(points):
  """Those that no other point beats in time and error both, by time."""
  best, kept = math.inf, []
  for point in sorted(points, key=lambda point: (point.x, point.y)):
    if point.y < best:
      kept.append((point.x, point.y))
      best = point.y
  return kept


def precision(of, source, suffix, origin):
  name = f"work-precision{suffix}"
  what = words.ERRORS.get(of.error_name, of.error_name)
  measured = [cell for cell in of.shown if cell.error(source, of.error_name) is not None]
  if not measured:
    if suffix == "" and of.shown:
      of.skipped.append(f"{name}: no cell has {source}.{of.error_name}, so there is no work-precision plot.")
      return strip(of, "work-precision", of.shown)
    if of.shown:
      of.skipped.append(f"{name}: no cell has {source}.{of.error_name}.")
    else:
      of.skipped.append(f"{name}: no cell has a time that may be shown.")
    return None
  errors = [abs(cell.error(source, of.error_name)) for cell in measured]
  positive = [error for error in errors if error > 0]
  if not positive:
    of.skipped.append(
      f"{name}: no cell has an error {origin} ({what}: 0 everywhere), so there is no work-precision plot"
      + ("; their times stand on a line instead." if suffix == "" else ".")
    )
    return strip(of, "work-precision", measured) if suffix == "" else None
  zero = 10.0 ** (math.floor(math.log10(min(positive))) - 1) if len(positive) < len(errors) else None
  panels = []
  for title, cells in of.split(measured):
    panel = Panel(title, band=of.time_band(cells))
    for cell in cells:
      error = abs(cell.error(source, of.error_name))
      _, low, high = cell.spread
      panel.points.append(
        Point(
          cell.ms,
          error if error > 0 else zero,
          low,
          high,
          of.curve(cell),
          of.says(cell, f"; {what}: {words.significant(error)}"),
        )
      )
    panel.lines = paths(of, cells, panel.points)
    panel.front = front(panel.points)
    panels.append(panel)
  caption = (
    f"{what.capitalize()} {origin}, against the median time of a frame; bars span the quartiles of the time."
    f" {path_words(of)}The stepped grey line is the Pareto front: no cell is both faster and nearer to right"
    " than those on it. "
  )
  caption += "Errors of 0 stand below the break. " if zero else ""
  caption += of.band_words(panels)
  return Plot(
    name,
    "precision",
    f"Error against time, {origin}" if suffix else "Error against time",
    caption.strip(),
    "time of a frame, ms",
    what,
    panels,
    of.curve_order(measured),
    x_log=True,
    zero=zero,
  )


def paths(of, cells, points):
  """Each curve's points joined in the order of the one axis that varies along it, if it is one of numbers."""
  if len(of.rest()) != 1 or None in [number(of.rest()[0], value) for value in of.sweep.order(of.rest()[0])]:
    return []
  order = of.sweep.order(of.rest()[0])
  paths = {}
  for cell, point in zip(cells, points):
    if of.rest()[0] in cell.values:
      key = (point.curve, *(cell.values.get(place) for place in PLACES))
      paths.setdefault(key, []).append((order.index(cell.values[of.rest()[0]]), (point.x, point.y)))
  return [(curve, False, [place for _, place in sorted(path)]) for (curve, *_), path in paths.items()]


def path_words(of):
  return (
    f"A curve's points are joined in the order of {of.rest()[0]}. "
    if any(paths(of, of.shown, [Point(0, 0, 0, 0, of.curve(cell), "") for cell in of.shown]))
    else ""
  )


def strip(of, name, measured):
  """Times alone, a line a curve: what is left of error against time where nothing has an error."""
  axes = [axis for axis in of.curve_axes if axis not in PLACES or of.sweep.varies(axis)]
  short = lambda cell: ", ".join(cell.values[axis] for axis in axes if axis in cell.values) or of.curve(cell)
  panels = []
  for title, cells in of.split(measured):
    panel = Panel(title, band=of.time_band(cells))
    for cell in cells:
      _, low, high = cell.spread
      panel.points.append(Point(cell.ms, short(cell), low, high, of.curve(cell), of.says(cell)))
    panels.append(panel)
  any_error = any(cell.error("error", of.error_name) is not None for cell in measured)
  if not any_error:
    caption = "Times alone; "
  elif any(cell.mismatches() for cell in measured):
    what = words.ERRORS.get(of.error_name, of.error_name)
    caption = f"No cell has an error of this kind ({what}), though some have others: the table has them; "
  else:
    caption = "Every image is the oracle's, so only times differ; "
  caption += "bars span their quartiles. " + of.band_words(panels)
  caption += f" Lines are named by {words.listing(axes)}." if axes else ""
  curves = of.curve_order(measured)
  return Plot(
    name,
    "strip",
    "Times, all with an error of 0" if any_error else "Times",
    caption.strip(),
    "time of a frame, ms",
    "",
    panels,
    curves,
    x_log=True,
    rows=list(dict.fromkeys(map(short, measured))),
  )
