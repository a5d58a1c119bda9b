"""Plots as files for papers: SVG, PDF and PNG, sized for one column or two, the same bytes for the same rows."""

import io
import math
import os

os.environ["SOURCE_DATE_EPOCH"] = "0"  # or the files would hold the time at which they were made

import warnings

import matplotlib

warnings.filterwarnings("ignore", message="Glyph")  # a name in letters that the font has not: the page has them
matplotlib.use("Agg")
from matplotlib import colors, pyplot
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from . import panels as panels_, scales

COLUMN, GAP = 3.35, 0.2  # inches: a column of a two-column page, and the space between two
PANEL_HEIGHT = 2.1
MOST_PANELS = 6  # of a file; the others go on to the next page
MARKERS = {
  "circle": "o",
  "square": "s",
  "triangle-up": "^",
  "diamond": "D",
  "triangle-down": "v",
  "cross": "P",
  "triangle-right": ">",
}
STYLE = {
  "font.family": "DejaVu Sans",
  "font.size": 7,
  "axes.titlesize": 7,
  "axes.labelsize": 7,
  "xtick.labelsize": 6.5,
  "ytick.labelsize": 6.5,
  "legend.fontsize": 6.5,
  "axes.linewidth": 0.5,
  "axes.edgecolor": "#888888",
  "xtick.major.width": 0.5,
  "ytick.major.width": 0.5,
  "axes.grid": True,
  "grid.color": "#e6e6e6",
  "grid.linewidth": 0.5,
  "axes.axisbelow": True,
  "lines.linewidth": 1.1,
  "lines.markersize": 3.6,
  "legend.frameon": False,
  "text.parse_math": False,  # names are no formulas
  "svg.fonttype": "path",
  "svg.hashsalt": "tessera",
  "pdf.fonttype": 42,
  "savefig.dpi": 200,
}


def numbers(axis, span, ticks, texts, logarithmic):
  if logarithmic:
    axis.axes.set(**{f"{axis.axis_name}scale": "log"})
  axis.axes.set(**{f"{axis.axis_name}lim": span})
  axis.set_ticks(ticks, texts)
  axis.set_ticks([], minor=True)


def words(axis, order):
  axis.set_ticks(range(len(order)), order)


def break_of(axes, plot, spans):
  axes.axhspan(spans["y"][0], plot.zero * panels_.BREAK, color="#f3f1ea", zorder=0.5, linewidth=0)
  axes.axhline(plot.zero * panels_.BREAK, color="#8a8a8a", linewidth=0.7, dashes=(2, 2))


def joined(axes, plot, panel):
  for curve, best, points in panel.lines:
    axes.plot(
      *zip(*points),
      color=panels_.style(plot.curves, curve)[0],
      linewidth=1.1 if best else 0.5,
      alpha=1 if best else 0.4,
    )


def precision(axes, plot, panel, spans):
  ticks = scales.ticks(*spans["x"], True)
  numbers(axes.xaxis, spans["x"], ticks, [scales.text(tick) for tick in ticks], True)
  place = lambda y: y
  if plot.kind == "strip":
    place = plot.rows.index
    words(axes.yaxis, plot.rows)
    axes.set_ylim(len(plot.rows) - 0.5, -0.5)
  else:
    numbers(axes.yaxis, spans["y"], *panels_.error_ticks(spans["y"], plot.zero), True)
  if plot.zero:
    break_of(axes, plot, spans)
  if panel.band:
    axes.axvspan(*panel.band, color="#bbbbbb", alpha=0.45, linewidth=0)
  joined(axes, plot, panel)
  if len(panel.front) > 1:
    axes.step(*zip(*panel.front), where="post", color="#8a8a8a", linewidth=0.8)
  for point in panel.points:
    colour, shape = panels_.style(plot.curves, point.curve)
    axes.plot([point.low, point.high], [place(point.y)] * 2, color=colour, alpha=0.6, linewidth=0.7)
    axes.plot([point.x], [place(point.y)], color=colour, marker=MARKERS[shape], markeredgewidth=0)


def lines(axes, plot, panel, spans):
  is_words = isinstance(plot.ticks[0], str)
  if is_words:
    words(axes.xaxis, plot.labels)
    axes.set_xlim(-0.5, len(plot.ticks) - 0.5)
    if max(map(len, plot.labels)) * len(plot.labels) > 44:
      axes.tick_params(axis="x", labelrotation=30)
  else:
    crowded = sum(map(len, plot.labels)) > 36  # then round numbers, not the values themselves
    ticks = scales.ticks(*spans["x"], plot.x_log) if crowded else plot.ticks
    texts = [scales.text(tick) for tick in ticks] if crowded else plot.labels
    numbers(axes.xaxis, spans["x"], ticks, texts, plot.x_log)
  numbers(axes.yaxis, spans["y"], *panels_.error_ticks(spans["y"], plot.zero), True)
  # Curves stand side by side on an axis of words, as points there are not joined.
  shift = lambda curve: 0.7 * ((plot.curves.index(curve) + 0.5) / len(plot.curves) - 0.5)
  place = lambda x, curve: plot.ticks.index(x) + shift(curve) if is_words else x
  if plot.zero:
    break_of(axes, plot, spans)
  if panel.band:
    axes.axhspan(*panel.band, color="#bbbbbb", alpha=0.45, linewidth=0)
  for x, low, high in panel.bands:
    if is_words:
      axes.add_patch(
        pyplot.Rectangle((plot.ticks.index(x) - 0.4, low), 0.8, high - low, color="#bbbbbb", alpha=0.45, linewidth=0)
      )
    else:
      axes.plot([x, x], [low, high], color="#bbbbbb", alpha=0.45, linewidth=9, solid_capstyle="butt")
  joined(axes, plot, panel)
  for curve, y, _ in panel.levels:
    axes.axhline(y, color=panels_.style(plot.curves, curve)[0], linewidth=0.9, dashes=(4, 2))
  for point in panel.points:
    colour, shape = panels_.style(plot.curves, point.curve)
    x = place(point.x, point.curve)
    axes.plot([x, x], [point.low, point.high], color=colour, alpha=0.6, linewidth=0.7)
    axes.plot([x], [point.y], color=colour, marker=MARKERS[shape], markeredgewidth=0)
  for x in sorted({plot.ticks.index(x) if is_words else x for x, _ in panel.failed}):
    axes.plot([x], [0.035], color="#222222", marker="x", markersize=3, transform=axes.get_xaxis_transform())


def heat(axes, plot, panel, spans):
  norm = colors.LogNorm(*spans["value"])
  scheme = matplotlib.colormaps["cividis_r"]
  words(axes.xaxis, plot.ticks)
  words(axes.yaxis, plot.rows)
  axes.set(xlim=(-0.5, len(plot.ticks) - 0.5), ylim=(len(plot.rows) - 0.5, -0.5))
  axes.grid(False)
  for x, y, value, text, _ in panel.cells:
    column, row = plot.ticks.index(x), plot.rows.index(y)
    axes.add_patch(
      pyplot.Rectangle(
        (column - 0.5, row - 0.5),
        1,
        1,
        facecolor="#eeeeee" if value is None else scheme(norm(value)),
        edgecolor="white",
      )
    )
    axes.text(
      column,
      row,
      text,
      ha="center",
      va="center",
      fontsize=6,
      color="white" if value is not None and norm(value) > 0.5 else "#222222",
    )


def bars(axes, plot, panel, spans):
  order = list(dict.fromkeys(bar for bar, _, _, _ in panel.cells))
  left = dict.fromkeys(order, 0.0)
  cells = {(bar, stage): ms for bar, stage, ms, _ in panel.cells}
  for stage, colour in panels_.stage_colours(plot):
    for row, bar in enumerate(order):
      ms = cells.get((bar, stage), 0)
      axes.barh(row, ms, left=left[bar], height=0.8, color=colour, edgecolor="white", linewidth=0.3)
      left[bar] += ms
  words(axes.yaxis, order)
  axes.set_ylim(len(order) - 0.5, -0.5)
  axes.grid(axis="y", visible=False)


def legend_of(plot):
  if plot.kind == "bars":
    return [Patch(color=colour, label=stage) for stage, colour in panels_.stage_colours(plot)]
  if plot.kind in ("heat", "strip") or len(plot.curves) < 2:
    return []
  handles = []
  for curve in plot.curves:
    colour, shape = panels_.style(plot.curves, curve)
    handles.append(
      Line2D(
        [],
        [],
        color=colour,
        marker=MARKERS[shape],
        markeredgewidth=0,
        label=curve,
        linestyle="-" if plot.kind == "lines" and not isinstance(plot.ticks[0], str) else "",
      )
    )
  return handles


def height_of(plot, panel):
  """Inches of a panel, its title and axis included."""
  if plot.kind == "bars":
    return 0.5 + 0.13 * len({bar for bar, _, _, _ in panel.cells})
  if plot.kind in ("heat", "strip"):
    return 0.65 + 0.22 * len(plot.rows)
  return PANEL_HEIGHT


def draw(plot, panels):
  across = 1 if len(panels) == 1 else 2
  rows = [panels[first : first + across] for first in range(0, len(panels), across)]
  heights = [max(height_of(plot, panel) for panel in row) for row in rows]
  legend = legend_of(plot)
  # Many words with many curves each take the width of a page.
  crowded = plot.kind == "lines" and isinstance(plot.ticks[0], str) and len(plot.ticks) * len(plot.curves) > 30
  width = 2 * COLUMN + GAP if across == 2 or crowded else COLUMN
  longest = max((len(handle.get_label()) for handle in legend), default=1)
  columns = max(1, min(len(legend), int(width / (0.35 + 0.058 * longest)))) if legend else 1
  top = 0.06 + 0.14 * math.ceil(len(legend) / columns)
  figure, grid = pyplot.subplots(
    len(rows),
    across,
    figsize=(width, sum(heights) + top),
    squeeze=False,
    height_ratios=heights,
    layout="constrained",
  )
  figure.get_layout_engine().set(rect=(0, 0, 1, 1 - top / (sum(heights) + top)), w_pad=0.03, h_pad=0.04)
  make = {"precision": precision, "strip": precision, "lines": lines, "heat": heat, "bars": bars}[plot.kind]
  for row, members in enumerate(rows):
    for column in range(across):
      axes = grid[row][column]
      if column >= len(members):
        axes.set_axis_off()
        continue
      panel = members[column]
      make(axes, plot, panel, panels_.spans_of(plot, panel))
      axes.set_title(panel.title)
      axes.set_xlabel(plot.x)
      axes.set_ylabel(plot.y if column == 0 else "")
  if legend:
    figure.legend(
      handles=legend, loc="upper center", ncols=columns, borderaxespad=0.2, columnspacing=1.2, handletextpad=0.5
    )
  return figure


def files(plot):
  """(name, kind, bytes) of a plot's files."""
  pages = [plot.panels[first : first + MOST_PANELS] for first in range(0, len(plot.panels), MOST_PANELS)]
  with matplotlib.rc_context(STYLE):
    for page, panels in enumerate(pages, 1):
      figure = draw(plot, panels)
      figure.draw_without_rendering()
      figure.set_layout_engine("none")  # once is enough for three files
      for kind, metadata in (
        ("svg", {"Date": None, "Creator": None}),
        ("pdf", {"CreationDate": None, "Producer": None, "Creator": None}),
        ("png", {"Software": None}),
      ):
        file = io.BytesIO()
        figure.savefig(file, format=kind, metadata=metadata)
        yield plot.name if page == 1 else f"{plot.name}-page-{page}", kind, file.getvalue()
      pyplot.close(figure)
