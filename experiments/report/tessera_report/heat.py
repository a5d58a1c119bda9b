"""Two axes at once: the ratio of each pair of values."""

from . import words
from .panels import Panel, Plot


def heat(of, across, down):
  name = f"heat-{across}-{down}"
  has_both = lambda cell: across in cell.values and down in cell.values
  values = lambda axis, cells: [value for value in of.sweep.order(axis) if any(cell.values[axis] == value for cell in cells)]
  compared = [cell for cell in of.shown if cell.ratio and has_both(cell)]
  for axis in (across, down):
    if len(values(axis, compared)) < 2:
      of.skipped.append(f"{name}: fewer than two values of {axis} with a ratio to the reference.")
      return None
  every = [
    cell for cell in of.sweep.cells if not cell.twin and has_both(cell) and cell.values["device"] not in of.hidden_devices
  ]
  places = [place for place in of.places(every) if place not in (across, down)]
  panels = {}
  for cell in every:
    key = tuple(cell.values.get(place, "") for place in places)
    panels.setdefault(key, {}).setdefault((cell.values[across], cell.values[down]), []).append(cell)
  drawn = []
  for key, places_ in panels.items():
    panel = Panel(", ".join(words.place(place, part) for place, part in zip(places, key) if part))
    for (column, line), members in places_.items():
      timed = [cell for cell in members if cell.ratio]
      if timed:
        best = min(timed, key=lambda cell: cell.ratio.median)
        panel.cells.append((column, line, best.ratio.median, words.significant(best.ratio.median), of.says(best)))
      else:
        panel.cells.append(
          (
            column,
            line,
            None,
            members[0].status,
            f"{of.says(members[0])}: {members[0].status}, {members[0].message}",
          )
        )
    if any(value is not None for _, _, value, _, _ in panel.cells):
      drawn.append(panel)
  rest = [axis for axis in of.sweep.swept if axis not in (across, down) and any(axis in cell.values for cell in every)]
  caption = "Time of a frame over the reference's in the same round, medians: below 1 is faster. "
  caption += f"Each field has the fastest over {words.listing(rest)}. " if rest else ""
  return Plot(
    name,
    "heat",
    f"{across} and {down}",
    caption.strip(),
    words.axis_name(across, of.sweep),
    words.axis_name(down, of.sweep),
    drawn,
    ticks=values(across, every),
    rows=values(down, every),
  )
