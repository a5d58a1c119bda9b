"""The rows of a sweep: read, checked, and put into groups of cells that may be compared with each other."""

from collections import defaultdict
from dataclasses import dataclass, field
import hashlib
import math
from pathlib import Path
import tomllib

import jsonschema

from . import ratios, schema, visible
from .refused import Refused

# What a cell can be told apart by besides the axes; "x" is the number of its scene.
PLACES = ("machine", "scene", "size", "device", "threads")


@dataclass
class Cell:
  row: dict
  line: int
  machine: str = ""
  values: dict = field(default_factory=dict)  # of axes and PLACES, as text; no entry where the cell has no such axis
  samples: ratios.Samples = field(default_factory=dict)  # with those taken again: for ratios
  ratio: ratios.Ratio | None = None  # to its group's reference

  @property
  def number(self):
    return self.row["sweep"]["cell"]

  @property
  def status(self):
    return self.row["status"]

  @property
  def message(self):
    return self.row.get("message", "")

  @property
  def reference(self):
    return self.row["sweep"].get("reference", False)

  @property
  def twin(self):
    return self.row["sweep"].get("twin", False)

  @property
  def software(self):
    return self.row["provenance"].get("correctness_only", False)

  @property
  def timed(self):
    samples = self.row.get("time_ns", {}).get("samples")
    return self.status == "ok" and bool(samples) and min(samples) > 0  # a clock that stood still measured nothing

  @property
  def ms(self):
    return self.spread[0]

  @property
  def spread(self):
    """Median and quartiles, ms."""
    return tuple(value / 1e6 for value in ratios.spread(self.row["time_ns"]["samples"]))

  @property
  def full_key(self):
    provenance = self.row["provenance"]
    return tuple(str(provenance.get(key, "")) for key in ("cpu", "os", "device", "driver", "api", "threads"))

  def error(self, source, name):
    """A number of `error` or `truth_error`; None where it was not measured."""
    value = self.row.get(source, {}).get(name)
    if not isinstance(value, (int, float)):
      return None
    return float(value) if abs(value) > 1e-100 else 0.0  # far below the least float32: an axis of powers of ten ends before

  def mismatches(self, source="error"):
    """0 where all that was compared is equal."""
    return sum(value for name, value in self.row.get(source, {}).items() if name.endswith("_mismatch") and value)

  @property
  def truth_source(self):
    """Where errors count from: [truth] where the sweep has it."""
    return "truth_error" if self.row.get("truth") else "error"

  @property
  def exact(self):
    """Whether it was found to be without an error."""
    return self.truth_source in self.row and not self.mismatches(self.truth_source)

  @property
  def wrong(self):
    return bool(self.mismatches(self.truth_source))


@dataclass
class Group:
  """Cells of one scene, size, device and number of threads on one machine."""

  cells: list
  reference: Cell | None = None
  twin: Cell | None = None
  floors: dict = field(default_factory=dict)  # session -> noise floor, a factor

  def __post_init__(self):
    self.reference = next((cell for cell in self.cells if cell.reference and not cell.twin), None)
    self.twin = next((cell for cell in self.cells if cell.twin), None)
    if self.reference and self.reference.timed:
      if self.twin and self.twin.timed and self.twin.full_key == self.reference.full_key:
        pairs = ratios.paired(self.twin.samples, self.reference.samples)
        self.floors = {session: ratios.noise_floor(values) for session, values in pairs.items()}
      for cell in self.cells:
        cell.ratio = self.compare(cell, self.reference)

  @property
  def values(self):
    return {place: self.cells[0].values[place] for place in PLACES if place in self.cells[0].values}

  @property
  def floor(self):
    return max(self.floors.values()) if self.floors else None

  @property
  def candidates(self):
    """What may be fastest: the twin is the reference once more."""
    return [cell for cell in self.cells if cell.timed and not cell.twin]

  def compare(self, a: Cell, b: Cell):
    """None where the two may not be compared: no time, no round in common, or another machine."""
    if not (a.timed and b.timed) or a.full_key != b.full_key:
      return None
    return ratios.ratio(a.samples, b.samples, self.floors)

  def fastest(self, cells):
    """The fastest of `cells`, and those that are equal to it, itself first."""
    if not cells:
      return []
    first = min(cells, key=lambda cell: (cell.ratio.median if cell.ratio else math.inf, cell.ms))
    others = [(cell, self.compare(cell, first)) for cell in cells if cell is not first]
    return [first] + [cell for cell, ratio in others if ratio and ratio.equal]


@dataclass
class Sweep:
  folder: Path
  title: str
  question: str
  sha256: str
  cells: list
  groups: list
  swept: list  # axes that vary, in the file's order
  plot: dict  # [plot] of sweep.toml
  truth: dict  # [truth], as the rows have it
  notes: list  # lines that the page has to say
  path: Path | None = None  # of the rows

  def varies(self, name):
    return len(self.order(name)) > 1

  def order(self, name):
    """The values of an axis or place: numbers by size, words as the sweep has them."""
    found = list(dict.fromkeys(cell.values[name] for cell in self.cells if name in cell.values))
    numbers = [number(name, value) for value in found]
    return found if None in numbers else [value for _, value in sorted(zip(numbers, found))]

  def machines(self):
    return list(dict.fromkeys(cell.machine for cell in self.cells))


def number(name, text):
  """What a value stands for on an axis; None for words. A size is the edge of the square with as many pixels."""
  if name in ("scene", "device", "machine"):
    return None
  if name == "size":
    width, height = text.split(" x ")
    return math.sqrt(int(width) * int(height))
  try:
    value = float(text)
  except ValueError:
    return None
  return value if value == 0 or 1e-30 <= abs(value) <= 1e30 else None  # neither infinite nor NaN


def read_lines(path, newest):
  cells = [Cell(row, line) for line, row in schema.read(path, newest)]
  if not cells:
    raise Refused(f"{path}: no rows; run the sweep first: tessera sweep SWEEP.toml --out {path.parent}")
  return cells


NAMES = {"type": "array", "items": {"type": "string"}}
PLOT = {
  "type": "object",
  "properties": {
    "curve": NAMES,
    "against": NAMES,
    "heat": {"type": "array", "items": {**NAMES, "minItems": 2, "maxItems": 2}},
    "x-label": {"type": "string"},
    "error": {"type": "string"},
    "figure": {"type": "string"},
  },
}


def read_plot(folder, sweep):
  """[plot], whose axes have to be the rows' own."""
  path = folder / "sweep.toml"
  if not path.exists() and not path.is_symlink():
    sweep.notes.append("There is no sweep.toml beside the rows, so the plots are the usual ones.")
    return {}
  if not path.is_file():
    raise Refused(f"{path}: not a file; the sweep that gave the rows would be right")
  text = path.read_bytes()
  try:
    file = visible.everywhere(tomllib.loads(text.decode("utf-8-sig")))
  except (ValueError, RecursionError) as error:
    raise Refused(f"{path}: not TOML: {error}") from None
  if file.get("title") != sweep.title:
    raise Refused(
      f'{path}: title: "{file.get("title")}", but the rows are of "{sweep.title}"; '
      "the folder should hold the sweep that gave the rows"
    )
  if hashlib.sha256(text).hexdigest() != sweep.sha256:
    sweep.notes.append(
      "sweep.toml has been changed since the sweep ran; its [plot] is used, its cells are those of the rows."
    )
  plot = file.get("plot", {})
  for error in jsonschema.Draft202012Validator(PLOT).iter_errors(plot):
    where = ".".join(["plot", *(str(part) for part in error.absolute_path if isinstance(part, str))])
    raise Refused(f"{path}: {where}: {schema.wanted(error)} would be right")
  known = [*sweep.swept, *PLACES]
  asked = [("curve", axis) for axis in plot.get("curve", [])]
  asked += [("against", axis) for axis in plot.get("against", []) if axis != "x"]
  asked += [("heat", axis) for pair in plot.get("heat", []) for axis in pair]
  for key, axis in asked:
    if axis not in known:
      raise Refused(f'{path}: plot.{key}: "{axis}" does not vary in these rows; one of {", ".join(known)} would do')
  for across, down in plot.get("heat", []):
    if across == down:
      raise Refused(f'{path}: plot.heat: "{across}" against itself; two different axes would be right')
  return plot


def samples_of(row):
  samples = defaultdict(list)
  times = row.get("time_ns", {})
  for part in (times, times.get("again", {})):
    values = part.get("samples", [])
    rounds = part.get("rounds", range(len(values)))
    sessions = part.get("sessions", [0] * len(values))
    for value, turn, session in zip(values, rounds, sessions):
      samples[session, turn].append(value)
  return dict(samples)


def name_machines(cells):
  """A machine is a CPU and a system, unless that would make one of two that answer differently to the same device."""
  answers = defaultdict(set)
  for cell in cells:
    if cell.row["provenance"].get("device"):
      answers[cell.full_key[:2], cell.row["sweep"]["device"], cell.row["sweep"].get("threads")].add(cell.full_key)
  several = {host for (host, _, _), keys in answers.items() if len(keys) > 1}
  keys = {}
  for cell in cells:
    host = cell.full_key[:2]
    keys.setdefault(cell.full_key if host in several else host, []).append(cell)
  names = [key[0] or "unknown machine" for key in keys]
  if len(set(names)) < len(names):
    names = [", ".join(part for part in key if part) for key in keys]
  # What is still alike differs in its driver or compiler, which the table of the environment has.
  for index, (name, members) in enumerate(zip(names, keys.values())):
    for cell in members:
      cell.machine = name if names.count(name) == 1 else f"{name} ({index + 1})"


def values_of(cell, all_devices):
  row, sweep = cell.row, cell.row["sweep"]
  values = {axis: str(value) for axis, value in sweep.get("asked", {}).items()}
  values = {axis: value if value else "own" for axis, value in values.items()}
  values["machine"] = cell.machine
  values["scene"] = sweep["scene"]
  if "size" in row["scene"]:
    values["size"] = " x ".join(str(edge) for edge in row["scene"]["size"])
  values["device"] = sweep["device"] + (" (software)" if cell.software and all_devices else "")
  threads = row["provenance"].get("threads") or sweep.get("threads")
  if threads:
    values["threads"] = str(threads)
  if sweep.get("x") is not None:
    short = f"{sweep['x']:g}"
    values["x"] = short if float(short) == sweep["x"] else repr(sweep["x"])
  return values


def read_sweep(folder, newest, all_devices=False, rows="rows.jsonl"):
  path = folder / rows
  try:
    cells = read_lines(path, newest)
  except OSError as error:
    raise Refused(f"{path}: {error.strerror}") from None
  first = cells[0]
  for cell in cells:
    if cell.row["sweep"]["sha256"] != first.row["sweep"]["sha256"]:
      raise Refused(
        f'{path}:{cell.line}: a row of another sweep, "{cell.row["sweep"]["title"]}" '
        f'({cell.row["sweep"]["sha256"][:12]}), than line {first.line}, "{first.row["sweep"]["title"]}" '
        f"({first.row['sweep']['sha256'][:12]}); give each sweep a folder of its own"
      )
    if cell.row["sweep"].get("quick", False) != first.row["sweep"].get("quick", False):
      raise Refused(
        f"{path}:{cell.line}: one of this row and line {first.line} is of a --quick sweep, the other is not;"
        " give each a folder of its own"
      )
  seen = {}
  for cell in cells:
    other = seen.setdefault((cell.full_key, cell.number), cell)
    if other is not cell:
      raise Refused(
        f"{path}:{cell.line}: cell {cell.number} of the same machine is in line {other.line}, too; "
        "rows of one machine should be there once"
      )
  name_machines(cells)
  for cell in cells:
    cell.values = values_of(cell, all_devices)
    cell.samples = samples_of(cell.row)
  order = {machine: index for index, machine in enumerate(dict.fromkeys(cell.machine for cell in cells))}
  cells.sort(key=lambda cell: (order[cell.machine], cell.number))
  groups = defaultdict(list)
  for cell in cells:
    groups[cell.machine, cell.row["sweep"]["group"]].append(cell)
  swept = [axis for axis in dict.fromkeys(axis for cell in cells for axis in cell.row["sweep"].get("swept", []))]
  truth = next((cell.row["truth"] for cell in cells if cell.row.get("truth")), {})
  about = first.row["sweep"]
  sweep = Sweep(
    folder,
    about["title"],
    about["question"],
    about["sha256"],
    cells,
    [Group(members) for members in groups.values()],
    swept,
    {},
    truth,
    [],
    path,
  )
  for cell in cells:
    for note in cell.row["scene"].get("notes", []):
      line = f"Scene {cell.row['sweep']['scene']}: {note}."
      if line not in sweep.notes:
        sweep.notes.append(line)
  if about.get("quick"):
    sweep.notes.append("These rows are of a --quick sweep, with sizes, rounds and scenes as in [quick].")
  sweep.plot = read_plot(folder, sweep)
  return sweep
