"""What ends a report with one line."""


class Refused(Exception):
  """One line: file, place, what is wrong, what would be right."""
