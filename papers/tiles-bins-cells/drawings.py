"""The figures of main.typ, as SVG whose text Typst sets in the page's own type."""
import math

import matplotlib
from matplotlib import pyplot
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

import report  # noqa: F401, where tessera_report lies
from tessera_report import figures, panels as panels_, scales

INCH = 2.54
WIDTH = 17.4 / INCH  # of the page's text
# Matplotlib measures text in STIX, which it brings along and which is about as wide as the page's Libertinus.
STYLE = {**figures.STYLE, "font.family": "STIXGeneral", "font.size": 8, "svg.fonttype": "none", "axes.edgecolor": "black",
          "axes.spines.top": False, "axes.spines.right": False, "axes.titlesize": 8, "axes.labelsize": 8, "axes.titlelocation": "left",
          "xtick.labelsize": 7.5, "ytick.labelsize": 7.5, "legend.fontsize": 8, "legend.handlelength": 1.8}
BAND = "#e4e4e4"


def curve(axes, names, name, points, errors=True, **options):
  """Points (x, y, low, high) of one of `names`, whose place gives colour and shape."""
  if not points:
    return
  colour, shape = panels_.style(names, name)
  x, y, low, high = zip(*points)
  axes.plot(x, y, color=colour, marker=figures.MARKERS[shape], label=name, zorder=3, **options)
  if errors:
    axes.vlines(x, low, high, color=colour, linewidth=0.6, zorder=2)


def ratio_axis(axes, values):
  """Logarithmic, with the reference's line, and ticks that can be read."""
  axes.set_yscale("log")
  low, high = scales.domain([*values, 0.97, 1.03], True)
  axes.set_ylim(low, high)
  axes.yaxis.set_major_locator(matplotlib.ticker.FixedLocator(ticks(low, high)))
  axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
  axes.yaxis.set_minor_locator(matplotlib.ticker.NullLocator())
  axes.axhline(1, color="black", linewidth=0.5, zorder=1)


def ticks(low, high):
  """1 and steps around it."""
  for steps in ([1 + 0.05 * i for i in range(-10, 20)], [1 + 0.1 * i for i in range(-8, 30)], [0.2, 0.5, 0.7, 1, 1.5, 2, 3, 5, 7, 10],
                [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100]):
    inside = [round(step, 4) for step in steps if low <= step <= high]
    if 2 < len(inside) <= 7:
      return inside
  return scales.ticks(low, high, True)


def doubling(axes, values, label):
  axes.set_xscale("log", base=2)
  axes.set_xticks(values, [f"{value:,}" for value in values])
  axes.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
  axes.set_xlabel(label)


def powers(axis):
  axis.set_major_locator(LogLocator(10, numticks=9))
  axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.0f}" if value >= 1 else f"{value:g}"))
  axis.set_minor_formatter(NullFormatter())


def panels(figure, rows_, columns, **options):
  axes = figure.subplots(rows_, columns, squeeze=False, **options)
  for index, one in enumerate(axes.flat):
    one.set_axisbelow(True)
    one.set_title(f"({chr(ord('a') + index)})")
  return axes


def title(axes, text):
  axes.set_title(f"{axes.get_title(loc='left')} {text}")


def save(figure, path):
  figure.savefig(path, format="svg", metadata={"Date": None, "Creator": None})
  pyplot.close(figure)
  path.write_text(path.read_text(encoding="utf-8").replace("STIXGeneral", "Libertinus Serif"), encoding="utf-8")


def legend(figure, axes, count):
  handles, labels = axes.get_legend_handles_labels()
  figure.legend(handles, labels, loc="outside upper center", ncols=count)


def tile(path, sweep):
  names = sweep.order("binning")
  tiles = [int(value) for value in sweep.order("tile")]
  figure = pyplot.figure(figsize=(WIDTH, 5.4 / INCH), layout="constrained")
  axes = panels(figure, 1, len(sweep.groups), sharey=True)[0]
  heights = []
  for one, group in zip(axes, sweep.groups):
    title(one, group.values["scene"])
    one.axhspan(1 / group.floor, group.floor, color=BAND, linewidth=0)
    for name in names:
      points = sorted((int(cell.values["tile"]), *shown(cell.ratio)) for cell in group.candidates if cell.values["binning"] == name)
      heights += [value for point in points for value in point[1:]]
      curve(one, names, name, points)
    doubling(one, tiles, "tile edge, pixels")
  for one in axes:
    ratio_axis(one, heights)
  axes[0].set_ylabel("time over the reference's")
  legend(figure, axes[0], len(names))
  save(figure, path)


def shown(ratio):
  return ratio.median, ratio.low, ratio.high


def capacity(path, sweep, places):
  names = ["retry", "drop", "bitmask"]
  capacities = [int(value) for value in sweep.order("capacity")]
  figure = pyplot.figure(figsize=(WIDTH, 8.2 / INCH), layout="constrained")
  axes = panels(figure, 2, len(sweep.groups), sharex=True)
  heights, losses = [], []
  for column, (group, place) in enumerate(zip(sweep.groups, places)):
    times, wrong = axes[0][column], axes[1][column]
    title(times, group.values["scene"])
    title(wrong, group.values["scene"])
    times.axhspan(1 / group.floor, group.floor, color=BAND, linewidth=0)
    for policy in ("retry", "drop"):
      points = sorted((int(cell.values["capacity"]), *shown(cell.ratio)) for cell in group.candidates if cell.values.get("overflow") == policy)
      heights += [value for point in points for value in point[1:]]
      curve(times, names, policy, points, linestyle="--" if policy == "drop" else "-")
    level = next((cell.ratio.median for cell in group.candidates if cell.values["binning"] == "bitmask"), None)
    if level:
      heights.append(level)
      times.axhline(level, color=panels_.style(names, "bitmask")[0], linestyle=":", label="bitmask", zorder=2)
    points = [(line["capacity"]["value"], line["wrong"]["value"], line["wrong"]["least"]["value"], line["wrong"]["most"]["value"])
              for line in place["lines"] if line["wrong"]]
    losses += [point[1] for point in points if point[1] > 0]
    curve(wrong, names, "drop", points, linestyle="--")
  small = 10.0 ** math.floor(math.log10(min(losses, default=1e-3)))
  for times, wrong in axes.T:
    ratio_axis(times, heights)
    # Zero has a place of its own, below the smallest loss.
    wrong.set_yscale("symlog", linthresh=small, linscale=0.5)
    wrong.set_ylim(-0.2 * small, 150)
    decades = [small * 10 ** i for i in range(round(math.log10(100 / small)) + 1)]
    wrong.set_yticks([0, *(decades if len(decades) <= 5 else decades[::2])], ["0", *(f"{value:g}" for value in (decades if len(decades) <= 5 else decades[::2]))])
    wrong.yaxis.set_minor_locator(matplotlib.ticker.NullLocator())
    doubling(wrong, capacities, "capacity, entries a tile")
    wrong.set_xticks(capacities, [f"{value}" if value < 1024 else f"{value // 1024} Ki" for value in capacities])
  for row in axes:
    for one in row[1:]:
      one.tick_params(labelleft=False)
  axes[0][0].set_ylabel("time over that of exact bins")
  axes[1][0].set_ylabel("wrong pixels, % of raster")
  legend(figure, axes[0][0], len(names))
  save(figure, path)


def cells(path, sweep, values):
  names = values["traversals"]
  figure = pyplot.figure(figsize=(WIDTH, 10.6 / INCH), layout="constrained")
  (one, step), (size, tests) = panels(figure, 2, 2, sharex=True)
  groups = sorted(sweep.groups, key=lambda group: float(group.cells[0].values["x"]))
  areas = [float(group.cells[0].values["x"]) for group in groups]
  for axes in (one, step, size):
    axes.fill_between(areas, [1 / group.floor for group in groups], [group.floor for group in groups], color=BAND, linewidth=0)
  plain = lambda cell, traversal: cell.values["traversal"] == traversal and cell.values["step"] == "direct" and cell.values["size-class"] == "off"
  heights = []
  for name in names:
    points = [(area, *shown(cell.ratio)) for area, group in zip(areas, groups) for cell in group.candidates if plain(cell, name)]
    heights += [value for point in points for value in point[1:]]
    curve(one, names, name, points)
    counted = [(line["area"]["value"], line["tests"][names.index(name)]["value"]) for line in values["areas"] if line["tests"][names.index(name)]]
    curve(tests, names, name, [(area, value, value, value) for area, value in counted], errors=False)
  changes = []
  for axes, kind in ((step, "step"), (size, "size-class")):
    for pair in values["pairs"]:
      if pair["kind"] == kind:
        points = [(point["area"], point["ratio"], point["low"], point["high"]) for point in pair["curve"]]
        changes += [value for point in points for value in point[1:]]
        curve(axes, names, pair["traversal"], points)
  ratio_axis(one, heights)
  for axes in (step, size):
    ratio_axis(axes, changes)
  tests.set_yscale("log")
  powers(tests.yaxis)
  tests.yaxis.set_minor_locator(matplotlib.ticker.NullLocator())
  for axes in (one, step, size, tests):
    axes.set_xscale("log")
    powers(axes.xaxis)
    axes.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
  for axes in (size, tests):
    axes.set_xlabel("mean area of a triangle, pixels")
  title(one, "traversals: time over cell-reject's")
  title(step, "step=incremental: time over direct's")
  title(size, "size-class=on: time over off's")
  title(tests, "samples tested for each one covered")
  legend(figure, one, len(names))
  save(figure, path)


def draw(out, tile_, capacity_, pineda, values):
  with matplotlib.rc_context(STYLE):
    tile(out / "tile.svg", tile_)
    capacity(out / "capacity.svg", capacity_, values["capacity"]["places"])
    cells(out / "cells.svg", pineda, values["cells"])
