"""Whether the rows of a sweep have what its [[expect]] says: python3 -m tessera_report.expect DIR. One line a failure, and then exit code 5."""
import json
import operator
from pathlib import Path
import sys
import tomllib

from .visible import one_line

COMPARISONS = {"<=": operator.le, ">=": operator.ge, "<": operator.lt, ">": operator.gt}
MEASURED = ("error", "truth_error", "counters")


def as_list(value):
  return [str(item) for item in (value if isinstance(value, list) else [value])]


def holds(value, wanted):
  """`wanted` is a number, or a comparison such as "> 0"."""
  if not isinstance(wanted, str):
    return value == wanted
  sign, bound = wanted.split()
  return COMPARISONS[sign](value, float(bound))


def chosen(rows, expectation):
  scenes = as_list(expectation["scene"]) if "scene" in expectation else None
  where = {axis: as_list(values) for axis, values in expectation.get("where", {}).items()}
  return [row for row in rows if (scenes is None or row["sweep"]["scene"] in scenes)
          and all(str(row["sweep"]["asked"].get(axis)) in values for axis, values in where.items())]


def failures(row, expectation):
  """What a row has not: `ok` where no status is named. Of a cell that gave no image only the status counts."""
  wanted = as_list(expectation.get("status", "ok"))
  if row["status"] not in wanted:
    yield f"status is {row['status']}, not {' or '.join(wanted)}: {row.get('message', '')}"
  elif row["status"] == "ok":
    for table in MEASURED:
      for name, wanted in expectation.get(table, {}).items():
        value = row.get(table, {}).get(name)
        if value is None:
          yield f"{table}.{name} is not there; {wanted} is expected"
        elif not holds(value, wanted):
          yield f"{table}.{name} is {value}; {wanted} is expected"


def name_of(row):
  axes = " ".join(f"{axis}={value}" for axis, value in row["sweep"]["asked"].items())
  return f"{row['sweep']['scene']} {'x'.join(map(str, row['scene']['size']))} {row['sweep']['device']}, {axes}"


def check(folder):
  """Lines about what does not hold, and the number of cells that were held against an expectation."""
  expectations = tomllib.loads((folder / "sweep.toml").read_text()).get("expect", [])
  rows = [json.loads(line) for line in (folder / "rows.jsonl").read_text().splitlines()]
  rows = [row for row in rows if not row["sweep"]["twin"]]
  ran = {row["sweep"]["scene"] for row in rows}
  lines, checked = [], set()
  for i, expectation in enumerate(expectations, start=1):
    cells = chosen(rows, expectation)
    if not cells and ran & set(as_list(expectation.get("scene", list(ran)))):
      lines.append(f"[[expect]] {i}: chooses no cell of those that ran")
    checked |= {row["sweep"]["cell"] for row in cells}
    lines += [f"[[expect]] {i}: {name_of(row)}: {failure}" for row in cells for failure in failures(row, expectation)]
  return lines, len(checked)


def main(folder):
  lines, checked = check(Path(folder))
  for line in lines:
    print(one_line(f"{folder}: {line}"), file=sys.stderr)
  print(one_line(f"{folder}: {checked} cells are {'not all ' if lines else ''}as the sweep file expects"))
  return 5 if lines else 0


if __name__ == "__main__":
  sys.exit(main(sys.argv[1]))
