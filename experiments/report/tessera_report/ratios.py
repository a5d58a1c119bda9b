"""Ratios of times that were measured in the same rounds, and how far they have to be from 1 to mean something."""

from dataclasses import dataclass
import math

import numpy

# Samples of a cell, in nanoseconds: (session, round) -> the frames of its turn in that round.
Samples = dict[tuple[int, int], list[float]]

CONFIDENCE = 0.95  # of the noise floor
DRAWS = 4000  # of the bootstrap: its 95th percentile is then steady to a few per cent of itself


def spread(values):
  """Median and quartiles, linear between neighbours, as the rows have them."""
  low, middle, high = numpy.quantile(numpy.asarray(values, float), [0.25, 0.5, 0.75])
  return float(middle), float(low), float(high)


def paired(a: Samples, b: Samples) -> dict[int, list[float]]:
  """t_a / t_b for each round in which both had their turn, by session. What slows a machine down for a while slows
  both, so that it cancels; a round that was broken off and taken up in another session is another round."""
  ratios: dict[int, list[float]] = {}
  for turn in sorted(a.keys() & b.keys()):
    over, under = float(numpy.median(a[turn])), float(numpy.median(b[turn]))
    if over > 0 and under > 0:  # a clock that stood still measured nothing
      ratios.setdefault(turn[0], []).append(over / under)
  return ratios


def noise_floor(ratios) -> float:
  """A factor >= 1: how far from 1 the median of as many paired ratios gets though both cells are the same one.

  `ratios` are of the reference to its twin (A/A). Neither of the two comes first, so r and 1/r are equally likely: each
  draw takes as many ratios as there are, with replacement, turns each over or not by chance, and takes the median,
  which is what a cell's ratio is, too. The floor is what 95 % of the draws stay within, and never less than the ratio
  that was observed. It needs rounds: of one there is but one ratio to draw from, of two the larger is the floor."""
  logs = numpy.log(numpy.asarray(ratios, float))
  random = numpy.random.Generator(numpy.random.PCG64(1))  # a fixed seed: the same rows give the same page
  shape = (DRAWS, len(logs))
  draws = logs[random.integers(0, len(logs), shape)] * random.choice([-1.0, 1.0], shape)
  medians = numpy.abs(numpy.median(draws, axis=1))
  return math.exp(max(float(numpy.quantile(medians, CONFIDENCE)), abs(float(numpy.median(logs)))))


@dataclass
class Ratio:
  """A cell's time over another's: median and quartiles over `count` rounds."""

  median: float
  low: float
  high: float
  count: int
  floor: float | None  # the noise floor as a factor; None where A/A was not measured

  @property
  def equal(self) -> bool:
    """Whether noise alone gives such a ratio. Without a floor nothing is called equal."""
    return self.floor is not None and abs(math.log(self.median)) <= math.log(self.floor)

  @property
  def verdict(self) -> str:
    return "equal" if self.equal else "faster" if self.median < 1 else "slower"


def ratio(a: Samples, b: Samples, floors: dict[int, float]) -> Ratio | None:
  """None where no round has both. Rounds of several sessions have the widest floor of these sessions."""
  by_session = paired(a, b)
  values = [value for values in by_session.values() for value in values]
  if not values:
    return None
  known = [floors[session] for session in by_session if session in floors]
  return Ratio(*spread(values), len(values), max(known) if known else None)
