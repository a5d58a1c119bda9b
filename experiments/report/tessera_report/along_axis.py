"""Time, ratio and error along an axis."""

import math

from . import words
from .panels import Panel, Plot, Point
from .rows import PLACES, number

DEVICES = ("machine", "device", "threads")


def is_logarithmic(values):
  """Powers of two or ten, and what spreads over more than a decade and a bit."""
  if len(values) < 2 or min(values) <= 0:
    return False
  powers = lambda base: all(abs(math.log(value, base) - round(math.log(value, base))) < 1e-9 for value in values)
  return powers(2) or powers(10) or max(values) / min(values) >= 20


def against(of, axis, kind, source="error", suffix="", origin=""):
  name = {"time": "against", "ratio": "ratio-against", "error": "error-against"}[kind] + f"-{axis}{suffix}"
  cells = of.shown
  if kind == "ratio":
    cells = [cell for cell in cells if cell.ratio]
  if kind == "error":
    # An error is as true on a software driver.
    cells = [
      cell
      for cell in of.sweep.cells
      if cell.status == "ok" and not cell.twin and cell.error(source, of.error_name) is not None
    ]
    if all(cell.error(source, of.error_name) == 0 for cell in cells):
      if cells and of.sweep.plot.get("figure") == name:
        of.skipped.append(f"{name}: no cell has an error {origin}.")
      return None
  placed = [cell for cell in cells if axis in cell.values]
  found = list(dict.fromkeys(cell.values[axis] for cell in placed))
  if len(found) < 2:
    of.skipped.append(
      f"{name}:"
      f" {'no cell with a time' if not found else 'no more than one value of ' + axis + ' with a time'}"
      f"{', ' + axis + '=' + found[0] if found else ''}."
      if kind != "error"
      else f"{name}: fewer than two values of {axis}."
    )
    return None
  order = [value for value in of.sweep.order(axis) if value in found]
  numbers = [number(axis, value) for value in order]
  words_ = None in numbers
  place = dict(zip(order, order if words_ else numbers))
  taken = (axis, "scene") if axis == "x" else (axis,)
  rest = [other for other in of.rest() if other != axis]
  if kind == "error" and agree(of, cells, source, taken):
    taken += DEVICES
  panels = []
  for title, members in of.split(cells, taken):
    panel = Panel(title)
    series = {}
    for cell in members:
      curve = of.curve(cell, taken)
      y, low, high, says = height(of, cell, kind, source)
      if axis not in cell.values:
        panel.levels.append((curve, y, says))
        continue
      x = place[cell.values[axis]]
      panel.points.append(Point(x, y, low, high, curve, says))
      key = tuple(cell.values.get(name, "") for name in (*rest, *PLACES) if name not in taken)
      line = series.setdefault((curve, key), [])
      line += [(x, y)] if (x, y) not in line else []
    if not words_:
      for (curve, _), points in series.items():
        panel.lines.append((curve, kind == "error", sorted(points)))
      for curve in dict.fromkeys(curve for curve, _ in series if kind != "error"):
        best = {}
        for (other, _), points in series.items():
          for x, y in points if other == curve else ():
            best[x] = min(y, best.get(x, y))
        panel.lines.append((curve, True, sorted(best.items())))
    if kind != "error":
      of.put_bands(panel, kind, members, axis, place)
    panels.append(panel)
    if kind != "error":
      panel.failed = failures(of, axis, taken, title, place)
  panels = [panel for panel in panels if panel.points]
  what = {
    "time": "time of a frame, ms",
    "ratio": "time over the reference's",
    "error": words.ERRORS.get(of.error_name, of.error_name),
  }[kind]
  caption = {
    "time": "Median time of a frame; bars span the quartiles. ",
    "ratio": "Time of a frame over the reference's in the same round: medians, and quartiles as bars. ",
    "error": f"{what.capitalize()} {origin}. ",
  }[kind]
  if rest and kind == "error":
    caption += f"A curve has a line for each value of {words.listing(rest)}. "
  elif rest and not words_:
    caption += f"Each curve is the best over {words.listing(rest)}; faint lines are the single values. "
  elif rest:
    caption += f"A curve has a point for each value of {words.listing(rest)}. "
  if any(panel.levels for panel in panels):
    caption += f"Level lines are cells that have no {axis}. "
  if any(panel.failed for panel in panels):
    caption += "A cross at the foot is a cell without a time; the table says why. "
  if kind != "error":
    caption += of.band_words(panels)
  if kind == "error":
    exact = [
      panel
      for panel in panels
      if not any(point.y for point in panel.points) and not any(y for _, y, _ in panel.levels)
    ]
    panels = [panel for panel in panels if panel not in exact]
    caption += f"Nowhere an error, and so no plot: {words.listing(panel.title for panel in exact)}. " if exact else ""
  heights = [point.y for panel in panels for point in panel.points] + [
    y for panel in panels for _, y, _ in panel.levels
  ]
  zero = None
  if kind == "error" and min(heights) == 0:
    zero = 10.0 ** (math.floor(math.log10(min(y for y in heights if y > 0))) - 1)
    caption += "Errors of 0 stand below the break. "
    lift = lambda y: y if y > 0 else zero
    for panel in panels:
      for point in panel.points:
        point.y, point.low, point.high = lift(point.y), lift(point.low), lift(point.high)
      panel.lines = [(curve, best, [(x, lift(y)) for x, y in points]) for curve, best, points in panel.lines]
      panel.levels = [(curve, lift(y), says) for curve, y, says in panel.levels]
  title = {"time": "Time", "ratio": "Ratio to the reference", "error": "Error"}[
    kind
  ] + f" against {axis if axis != 'x' else words.axis_name(axis, of.sweep)}"
  return Plot(
    name,
    "lines",
    title + (f", {origin}" if suffix else ""),
    caption.strip(),
    words.axis_name(axis, of.sweep),
    what,
    panels,
    of.curve_order(cells, taken),
    list(place.values()),
    (
      [value.replace(" x ", "\u00d7") for value in order]
      if words_ or axis != "size"
      else [f"{value:g}" for value in place.values()]
    ),
    not words_ and is_logarithmic(numbers),
    True,
    zero,
  )


def agree(of, cells, source, taken):
  """Whether every device and machine has the same error for the same cell."""
  found = {}
  for cell in cells:
    key = tuple(sorted((name, value) for name, value in cell.values.items() if name not in DEVICES))
    found.setdefault(key, set()).add(cell.error(source, of.error_name))
  return not set(DEVICES) & {*of.curve_axes, *taken} and all(len(errors) == 1 for errors in found.values())


def height(of, cell, kind, source):
  if kind == "time":
    return *cell.spread, of.says(cell)
  if kind == "ratio":
    return cell.ratio.median, cell.ratio.low, cell.ratio.high, of.says(cell)
  error = abs(cell.error(source, of.error_name))
  samples = (
    [abs(value) for value in cell.row.get("error_samples", {}).get(of.error_name, []) if value is not None]
    if source == "error"
    else []
  )
  says = of.says(cell, f"; {words.ERRORS.get(of.error_name, of.error_name)}: {words.significant(error)}")
  return error, min(samples, default=error), max(samples, default=error), says


def failures(of, axis, taken, title, place):
  failed = [
    cell
    for cell in of.sweep.cells
    if not cell.timed
    and not cell.twin
    and cell.values.get(axis) in place
    and not (cell.values["device"] in of.hidden_devices)
  ]
  found = []
  for other, members in of.split(failed, taken):
    if other == title:
      found += [(place[cell.values[axis]], f"{of.says(cell)}: {cell.status}, {cell.message}") for cell in members]
  return found
