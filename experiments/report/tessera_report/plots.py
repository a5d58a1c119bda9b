"""What is plotted: the plots that a sweep's rows give, as plain points, lines and bands.

charts.py draws them on the page and figures.py on paper, so that both show the same."""

from .along_axis import against
from .error_time import precision
from .heat import heat
from .refused import Refused
from .shown import Shown
from .stage_bars import bars


class Plots(Shown):
  """All plots of a sweep, in the page's order."""

  def __init__(self, sweep, all_devices):
    super().__init__(sweep, all_devices)
    self.against = sweep.plot.get("against", sweep.swept)  # axes
    self.pairs = sweep.plot.get("heat", [])  # of axes
    self.list = [plot for plot in self.make() if plot is not None]

  def make(self):
    """Each plot, or None where there is none."""
    for source in self.sources:
      yield precision(self, *source)
    for axis in self.against:
      yield against(self, axis, "time")
      yield against(self, axis, "ratio")
      for source in self.sources:
        yield against(self, axis, "error", *source)
    for pair in self.pairs:
      yield heat(self, *pair)
    yield bars(self)

  def figure(self):
    """The name of the plot that stands for the experiment: [plot] figure, or the first."""
    asked = self.sweep.plot.get("figure")
    names = [plot.name for plot in self.list]
    if asked is None:
      return names[0] if names else None
    if asked not in names:
      possible = [f"{kind}-{axis}" for axis in self.against for kind in ("against", "ratio-against", "error-against")]
      possible += ["work-precision", "stages"] + [f"heat-{across}-{down}" for across, down in self.pairs]
      if asked.removesuffix("-truth") not in possible:
        raise Refused(
          f'{self.sweep.folder / "sweep.toml"}: plot.figure: "{asked}" is no plot of this sweep; one of'
          f" {', '.join(names or possible)} would do"
        )
      if not any(line.startswith(asked + ":") for line in self.skipped):
        self.skipped.append(f"{asked}: no cell has what it shows.")
      return None
    return asked
