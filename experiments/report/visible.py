"""Text from files, for a terminal, a page and figures: what a terminal or a reader's eye would obey is written out."""

import re

# C0 but the line's end and the tab, DEL, C1; marks, overrides and isolates of direction; ends of lines that are not one.
kObeyed = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ufeff\ud800-\udfff\ufffe\uffff]")


def visible(text):
  """As host/terminal.cpp has it: an escape is "\\u001b"."""
  return kObeyed.sub(lambda found: f"\\u{ord(found[0]):04x}", text)


def everywhere(value):
  """The same for all text in a value of JSON."""
  if isinstance(value, str):
    return visible(value)
  if isinstance(value, list):
    return [everywhere(entry) for entry in value]
  if isinstance(value, dict):
    return {visible(name): everywhere(entry) for name, entry in value.items()}
  return value
