"""What is plotted: the plots that a sweep's rows give, as plain points, lines and bands.

charts.py draws them on the page and figures.py on paper, so that both show the same."""

import math

from panels import Panel, Plot, Point
from refused import Refused
from rows import kPlaces, number
import words

kMostBars = 40
kDevices = ("machine", "device", "threads")


def isLogarithmic(values):
  """Powers of two or ten, and what spreads over more than a decade and a bit."""
  if len(values) < 2 or min(values) <= 0:
    return False
  powers = lambda base: all(abs(math.log(value, base) - round(math.log(value, base))) < 1e-9 for value in values)
  return powers(2) or powers(10) or max(values) / min(values) >= 20


def front(points):
  """Those that no other point beats in time and error both, by time."""
  best, kept = math.inf, []
  for point in sorted(points, key=lambda point: (point.x, point.y)):
    if point.y < best:
      kept.append((point.x, point.y))
      best = point.y
  return kept


class Plots:
  """All plots of a sweep; `skipped` has a line for each that there is not, with the reason."""

  def __init__(self, sweep, allDevices):
    self.sweep = sweep
    self.skipped = []
    self.list = []
    self.curveAxes = [axis for axis in sweep.plot.get("curve", sweep.swept)]
    self.errorName = sweep.plot.get("error", "coverage_mismatch")
    self.sources = [("error", "", "from the cell's own oracle")]
    if sweep.truth:
      self.sources.append(("truth_error", "-truth", self.truthWords()))
      same = all(
        cell.error("error", self.errorName) == cell.error("truth_error", self.errorName) for cell in sweep.cells
      )
      if same:
        self.sources.pop()
        self.skipped.append(
          f"{self.errorName} {self.truthWords()}: the same as from each cell's own oracle, in every cell."
        )
    hidden = [cell for cell in sweep.cells if cell.timed and cell.software and not allDevices]
    self.shown = [cell for cell in sweep.cells if cell.timed and not cell.twin and cell not in hidden]
    if hidden:
      self.skipped.append(
        f"{words.count(len(hidden), 'cell')} of software drivers"
        f" ({words.listing(dict.fromkeys(c.row['provenance'].get('device', '?') for c in hidden))}) are off the"
        " plots of time: they say nothing about a GPU. --all-devices shows them."
      )
    self.hiddenDevices = set() if allDevices else {c.values["device"] for c in sweep.cells if c.software}
    self.groupOf = {id(cell): group for group in sweep.groups for cell in group.cells}
    self.make()

  def make(self):
    for source in self.sources:
      self.precision(*source)
    against = self.sweep.plot.get("against", self.sweep.swept)
    for axis in against:
      self.against(axis, "time")
      self.against(axis, "ratio")
      for source in self.sources:
        self.against(axis, "error", *source)
    for pair in self.sweep.plot.get("heat", []):
      self.heat(*pair)
    self.bars()

  def figure(self):
    """The name of the plot that stands for the experiment: [plot] figure, or the first."""
    asked = self.sweep.plot.get("figure")
    names = [plot.name for plot in self.list]
    if asked is None:
      return names[0] if names else None
    if asked not in names:
      possible = [
        f"{kind}-{axis}"
        for axis in self.sweep.plot.get("against", self.sweep.swept)
        for kind in ("against", "ratio-against", "error-against")
      ]
      possible += ["work-precision", "stages"] + [
        f"heat-{across}-{down}" for across, down in self.sweep.plot.get("heat", [])
      ]
      if asked.removesuffix("-truth") not in possible:
        raise Refused(
          f'{self.sweep.folder / "sweep.toml"}: plot.figure: "{asked}" is no plot of this sweep; one of'
          f" {', '.join(names or possible)} would do"
        )
      if not any(line.startswith(asked + ":") for line in self.skipped):
        self.skipped.append(f"{asked}: no cell has what it shows.")
      return None
    return asked

  # -- what the plots share

  def truthWords(self):
    return "from the exact image under " + " ".join(f"{axis}={value}" for axis, value in self.sweep.truth.items())

  def curve(self, cell, without=()):
    """The cell's curve: its values of the curve axes that vary."""
    axes = [axis for axis in self.curveAxes if axis not in without and (axis not in kPlaces or self.sweep.varies(axis))]
    if not axes:
      return "all cells"
    return words.cellName(cell, axes) if any(axis in cell.values for axis in axes) else f"without {words.listing(axes)}"

  def curveOrder(self, cells, without=()):
    return list(dict.fromkeys(self.curve(cell, without) for cell in cells))

  def places(self, cells):
    """The places that tell these cells apart; not the threads where machine and device say them."""
    places = [place for place in kPlaces if len({cell.values.get(place) for cell in cells}) > 1]
    told = {}
    for cell in cells:
      told.setdefault((cell.machine, cell.values["device"]), set()).add(cell.values.get("threads"))
    return [place for place in places if place != "threads" or any(len(found) > 1 for found in told.values())]

  def split(self, cells, without=()):
    """Cells by the places that are neither curves nor an axis: a panel each, with its title."""
    places = [place for place in self.places(cells) if place not in self.curveAxes and place not in without]
    panels = {}
    for cell in cells:
      panels.setdefault(tuple(cell.values.get(place, "") for place in places), []).append(cell)
    for key, members in panels.items():
      named = [words.place(place, part) for place, part in zip(places, key) if part]
      yield ", ".join(named), members

  def says(self, cell, extra=""):
    places = [place for place in kPlaces if self.sweep.varies(place) and place in cell.values]
    text = f"{', '.join(cell.values[place] for place in places)}; " if places else ""
    text += words.cellName(cell, self.sweep.swept)
    if cell.timed:
      middle, low, high = cell.spread
      text += f": {words.significant(middle)} ms ({words.significant(low)} to {words.significant(high)})"
      if cell.ratio and not cell.reference:
        text += f", {words.significant(cell.ratio.median)} x the reference ({cell.ratio.verdict})"
      elif cell.reference:
        text += ", the reference"
    return text + extra

  def references(self, cells):
    """The references, timed and shown, of the cells' groups."""
    groups = {id(self.groupOf[id(cell)]): self.groupOf[id(cell)] for cell in cells}
    return [group for group in groups.values() if group.reference in cells]

  def timeBand(self, cells):
    """The reference's time widened by the noise floor, where the panel has one reference."""
    groups = self.references(cells)
    if len(groups) != 1 or not groups[0].floor:
      return None
    return groups[0].reference.ms / groups[0].floor, groups[0].reference.ms * groups[0].floor

  def putBands(self, panel, kind, cells, axis, place):
    """The noise floor around each reference: across the panel where it has one, else at the references' places."""
    found = []
    for group in self.references(cells):
      if group.floor:
        middle = group.reference.ms if kind == "time" else 1
        found.append((group.reference.values.get(axis), middle / group.floor, middle * group.floor))
    if len(self.references(cells)) == 1:
      panel.band = found[0][1:] if found else None
    else:
      panel.bands = [(place[value], low, high) for value, low, high in found if value in place]

  # -- error against time

  def precision(self, source, suffix, origin):
    name = f"work-precision{suffix}"
    what = words.kErrors.get(self.errorName, self.errorName)
    measured = [cell for cell in self.shown if cell.error(source, self.errorName) is not None]
    if not measured:
      if suffix == "" and self.shown:
        self.skipped.append(f"{name}: no cell has {source}.{self.errorName}, so there is no work-precision plot.")
        self.strip("work-precision", self.shown)
      elif self.shown:
        self.skipped.append(f"{name}: no cell has {source}.{self.errorName}.")
      else:
        self.skipped.append(f"{name}: no cell has a time that may be shown.")
      return
    errors = [abs(cell.error(source, self.errorName)) for cell in measured]
    positive = [error for error in errors if error > 0]
    if not positive:
      self.skipped.append(
        f"{name}: no cell has an error {origin} ({what}: 0 everywhere), so there is no work-precision plot"
        + ("; their times stand on a line instead." if suffix == "" else ".")
      )
      if suffix == "":
        self.strip("work-precision", measured)
      return
    zero = 10.0 ** (math.floor(math.log10(min(positive))) - 1) if len(positive) < len(errors) else None
    panels = []
    for title, cells in self.split(measured):
      panel = Panel(title, band=self.timeBand(cells))
      for cell in cells:
        error = abs(cell.error(source, self.errorName))
        _, low, high = cell.spread
        panel.points.append(
          Point(
            cell.ms,
            error if error > 0 else zero,
            low,
            high,
            self.curve(cell),
            self.says(cell, f"; {what}: {words.significant(error)}"),
          )
        )
      panel.lines = self.paths(cells, panel.points)
      panel.front = front(panel.points)
      panels.append(panel)
    caption = (
      f"{what.capitalize()} {origin}, against the median time of a frame; bars span the quartiles of the time."
      f" {self.pathWords()}The stepped grey line is the Pareto front: no cell is both faster and nearer to right"
      " than those on it. "
    )
    caption += "Errors of 0 stand below the break. " if zero else ""
    caption += self.bandWords(panels)
    self.list.append(
      Plot(
        name,
        "precision",
        f"Error against time, {origin}" if suffix else "Error against time",
        caption.strip(),
        "time of a frame, ms",
        what,
        panels,
        self.curveOrder(measured),
        xLog=True,
        zero=zero,
      )
    )

  def rest(self):
    """Swept axes whose values are points on a curve."""
    return [axis for axis in self.sweep.swept if axis not in self.curveAxes]

  def paths(self, cells, points):
    """Each curve's points joined in the order of the one axis that varies along it, if it is one of numbers."""
    if len(self.rest()) != 1 or None in [number(self.rest()[0], value) for value in self.sweep.order(self.rest()[0])]:
      return []
    order = self.sweep.order(self.rest()[0])
    paths = {}
    for cell, point in zip(cells, points):
      if self.rest()[0] in cell.values:
        key = (point.curve, *(cell.values.get(place) for place in kPlaces))
        paths.setdefault(key, []).append((order.index(cell.values[self.rest()[0]]), (point.x, point.y)))
    return [(curve, False, [place for _, place in sorted(path)]) for (curve, *_), path in paths.items()]

  def pathWords(self):
    return (
      f"A curve's points are joined in the order of {self.rest()[0]}. "
      if any(self.paths(self.shown, [Point(0, 0, 0, 0, self.curve(cell), "") for cell in self.shown]))
      else ""
    )

  def strip(self, name, measured):
    """Times alone, a line a curve: what is left of error against time where nothing has an error."""
    axes = [axis for axis in self.curveAxes if axis not in kPlaces or self.sweep.varies(axis)]
    short = lambda cell: ", ".join(cell.values[axis] for axis in axes if axis in cell.values) or self.curve(cell)
    panels = []
    for title, cells in self.split(measured):
      panel = Panel(title, band=self.timeBand(cells))
      for cell in cells:
        _, low, high = cell.spread
        panel.points.append(Point(cell.ms, short(cell), low, high, self.curve(cell), self.says(cell)))
      panels.append(panel)
    anyError = any(cell.error("error", self.errorName) is not None for cell in measured)
    if not anyError:
      caption = "Times alone; "
    elif any(cell.mismatches() for cell in measured):
      what = words.kErrors.get(self.errorName, self.errorName)
      caption = f"No cell has an error of this kind ({what}), though some have others: the table has them; "
    else:
      caption = "Every image is the oracle's, so only times differ; "
    caption += "bars span their quartiles. " + self.bandWords(panels)
    caption += f" Lines are named by {words.listing(axes)}." if axes else ""
    curves = self.curveOrder(measured)
    self.list.append(
      Plot(
        name,
        "strip",
        "Times, all with an error of 0" if anyError else "Times",
        caption.strip(),
        "time of a frame, ms",
        "",
        panels,
        curves,
        xLog=True,
        rows=list(dict.fromkeys(map(short, measured))),
      )
    )

  def bandWords(self, panels):
    if not any(panel.band or panel.bands for panel in panels):
      return ""
    if any(panel.bands for panel in panels):
      return (
        "A grey bar is the A/A noise floor around the reference there: what lies in it equals the reference as"
        " far as this sweep can tell."
      )
    return (
      "The grey band is the A/A noise floor around the reference: what lies in it equals the reference as far as"
      " this sweep can tell."
    )

  # -- time, ratio and error against an axis

  def against(self, axis, kind, source="error", suffix="", origin=""):
    name = {"time": "against", "ratio": "ratio-against", "error": "error-against"}[kind] + f"-{axis}{suffix}"
    cells = self.shown
    if kind == "ratio":
      cells = [cell for cell in cells if cell.ratio]
    if kind == "error":
      # An error is as true on a software driver.
      cells = [
        cell
        for cell in self.sweep.cells
        if cell.status == "ok" and not cell.twin and cell.error(source, self.errorName) is not None
      ]
      if all(cell.error(source, self.errorName) == 0 for cell in cells):
        if cells and self.sweep.plot.get("figure") == name:
          self.skipped.append(f"{name}: no cell has an error {origin}.")
        return
    placed = [cell for cell in cells if axis in cell.values]
    found = list(dict.fromkeys(cell.values[axis] for cell in placed))
    if len(found) < 2:
      self.skipped.append(
        f"{name}:"
        f" {'no cell with a time' if not found else 'no more than one value of ' + axis + ' with a time'}"
        f"{', ' + axis + '=' + found[0] if found else ''}."
        if kind != "error"
        else f"{name}: fewer than two values of {axis}."
      )
      return
    order = [value for value in self.sweep.order(axis) if value in found]
    numbers = [number(axis, value) for value in order]
    words_ = None in numbers
    place = dict(zip(order, order if words_ else numbers))
    taken = (axis, "scene") if axis == "x" else (axis,)
    rest = [other for other in self.rest() if other != axis]
    if kind == "error" and self.agree(cells, source, taken):
      taken += kDevices
    panels = []
    for title, members in self.split(cells, taken):
      panel = Panel(title)
      series = {}
      for cell in members:
        curve = self.curve(cell, taken)
        y, low, high, says = self.height(cell, kind, source)
        if axis not in cell.values:
          panel.levels.append((curve, y, says))
          continue
        x = place[cell.values[axis]]
        panel.points.append(Point(x, y, low, high, curve, says))
        key = tuple(cell.values.get(name, "") for name in (*rest, *kPlaces) if name not in taken)
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
        self.putBands(panel, kind, members, axis, place)
      panels.append(panel)
      if kind != "error":
        panel.failed = self.failures(axis, taken, title, place)
    panels = [panel for panel in panels if panel.points]
    what = {
      "time": "time of a frame, ms",
      "ratio": "time over the reference's",
      "error": words.kErrors.get(self.errorName, self.errorName),
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
      caption += self.bandWords(panels)
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
    ] + f" against {axis if axis != 'x' else words.axisName(axis, self.sweep)}"
    self.list.append(
      Plot(
        name,
        "lines",
        title + (f", {origin}" if suffix else ""),
        caption.strip(),
        words.axisName(axis, self.sweep),
        what,
        panels,
        self.curveOrder(cells, taken),
        list(place.values()),
        (
          [value.replace(" x ", "\u00d7") for value in order]
          if words_ or axis != "size"
          else [f"{value:g}" for value in place.values()]
        ),
        not words_ and isLogarithmic(numbers),
        True,
        zero,
      )
    )

  def agree(self, cells, source, taken):
    """Whether every device and machine has the same error for the same cell."""
    found = {}
    for cell in cells:
      key = tuple(sorted((name, value) for name, value in cell.values.items() if name not in kDevices))
      found.setdefault(key, set()).add(cell.error(source, self.errorName))
    return not set(kDevices) & {*self.curveAxes, *taken} and all(len(errors) == 1 for errors in found.values())

  def height(self, cell, kind, source):
    if kind == "time":
      return *cell.spread, self.says(cell)
    if kind == "ratio":
      return cell.ratio.median, cell.ratio.low, cell.ratio.high, self.says(cell)
    error = abs(cell.error(source, self.errorName))
    samples = (
      [abs(value) for value in cell.row.get("error_samples", {}).get(self.errorName, []) if value is not None]
      if source == "error"
      else []
    )
    says = self.says(cell, f"; {words.kErrors.get(self.errorName, self.errorName)}: {words.significant(error)}")
    return error, min(samples, default=error), max(samples, default=error), says

  def failures(self, axis, taken, title, place):
    failed = [
      cell
      for cell in self.sweep.cells
      if not cell.timed
      and not cell.twin
      and cell.values.get(axis) in place
      and not (cell.values["device"] in self.hiddenDevices)
    ]
    found = []
    for other, members in self.split(failed, taken):
      if other == title:
        found += [(place[cell.values[axis]], f"{self.says(cell)}: {cell.status}, {cell.message}") for cell in members]
    return found

  # -- two axes at once

  def heat(self, across, down):
    name = f"heat-{across}-{down}"
    cells = [cell for cell in self.shown if cell.ratio and across in cell.values and down in cell.values]
    columns = [value for value in self.sweep.order(across) if any(cell.values[across] == value for cell in cells)]
    lines = [value for value in self.sweep.order(down) if any(cell.values[down] == value for cell in cells)]
    if len(columns) < 2 or len(lines) < 2:
      self.skipped.append(
        f"{name}: fewer than two values of {across if len(columns) < 2 else down} with a ratio to the reference."
      )
      return
    every = [
      cell
      for cell in self.sweep.cells
      if not cell.twin
      and across in cell.values
      and down in cell.values
      and cell.values["device"] not in self.hiddenDevices
    ]
    columns, lines = ([v for v in self.sweep.order(a) if any(c.values[a] == v for c in every)] for a in (across, down))
    places = [place for place in self.places(every) if place not in (across, down)]
    panels = {}
    for cell in every:
      key = tuple(cell.values.get(place, "") for place in places)
      panels.setdefault(key, {}).setdefault((cell.values[across], cell.values[down]), []).append(cell)
    list_ = []
    for key, places_ in panels.items():
      panel = Panel(", ".join(words.place(place, part) for place, part in zip(places, key) if part))
      for (column, line), members in places_.items():
        timed = [cell for cell in members if cell.ratio]
        if timed:
          best = min(timed, key=lambda cell: cell.ratio.median)
          panel.cells.append((column, line, best.ratio.median, words.significant(best.ratio.median), self.says(best)))
        else:
          panel.cells.append(
            (
              column,
              line,
              None,
              members[0].status,
              f"{self.says(members[0])}: {members[0].status}, {members[0].message}",
            )
          )
      if any(value is not None for _, _, value, _, _ in panel.cells):
        list_.append(panel)
    rest = [axis for axis in self.sweep.swept if axis not in (across, down)]
    caption = "Time of a frame over the reference's in the same round, medians: below 1 is faster. "
    caption += f"Each field has the fastest over {words.listing(rest)}. " if rest else ""
    self.list.append(
      Plot(
        name,
        "heat",
        f"{across} and {down}",
        caption.strip(),
        words.axisName(across, self.sweep),
        words.axisName(down, self.sweep),
        list_,
        ticks=columns,
        rows=lines,
      )
    )

  # -- stages

  def bars(self):
    cells = [cell for cell in self.shown if cell.row["time_ns"].get("stages")]
    if not cells:
      self.skipped.append("stages: no cell has times of stages that may be shown.")
      return
    stages = list(dict.fromkeys(stage for cell in cells for stage in cell.row["time_ns"]["stages"]))
    places = self.places(cells)
    panels, cut = [], False
    for group in self.sweep.groups:
      members = [cell for cell in group.cells if cell in cells]
      if len(members) > kMostBars:
        members, cut = (
          sorted(sorted(members, key=lambda cell: cell.ms)[:kMostBars], key=lambda cell: cell.number),
          True,
        )
      if not members:
        continue
      values = group.values
      axes = [axis for axis in self.sweep.swept if any(axis in cell.values for cell in members)]
      panel = Panel(", ".join(words.place(name, values[name]) for name in places if name in values))
      for cell in members:
        bar = ", ".join(cell.values.get(axis, "\u2013") for axis in axes) or "the only cell"
        for stage, ns in cell.row["time_ns"]["stages"].items():
          panel.cells.append((bar, stage, ns / 1e6, f"{bar}: {stage} {words.significant(ns / 1e6)} ms"))
      panels.append(panel)
    names = f" ({', '.join(self.sweep.swept)})" if self.sweep.swept else ""
    caption = (
      f"Medians of the stages, one bar a cell{names}, in the sweep's order. Medians need not add up to the median"
      " of the frame."
    )
    caption += f" Of more than {kMostBars} cells, the fastest {kMostBars}." if cut else ""
    self.list.append(Plot("stages", "bars", "Where the time goes", caption, "ms", "", panels, rows=stages, yLog=False))
