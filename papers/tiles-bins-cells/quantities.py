"""Numbers as the page shows them: {value, unit, text}, three significant digits, counts in full, ratios with two places below 10."""
import math

import report  # noqa: F401, where tessera_report lies
from tessera_report import words


def quantity(value, unit="", digits=3):
  return {"value": value, "unit": unit, "text": words.significant(value, digits)}


def rounded(value, unit=""):
  """What is interpolated, to two digits."""
  places = 1 - math.floor(math.log10(value))
  return {"value": value, "unit": unit, "text": f"{round(value, places):,.{max(places, 0)}f}"}


def area(value):
  """As the sweep's file has it."""
  return {"value": value, "unit": "pixels", "text": f"{value:,.10g}"}


def factor(value):
  return {"value": value, "unit": "", "text": f"{value:.2f}" if value < 9.995 else words.significant(value)}


def share(part, whole):
  """A share in per cent; small ones keep two digits, and only nothing is 0."""
  percent = 100 * part / whole if whole else 0.0
  return {"value": percent, "unit": "%", "text": f"{percent:.0f}" if percent >= 9.95 else f"{percent:.1f}" if percent >= 0.95
          else words.significant(percent, 2)}


def least(quantities):
  return min(quantities, key=lambda q: q["value"], default=None)


def most(quantities):
  return max(quantities, key=lambda q: q["value"], default=None)
