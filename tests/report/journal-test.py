"""Journals edited by hand, value by value: what `tessera sweep --resume` makes of one are rows that the report reads, or one line and no change."""

import copy
import json
from pathlib import Path
import tempfile
import unittest

import support
from tessera_report import schema
from support import tessera

SWEEP = """title = "Edited"
question = "What comes of a journal that was edited?"
sizes = [64]
threads = [1]
rounds = 2
[scenes]
soup = {source = "generate:soup?count=500&pixels=200", x = 3}
[set]
binning = "queue"
capacity = 16
tile = 32
commit = "tile-owned"
[axes]
overflow = ["retry", "drop", "error"]
[truth]
sub-pixel = 4
"""
VALUES = [None, -1, 3, 2.5, 1e300, "../../x", [1, 2, 3], {"a": 1}]
MARK = "edited twice"  # a key that text takes for another


def places(value, path=()):
  """The path of each value in a value of JSON; of what is alike, such as a plan's passes, only the first two."""
  if isinstance(value, dict):
    alike = path[-1:] in (("plan",), ("kernels",), ("variant",), ("counters",), ("stages",), ("asked",))
    for key in list(value)[:2] if alike else value:
      yield (*path, key)
      yield from places(value[key], (*path, key))
  elif isinstance(value, list):
    for index in range(len(value)):
      yield (*path, index)
      yield from places(value[index], (*path, index))


def edits(line):
  """(what was done, text) of a line with one value removed, there twice, or another one."""
  for path in places(line):
    def edited(change):
      whole = copy.deepcopy(line)
      holder = whole
      for key in path[:-1]:
        holder = holder[key]
      change(holder)
      return json.dumps(whole)

    name, old = path[-1], line
    for key in path:
      old = old[key]
    yield f"{path} removed", edited(lambda holder: holder.pop(name))
    if isinstance(name, str):
      yield f"{path} twice", edited(lambda holder: holder.update({MARK: old})).replace(f'"{MARK}"', json.dumps(name))
    else:
      yield f"{path} twice", edited(lambda holder: holder.insert(name, old))
    for value in VALUES:
      if value != old or type(value) is not type(old):
        yield f"{path} {json.dumps(value)[:20]}", edited(lambda holder: holder.__setitem__(name, value))


class Edited(unittest.TestCase):
  def setUp(self):
    self.temporary = tempfile.TemporaryDirectory()
    self.desk = Path(self.temporary.name)
    self.folder = self.desk / "out"
    self.toml = self.desk / "sweep.toml"
    self.toml.write_text(SWEEP)
    self.sweep()
    # Two sessions, the second with samples of the reference and its twin once more.
    lines = self.lines()
    taken = [line for line in lines if (json.loads(line).get("round"), json.loads(line)["kind"], json.loads(line).get("cell")) != (1, "sample", 2)]
    self.assertEqual(len(taken), len(lines) - 1)
    (self.folder / "journal.jsonl").write_text("".join(taken))
    (self.folder / "rows.jsonl").unlink()
    self.sweep("--resume")
    self.rows = (self.folder / "rows.jsonl").read_bytes()
    self.checker = schema.Checker()

  def tearDown(self):
    self.temporary.cleanup()

  def sweep(self, *more):
    result = tessera("sweep", self.toml, "--out", self.folder, "--quiet", *more)
    self.assertEqual((result.returncode, result.stderr), (0, ""))

  def lines(self):
    return (self.folder / "journal.jsonl").read_text().splitlines(keepends=True)

  def files(self):
    return {str(path.relative_to(self.folder)): path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}

  def outcome(self, text, what, line=r"\d+"):
    """Whether it was taken."""
    journal = self.folder / "journal.jsonl"
    journal.write_text(text)
    before = self.files()
    result = tessera("sweep", self.toml, "--out", self.folder, "--quiet", "--resume")
    with self.subTest(what=what):
      if result.returncode == 0:
        for row in (self.folder / "rows.jsonl").read_text().splitlines():
          self.assertIsNone(self.checker.refusal(schema.parse(row.encode())))
        support.read(self.folder)
      else:
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertRegex(result.stderr, r"^tessera: ")
        self.assertRegex(result.stderr, rf"(journal|rows)\.jsonl:{line}: |scene is not what it was|--devices|--job|of another file")
        self.assertEqual(self.files(), before)
    (self.folder / "rows.jsonl").write_bytes(self.rows)
    return result.returncode == 0

  def test_values(self):
    lines = self.lines()
    kinds = {}  # the first of each kind, and the last of the samples, which is of the second session
    for i, line in enumerate(lines):
      value = json.loads(line)
      kinds.setdefault((value["kind"], "again" in value, "error" in value, value.get("row", {}).get("status")), i)
    self.assertEqual(len(kinds), 7, kinds)
    taken = refused = 0
    for i in kinds.values():
      for what, edited in edits(json.loads(lines[i])):
        if self.outcome("".join(lines[:i]) + edited + "\n" + "".join(lines[i + 1 :]), f"line {i + 1}: {what}"):
          taken += 1
        else:
          refused += 1
    self.assertGreater(taken, 50)
    self.assertGreater(refused, 500)

  def test_lines(self):
    """Lines that are there twice or at another place are refused with the number of the first that is wrong."""
    lines = self.lines()
    for i, line in enumerate(lines):
      self.assertFalse(self.outcome("".join(lines[: i + 1] + lines[i:]), f"line {i + 1} twice", i + 2), line)
    self.assertFalse(self.outcome("".join(lines[1:]), "no head", 1))
    self.assertFalse(self.outcome("".join(lines[:1] + lines[2:]), "no first session", 2))

  def test_what_other_lines_say(self):
    """An edit that each line alone would allow: the head, the list of axes or another line say otherwise."""
    lines = [json.loads(line) for line in self.lines()]
    first = {kind: next(i for i, line in enumerate(lines) if line["kind"] == kind) for kind in ("head", "session", "cell", "sample")}
    for kind, path, value in (
      ("head", ("cells", 0, "command"), "rm -rf /"),
      ("head", ("cells", 0, "command"), lines[0]["cells"][0]["command"].replace("tile=32", "tile=16")),
      ("head", ("cells", 0, "command"), lines[0]["cells"][0]["command"].replace("count=500", "count=501")),
      ("head", ("cells", 0, "name"), "another cell"),
      ("session", ("utc",), 3),
      ("session", ("load",), "x"),
      ("session", ("jobs",), {}),
      ("cell", ("row", "variant", "tile"), "64"),
      ("cell", ("row", "variant", "tile"), "7"),
      ("cell", ("row", "variant", "edge"), "float31"),
      ("cell", ("row", "truth", "sub-pixel"), "5"),
      ("cell", ("row", "scene", "size"), [64, 32]),
      ("cell", ("row", "scene", "triangles"), 99),
      ("cell", ("row", "scene", "sha256"), "0" * 64),
      ("cell", ("row", "error", "id_mismatch"), -3),
      ("cell", ("row", "error", "id_mismatch"), 1.5),
      ("cell", ("row", "error", "id_mismatch"), 64 * 64 + 1),
      ("cell", ("row", "error", "pixels"), 64),
      ("cell", ("row", "provenance", "utc"), "today"),
      ("sample", ("stages",), {"foo": 1}),
      ("sample", ("stages",), {}),
      ("sample", ("total_ns",), 0),
    ):
      edited = copy.deepcopy(lines)
      holder = edited[first[kind]]
      for key in path[:-1]:
        holder = holder[key]
      self.assertNotEqual(holder[path[-1]], value)
      holder[path[-1]] = value
      text = "".join(json.dumps(line) + "\n" for line in edited)
      self.assertFalse(self.outcome(text, f"{kind} {path} {value}"), f"{kind} {path} {value}")

  def test_byte_order_mark(self):
    self.assertTrue(self.outcome("\ufeff" + "".join(self.lines()), "a byte order mark"))


if __name__ == "__main__":
  unittest.main()
