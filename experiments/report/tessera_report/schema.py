"""Rows as they come from a file: read, and held against row.schema.json, before anything is made of them."""

import codecs
import json
from pathlib import Path

import jsonschema

from . import versions, visible
from .refused import Refused

FILE = Path(__file__).with_name("row.schema.json")
LONGEST = 16 << 20  # bytes of a line; one of a sweep has some five thousand


def short(value):
  if isinstance(value, (dict, list)):
    return "an object" if isinstance(value, dict) else "a list"
  text = json.dumps(value, ensure_ascii=True)
  return text if len(text) <= 40 else text[:37] + "..."


TYPES = {"object": "an object", "array": "a list", "string": "text", "integer": "a whole number", "number": "a number", "boolean": "true or false", "null": "null"}


def wanted(error):
  """What would be right, of one of jsonschema's errors."""
  rule, value = error.validator, error.validator_value
  if rule == "type":
    return " or ".join(TYPES[name] for name in ([value] if isinstance(value, str) else value))
  if rule == "enum":
    return "one of " + ", ".join(map(str, value))
  if rule in ("minimum", "maximum"):
    return f"a number {'from' if rule == 'minimum' else 'up to'} {value:g}"
  if rule in ("minItems", "maxItems"):
    return f"{value} entries"
  if rule == "maxLength":
    return f"text of at most {value} letters"
  return error.schema.get("description", f"{rule} {short(value)}")


def place(error):
  parts = [str(part) for part in error.absolute_path]
  return ".".join(short(part)[1:-1] for part in parts)


class Checker:
  def __init__(self):
    schema = json.loads(FILE.read_text(encoding="utf-8"))
    self.validator = jsonschema.Draft202012Validator(schema)

  def refusal(self, row):
    """What is wrong with a row, or None."""
    errors = list(self.validator.iter_errors(row))
    if not errors:
      return None
    error = min(errors, key=lambda error: (len(error.absolute_path), error.validator != "required", str(error.absolute_path)))
    where = place(error)
    if error.validator == "required":
      missing = next(name for name in error.validator_value if name not in error.instance)
      where = f"{where}.{missing}" if where else missing
      note = " (rows of 'tessera render --json' have no sweep)" if missing == "sweep" else ""
      return f"{where}: missing; a sweep's row has it{note}"
    return f"{where or 'the row'}: is {short(error.instance)}; {wanted(error).rstrip(',.')} would be right"


def unique(pairs):
  row = dict(pairs)
  if len(row) < len(pairs):
    names = [name for name, _ in pairs]
    twice = next(name for name in names if names.count(name) > 1)
    raise ValueError(f"{short(twice)} is there twice")
  return row


def number(text):
  raise ValueError(f"{text} is no number of JSON")


def parse(line):
  """The value of a line of bytes. Throws ValueError with what is wrong."""
  if len(line) > LONGEST:
    raise ValueError(f"{len(line):,} bytes long")
  try:
    value = json.loads(line.decode("utf-8"), object_pairs_hook=unique, parse_constant=number)
    json.dumps(value, ensure_ascii=False).encode("utf-8")  # halves of a pair of surrogates are no text
  except UnicodeError:
    raise ValueError("not UTF-8") from None
  except RecursionError:
    raise ValueError("nested too deeply") from None
  return value


def read(path, newest):
  """(line, row) of each line that is not empty."""
  if not path.is_file():
    raise Refused(f"{path}: not a file; the rows of a sweep, one a line, would be right")
  checker = Checker()
  with path.open("rb") as lines:
    for line, text in enumerate(lines, 1):
      text = text.removeprefix(codecs.BOM_UTF8)  # some editors put one first; files put together have it further down
      where = f"{path}:{line}"
      if not text.strip():
        continue
      try:
        row = parse(text)
      except ValueError as error:
        raise Refused(f"{where}: not a line of JSON ({error}); a line should be one row, as 'tessera sweep' writes it") from None
      if not isinstance(row, dict) or "schema_version" not in row:
        raise Refused(f"{where}: not a row; a line should be one row, as 'tessera sweep' writes it")
      version = row["schema_version"]
      if type(version) is int and not versions.OLDEST <= version <= newest:
        raise Refused(
          f"{where}: a row of schema version {short(version)}; this report reads versions {versions.OLDEST} to"
          f" {newest}: make it with the tessera that made the rows, or run the sweep again"
        )
      refusal = checker.refusal(row)
      if refusal:
        raise Refused(f"{where}: {refusal}")
      for part in (row.get("time_ns", {}), row.get("time_ns", {}).get("again", {})):
        for name in ("rounds", "sessions"):
          if name in part and len(part[name]) != len(part["samples"]):
            raise Refused(f"{where}: time_ns.{name}: {len(part[name])} of them; one for each of the {len(part['samples'])} samples would be right")
      yield line, visible.everywhere(versions.raised(row))
