"""Domains and ticks of axes, the same on the page and on paper."""

import math


def domain(values, logarithmic):
  """What shows all values with some air."""
  low, high = min(values), max(values)
  if logarithmic:
    air = max((high / low) ** 0.06, 1.06)
    return low / air, high * air
  air = 0.06 * (high - low) or 0.5 * abs(high) or 1
  return low - air, high + air


def powers(low, high, most=7):
  """1, 2 and 5 times powers of ten, or fewer of these where that is plenty."""
  exponents = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
  for factors in ((1, 2, 5), (1, 3), (1,)):
    found = [factor * 10.0**exponent for exponent in exponents for factor in factors]
    found = [tick for tick in found if low <= tick * (1 + 1e-9) and tick <= high]
    if len(found) <= most:
      break
  while len(found) > most:
    found = found[::2]
  return found


def ticks(low, high, logarithmic, most=7):
  """Powers where the axis is long enough for three of them; else evenly spaced."""
  found = powers(low, high, most) if logarithmic else []
  if len(found) >= 3:
    return found
  step = 10.0 ** math.floor(math.log10((high - low) / 3))
  for factor in (1, 2, 5, 10):
    if (high - low) / (factor * step) <= most - 2:
      step *= factor
      break
  return [round(index * step, 12) for index in range(math.ceil(low / step), math.floor(high / step) + 1)]


def text(tick):
  """0.001, 0.5, 20, 2,000, then 10^5 as 1e5."""
  if tick == 0 or 1e-3 <= abs(tick) < 1e5:
    return f"{tick:,.6g}" if abs(tick) >= 1000 else f"{tick:.6g}"
  mantissa, power = f"{tick:.0e}".split("e")
  return f"{mantissa}e{int(power)}"
