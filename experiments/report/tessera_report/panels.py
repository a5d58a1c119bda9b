"""What a plot is made of: points, lines, bands and their scales, before anything is drawn."""

from dataclasses import dataclass, field

from . import scales

# Okabe and Ito's colours for all kinds of sight, without the yellow, which is too light for lines on white. Shapes tell
# the same.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#E69F00", "#CC79A7", "#56B4E9", "#000000"]
SHAPES = ["circle", "square", "triangle-up", "diamond", "triangle-down", "cross", "triangle-right"]
# Neighbours in a bar differ in lightness, too.
STAGE_COLOURS = [
  "#0072B2",
  "#E69F00",
  "#009E73",
  "#CC79A7",
  "#56B4E9",
  "#D55E00",
  "#999999",
  "#7FB8D8",
  "#F2CF7F",
  "#7FCEB9",
  "#E5BCD3",
  "#AADAF4",
  "#EAAE7F",
  "#444444",
]
BREAK = 3.2  # of an error axis: this far above where 0 is drawn, which is at least a decade below the least error


@dataclass
class Point:
  x: object  # a number, or a word on an axis of words
  y: object
  low: float  # the spread, along the axis of time, ratio or error
  high: float
  curve: str
  says: str  # for a tooltip


@dataclass
class Panel:
  title: str
  points: list = field(default_factory=list)
  lines: list = field(default_factory=list)  # (curve, whether it is the fastest over what is not drawn apart, [(x, y)])
  levels: list = field(default_factory=list)  # (curve, y): cells that have no value on the x axis
  band: tuple | None = None  # the noise floor around the reference, on the axis of time or ratio
  bands: list = field(default_factory=list)  # (x, low, high): the same where each x has a reference of its own
  front: list = field(default_factory=list)  # the Pareto front's points, by time
  failed: list = field(default_factory=list)  # (x, says): cells without a time
  cells: list = field(default_factory=list)  # heat: (x, y, value or None, text, says); bars: (bar, stage, ms, says)
  floor: float | None = None


@dataclass
class Plot:
  name: str  # of its figure
  kind: str  # precision, strip, lines, heat or bars
  title: str
  caption: str
  x: str  # titles of the axes
  y: str
  panels: list
  curves: list = field(default_factory=list)  # in the legend's order
  ticks: list = field(default_factory=list)  # values of the x axis: numbers or words
  labels: list = field(default_factory=list)  # their texts
  x_log: bool = False
  y_log: bool = True
  zero: float | None = None  # where an error of 0 is drawn, below a break of the axis
  rows: list = field(default_factory=list)  # heat: values of the y axis; bars: stages


def stage_colours(plot):
  """(stage, colour) of each stage of a plot of bars."""
  return [(stage, STAGE_COLOURS[index % len(STAGE_COLOURS)]) for index, stage in enumerate(plot.rows)]


def style(curves, curve):
  index = curves.index(curve)
  return COLOURS[index % len(COLOURS)], SHAPES[(index + index // len(COLOURS)) % len(SHAPES)]


def error_ticks(span, zero):
  """Ticks and labels of an axis of errors, whose zero is drawn at `zero`, or of another logarithmic one."""
  if zero is None:
    found = scales.ticks(*span, True)
    return found, [scales.text(tick) for tick in found]
  found = scales.powers(zero * 10, span[1])
  return [zero, *found], ["0", *(scales.text(tick) for tick in found)]


def spans_of(plot, panel):
  """Domains of the axes. Times are each panel's own; ratios and errors are the same in all, to be compared."""
  spans = {}
  if plot.kind == "heat":
    values = [value for other in plot.panels for _, _, value, _, _ in other.cells if value is not None]
    return {"value": (min(values), max(max(values), min(values) * 1.01))}
  if plot.kind == "bars":
    return spans

  def heights(members):
    found = [
      v for other in members for p in other.points for v in (p.y, p.low, p.high) if plot.kind == "lines" or v == p.y
    ]
    found += [y for other in members for _, y, _ in other.levels] + [
      v
      for other in members
      for v in (*(other.band or ()), *(edge for _, *edges in other.bands for edge in edges))
      if plot.kind == "lines"
    ]
    return found

  if plot.kind in ("precision", "strip"):
    spans["x"] = scales.domain([v for p in panel.points for v in (p.x, p.low, p.high)] + list(panel.band or ()), True)
    if plot.kind == "precision":
      spans["y"] = scales.domain(heights(plot.panels), True)
  else:
    if not isinstance(plot.ticks[0], str):
      spans["x"] = scales.domain(plot.ticks, plot.x_log)
    shared = not plot.name.startswith("against")
    low, high = scales.domain([v for v in heights(plot.panels if shared else [panel]) if v > 0], True)
    spans["y"] = (low, max(high, low * 1.2))
  if plot.zero:
    spans["y"] = (plot.zero / 2, max(spans["y"][1], plot.zero * 30))
  return spans
