"""Text from files, for a terminal, a page and figures: what a terminal or a reader's eye would obey is written out."""

import re

# C0 but the line's end and the tab, DEL, C1; marks, overrides and isolates of direction; ends of lines that are not one.
OBEYED = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ufeff\ud800-\udfff\ufffe\uffff]")


def escaped(found):
  code = ord(found[0])
  # Python has a byte of a name that is not UTF-8 as half a pair of surrogates.
  return f"\\x{code - 0xdc00:02x}" if 0xdc80 <= code <= 0xdcff else f"\\u{code:04x}"


def visible(text):
  """As host/support/terminal.cpp has it: an escape is "\\u001b"."""
  return OBEYED.sub(escaped, text)


def one_line(text):
  """The same of a message: ends of lines are blanks."""
  return visible(" ".join(str(text).split("\n")))


def everywhere(value):
  """The same for all text in a value of JSON."""
  if isinstance(value, str):
    return visible(value)
  if isinstance(value, list):
    return [everywhere(entry) for entry in value]
  if isinstance(value, dict):
    return {visible(name): everywhere(entry) for name, entry in value.items()}
  return value
