"""What the plots of a sweep share: which cells they show, on which curve and in which panel, and what is said of a cell."""

from . import words
from .rows import PLACES


class Shown:
  """`skipped` has a line for each plot that there is not, with the reason."""

  def __init__(self, sweep, all_devices):
    self.sweep = sweep
    self.skipped = []
    self.curve_axes = [axis for axis in sweep.plot.get("curve", sweep.swept)]
    self.error_name = sweep.plot.get("error", "coverage_mismatch")
    self.sources = [("error", "", "from the cell's own oracle")]
    if sweep.truth:
      self.sources.append(("truth_error", "-truth", self.truth_words()))
      same = all(
        cell.error("error", self.error_name) == cell.error("truth_error", self.error_name) for cell in sweep.cells
      )
      if same:
        self.sources.pop()
        self.skipped.append(
          f"{self.error_name} {self.truth_words()}: the same as from each cell's own oracle, in every cell."
        )
    hidden = [cell for cell in sweep.cells if cell.timed and cell.software and not all_devices]
    self.shown = [cell for cell in sweep.cells if cell.timed and not cell.twin and cell not in hidden]
    if hidden:
      self.skipped.append(
        f"{words.count(len(hidden), 'cell')} of software drivers"
        f" ({words.listing(dict.fromkeys(c.row['provenance'].get('device', '?') for c in hidden))}) are off the"
        " plots of time: they say nothing about a GPU. --all-devices shows them."
      )
    self.hidden_devices = set() if all_devices else {c.values["device"] for c in sweep.cells if c.software}
    self.group_of = {id(cell): group for group in sweep.groups for cell in group.cells}

  def truth_words(self):
    return "from the exact image under " + " ".join(f"{axis}={value}" for axis, value in self.sweep.truth.items())

  def curve(self, cell, without=()):
    """The cell's curve: its values of the curve axes that vary."""
    axes = [axis for axis in self.curve_axes if axis not in without and (axis not in PLACES or self.sweep.varies(axis))]
    if not axes:
      return "all cells"
    return words.cell_name(cell, axes) if any(axis in cell.values for axis in axes) else f"without {words.listing(axes)}"

  def curve_order(self, cells, without=()):
    return list(dict.fromkeys(self.curve(cell, without) for cell in cells))

  def places(self, cells):
    """The places that tell these cells apart; not the threads where machine and device say them."""
    places = [place for place in PLACES if len({cell.values.get(place) for cell in cells}) > 1]
    told = {}
    for cell in cells:
      told.setdefault((cell.machine, cell.values["device"]), set()).add(cell.values.get("threads"))
    return [place for place in places if place != "threads" or any(len(found) > 1 for found in told.values())]

  def split(self, cells, without=()):
    """Cells by the places that are neither curves nor an axis: a panel each, with its title."""
    places = [place for place in self.places(cells) if place not in self.curve_axes and place not in without]
    panels = {}
    for cell in cells:
      panels.setdefault(tuple(cell.values.get(place, "") for place in places), []).append(cell)
    for key, members in panels.items():
      named = [words.place(place, part) for place, part in zip(places, key) if part]
      yield ", ".join(named), members

  def says(self, cell, extra=""):
    places = [place for place in PLACES if self.sweep.varies(place) and place in cell.values]
    text = f"{', '.join(cell.values[place] for place in places)}; " if places else ""
    text += words.cell_name(cell, self.sweep.swept)
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
    groups = {id(self.group_of[id(cell)]): self.group_of[id(cell)] for cell in cells}
    return [group for group in groups.values() if group.reference in cells]

  def time_band(self, cells):
    """The reference's time widened by the noise floor, where the panel has one reference."""
    groups = self.references(cells)
    if len(groups) != 1 or not groups[0].floor:
      return None
    return groups[0].reference.ms / groups[0].floor, groups[0].reference.ms * groups[0].floor

  def put_bands(self, panel, kind, cells, axis, place):
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

  def rest(self):
    """Swept axes whose values are points on a curve."""
    return [axis for axis in self.sweep.swept if axis not in self.curve_axes]

  def band_words(self, panels):
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
