"""Numbers that a Typst text has typed in. As a module: find(text); as a program: typed-numbers.py FILE..., exit code 1 if there are any.

Text is digits in markup: in prose, headings and table cells, but not in code, that is, what follows a `#`, where integers count and
index. So that code does not bring them in either, a fraction in code needs a unit of length, and strings have no digits but in `set` and `show`."""
import re
import sys
from pathlib import Path

LENGTH = re.compile(r"\d+(\.\d+)?(pt|em|cm|mm|fr|%)")
STATEMENT = re.compile(r"(let|set|show|import)\b")


class Scanner:
  def __init__(self, text):
    self.text, self.at, self.found = text, 0, []

  def take(self, pattern):
    """What matches here, passed over; or None."""
    match = re.compile(pattern, re.DOTALL).match(self.text, self.at)
    if match:
      self.at = match.end()
    return match

  def report(self, what):
    self.found.append((self.text.count("\n", 0, self.at) + 1, what))

  def markup(self, end=None):
    while self.at < len(self.text):
      if end and self.take(re.escape(end)):
        return
      if self.take(r"//[^\n]*|```.*?```|`[^`]*`|\\.|@[\w.-]+|<[a-z][\w.-]*>"):
        continue
      if self.take("#"):
        self.embedded()
      elif self.take(r"\["):
        self.markup("]")
      elif digits := self.take(r"\d[\d.,]*"):
        self.report(digits[0])
      else:
        self.at += 1

  def embedded(self):
    """Code in markup: a statement up to the end of its line, or one expression."""
    statement = STATEMENT.match(self.text, self.at)
    if statement:
      self.code("\n", shown=statement[1] in ("let", "import"))
      return
    conditional = self.take(r"if\b")
    while self.at < len(self.text):
      if self.take(r"\{"):
        self.code("}")
      elif self.take(r"\("):
        self.code(")")
      elif self.take(r"\["):
        self.markup("]")
      elif self.take('"'):
        self.string()
      elif conditional and self.take(r"\s*else( if)?\b"):
        continue
      elif conditional and self.text[self.at - 1] not in "]}" and self.take(r"[^\[{(\"]"):
        continue
      elif not self.take(r"[\w-]+|\.(?=\w)"):
        return

  def string(self, shown=True):
    text = self.take(r'((?:\\.|[^"\\])*)"')[1]
    if shown and re.search(r"\d", text):
      self.report(f'"{text}"')

  def code(self, end, shown=True):
    while self.at < len(self.text):
      if self.take(re.escape(end)):
        return
      if self.take(r"//[^\n]*|`[^`]*`|[A-Za-z_][\w-]*"):
        continue
      if self.take(r"\["):
        self.markup("]")
      elif self.take(r"\{"):
        self.code("}", shown)
      elif self.take(r"\("):
        self.code(")", shown)
      elif self.take('"'):
        self.string(shown)
      elif LENGTH.match(self.text, self.at):
        self.take(LENGTH.pattern)
      elif number := self.take(r"\d+(\.\d+)?"):
        if number[1]:
          self.report(number[0])
      else:
        self.at += 1


def find(text):
  """(line, what) of each."""
  scanner = Scanner(text)
  scanner.markup()
  return scanner.found


if __name__ == "__main__":
  found = [(path, *place) for path in sys.argv[1:] for place in find(Path(path).read_text(encoding="utf-8"))]
  for path, line, what in found:
    print(f"{path}:{line}: {what} is typed in; numbers come from values.json")
  sys.exit(1 if found else 0)
