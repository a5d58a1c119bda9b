"""How numbers and names are written, on the page and in figures."""

import math

# What a field of `error` counts or measures.
ERRORS = {
  "coverage_mismatch": "pixels covered in one image only",
  "id_mismatch": "pixels with another triangle",
  "depth_mismatch": "pixels with another depth",
  "hit_count_mismatch": "pixels with another number of hits",
  "hit_count_not_one": "pixels not hit exactly once",
  "attribute_mismatch": "pixels with another value",
  "winner_mismatch": "pixels won by another triangle",
  "colour_mismatch": "pixels with another colour",
  "attribute_max": "largest error of a value",
  "attribute_rms": "root mean square error of a value",
  "depth_max_ulp": "largest error of depth, ulp",
  "depth_max_abs": "largest error of depth",
  "psnr": "PSNR, dB",
}


def significant(value, digits=3):
  """12345.6 -> "12,300" -> but whole numbers stay whole; 0.012345 -> "0.0123"."""
  if value == 0:
    return "0"
  if value == int(value) and abs(value) < 1e15:
    return f"{int(value):,}"
  if not 1e-4 <= abs(value) < 1e6:
    return f"{value:.{digits - 1}e}"
  return f"{value:,.{max(0, digits - 1 - math.floor(math.log10(abs(value))))}f}"


def percent(factor):
  """A factor's distance from 1: 1.023 -> "2.3 %"."""
  return f"{significant(100 * (factor - 1), 2)} %"


def axis_name(name, sweep):
  if name == "x":
    return sweep.plot.get("x-label", "x")
  return {"size": "raster, pixels", "threads": "threads", "tile": "tile, pixels"}.get(name, name)


def place(name, value):
  return count(int(value), "thread") if name == "threads" else value


def cell_name(cell, axes):
  """The cell's values of some axes: "tile=8 binning=exact"."""
  return " ".join(f"{axis}={cell.values[axis]}" for axis in axes if axis in cell.values) or "the only cell"


def count(number, one, many=None):
  return f"{number:,} {one if number == 1 else many or one + 's'}"


def pixels(number, field):
  """ "1 pixel with another depth", "1,234 pixels ..."."""
  name = ERRORS.get(field, field)
  return f"{significant(number)} {name.replace('pixels', 'pixel', 1) if number == 1 else name}"


def listing(items):
  """ "a", "a and b", "a, b and c"."""
  items = list(items)
  return " and ".join([", ".join(items[:-1]), items[-1]] if len(items) > 1 else items)


def span(values):
  """Of sorted numbers: "1.2", or "1.2 to 3.4"."""
  low, high = significant(values[0]), significant(values[-1])
  return low if low == high else f"{low} to {high}"
