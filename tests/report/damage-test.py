"""Rows that are damaged or foreign: each is a page or one line, never a traceback; what was there before stays."""

import contextlib
import io
import json
import os
from pathlib import Path
import random
import subprocess
import sys
import tempfile
import unittest

import support
import numpy
import png
import sample
from tessera_report import pictures, plots, schema, visible
from tessera_report.refused import Refused
from support import only

SEED = 14
VALUES = [None, True, -1, 0, 1e-320, 10**400, 3.5, "", "\x1b[31m", "\u202e", "$\\frac$", "../../x", [], {}, [None], {"a": 1}, "x" * 5000]


def mutate(random_, value):
  """One change somewhere in a value of JSON."""
  while True:
    keys = list(value) if isinstance(value, dict) else list(range(len(value)))
    if not keys:
      return
    key = random_.choice(keys)
    if isinstance(value[key], (dict, list)) and random_.random() < 0.8:
      value = value[key]
    elif isinstance(value, dict) and random_.random() < 0.3:
      del value[key]
      return
    else:
      value[key] = random_.choice(VALUES)
      return


class Damage(unittest.TestCase):
  def setUp(self):
    self.temporary = tempfile.TemporaryDirectory()
    self.folder = sample.write(Path(self.temporary.name) / "results", only(scene="ball", edge=256, device="cpu", cpu="AMD EPYC"))
    self.rows = self.folder / "rows.jsonl"
    self.lines = self.rows.read_text().splitlines(keepends=True)

  def tearDown(self):
    self.temporary.cleanup()

  def read(self):
    """None, or the line that it was refused with."""
    try:
      made = plots.Plots(support.read(self.folder), False)
      from tessera_report import page

      page.Page(made.sweep, made, []).html().encode()
    except Refused as refused:
      return str(refused)
    return None

  def test_mutations(self):
    random_ = random.Random(SEED)
    refused = 0
    for run in range(60):
      lines = list(self.lines)
      index = random_.randrange(len(lines))
      if random_.random() < 0.7:
        row = json.loads(lines[index])
        for _ in range(random_.randint(1, 3)):
          mutate(random_, row)
        lines[index] = json.dumps(row, ensure_ascii=random_.random() < 0.5) + "\n"
        data = "".join(lines).encode("utf-8", "surrogatepass")
      else:
        data = bytearray("".join(lines).encode())
        for _ in range(random_.randint(1, 4)):
          data[random_.randrange(len(data))] = random_.randrange(256)
      self.rows.write_bytes(bytes(data))
      with self.subTest(seed=SEED, run=run):
        line = self.read()
        if line is not None:
          refused += 1
          self.assertNotIn("\n", line)
          self.assertIn("rows.jsonl", line)
    self.assertGreater(refused, 15)

  def test_what_is_wrong_is_named(self):
    row = json.loads(self.lines[0])

    def refused_with(change, *parts):
      self.rows.write_text(change if isinstance(change, str) else json.dumps(row | change) + "\n")
      line = self.read()
      self.assertIsNotNone(line, change)
      for part in ("rows.jsonl:1: ", *parts):
        self.assertIn(part, line)

    refused_with({"status": 3}, "status: is 3; one of ok, overflow")
    refused_with({"sweep": row["sweep"] | {"cell": "4"}}, 'sweep.cell: is "4"; a whole number would be right')
    refused_with({"sweep": row["sweep"] | {"swept": ["../../x"]}}, "sweep.swept", "the name of an axis")
    refused_with({"time_ns": row["time_ns"] | {"rounds": [0]}}, "time_ns.rounds: 1 of them; one for each of the 7")
    refused_with({"error": {"id_mismatch": "many"}}, "error.id_mismatch", "a whole number or null")
    for field, value, right in (
      ("id_mismatch", -3, "a number from 0"),
      ("id_mismatch", 1.5, "a whole number or null"),
      ("depth_max_abs", -1e-9, "a number from 0"),
      ("hit_count_not_one", "x", "a whole number or null"),
    ):
      for part in ("error", "truth_error"):
        refused_with({part: {field: value}}, f"{part}.{field}: is {json.dumps(value)}; {right} would be right")
    refused_with({"error": {"id_mismatch": -0.5}, "error_samples": {"id_mismatch": [0]}}, "error.id_mismatch: is -0.5; a number from 0")
    refused_with({"error_samples": {"id_mismatch": [0.5]}}, "error_samples.id_mismatch.0: is 0.5; a whole number or null")
    self.rows.write_text(json.dumps(row | {"error": {"id_mismatch": 1.5}, "error_samples": {"id_mismatch": [1, 2]}}) + "\n")
    self.assertIsNone(self.read())  # a median of counts
    refused_with({"counters": {"tests": 2.5}}, "counters.tests: is 2.5; a whole number")
    refused_with({"memory": {"peak_buffer_bytes": 0.5}}, "memory.peak_buffer_bytes: is 0.5; a whole number")
    refused_with({"scene": row["scene"] | {"triangles": 1.5}}, "scene.triangles: is 1.5; a whole number")
    refused_with({"scene": row["scene"] | {"attribute": {"range": [0]}}}, "scene.attribute.range")
    refused_with(json.dumps(row | {"scene": row["scene"] | {"origin": [0, 0, 0]}}).replace("[0, 0, 0]", "[0, 0, 1e999]") + "\n", "scene.origin.2")
    refused_with({"time_ns": row["time_ns"] | {"samples": [1.5] * 7}}, "time_ns.samples.0: is 1.5; a whole number")
    refused_with({"provenance": {"seed": -1}}, "provenance.seed: is -1; a number from 0")
    refused_with({"provenance": {"dirty": 1}}, "provenance.dirty: is 1; true or false")
    refused_with({"provenance": {"kernels": {"setup": 1}}}, "provenance.kernels.setup: is 1; text")
    refused_with({"provenance": {"utc": 5}}, "provenance.utc: is 5; text would be right")
    for utc in ("noon", "2026-11-23 12:00:00Z", "2026-11-23T12:00:00Z\n"):
      refused_with({"provenance": {"utc": utc}}, "provenance.utc: is ", "text")
    refused_with({"provenance": {"threads": -1}}, "provenance.threads: is -1; a number from 0")
    refused_with(json.dumps(row).replace('"status"', '"status": "ok", "status"') + "\n", "there twice")
    refused_with(json.dumps(row).replace('[256', '[NaN', 1) + "\n", "NaN is no number")
    refused_with("[" * 100000 + "\n", "nested too deeply")
    refused_with('{"event": "started"}\n', "not a row")
    self.rows.write_bytes(b"\xff\xfe\x00\n")
    self.assertIn("not UTF-8", self.read())
    self.rows.unlink()
    self.rows.mkdir()
    self.assertIn("not a file", self.read())

  def test_byte_order_mark(self):
    """Of files put together, each may have one."""
    self.rows.write_text("".join("\ufeff" + line for line in self.lines[:2]), encoding="utf-8")
    (self.folder / "sweep.toml").write_bytes(b"\xef\xbb\xbf" + (self.folder / "sweep.toml").read_bytes())
    self.assertEqual(len(support.read(self.folder).cells), 2)

  def test_sweep_files(self):
    for plot, part in (("curve = 3", "plot.curve"), ('heat = [["tile"]]', "plot.heat"), ("error = 1", "plot.error"),
                       ('heat = [["tile", "tile"]]', "against itself")):
      (self.folder / "sweep.toml").write_text(f'title = "Sample"\n[plot]\n{plot}\n')
      self.assertIn(part, self.read())

  def test_pictures_outside_the_folder(self):
    secret = Path(self.temporary.name) / "secret.png"
    sample.picture(secret, 64)
    (self.folder / "pictures").mkdir(exist_ok=True)
    (self.folder / "pictures" / "link.png").symlink_to(secret)
    for name in (str(secret), "../secret.png", "pictures/link.png", "pictures/../../secret.png"):
      row = json.loads(self.lines[0]) | {"picture": name}
      self.rows.write_text(json.dumps(row) + "\n")
      self.assertIn("rows.jsonl:1: picture: ", self.read() or "", name)
      self.assertIn("lies outside the folder", self.read())

  def test_schema_has_the_rows_on_record(self):
    checker = schema.Checker()
    files = sorted((support.SOURCE / "experiments").glob("*/results.jsonl"))
    self.assertGreater(len(files), 5)
    for file in files:
      self.assertTrue(file.with_name("sweep.toml").exists(), file)
      for line, row in schema.read(file, support.SCHEMA):
        self.assertIsNone(checker.refusal(row), f"{file}: {line}")

  def test_rows_of_version_2_have_no_zero_for_what_is_not_held(self):
    rows = [row for _, row in schema.read(support.SOURCE / "experiments" / "edge-arithmetic" / "results.jsonl", 2)]
    self.assertTrue(all(row["error"]["hit_count_mismatch"] is None for row in rows if "error" in row))

  def test_text_for_the_terminal(self):
    """As the command writes it: both have the same table to keep, and tests/cli counts as many characters."""
    lines = (support.SOURCE / "tests/cli/visible.txt").read_bytes().decode().split("\n")
    cases = [line.split("\t") for line in lines if line and not line.startswith("#")]
    self.assertGreater(len(cases), 40)
    for bytes_, text in cases:
      self.assertEqual(visible.visible(bytes.fromhex(bytes_).decode(errors="surrogateescape")), text)
    characters = [chr(code) for code in range(0x110000) if not 0xD800 <= code <= 0xDFFF]
    self.assertEqual(sum(visible.visible(character) != character for character in characters), 80)
    self.assertEqual(visible.one_line("a\nb\tc\x1b"), "a b\tc\\u001b")


class Large(unittest.TestCase):
  def test_a_picture_beyond_pillows_limit(self):
    width, height = 20000, 10000  # 200 million pixels
    row, wrong = bytes([230]) * (3 * width), bytearray(bytes([230]) * (3 * width))
    wrong[3 * 19998 : 3 * 19998 + 3] = bytes((213, 94, 0))
    with tempfile.TemporaryDirectory() as folder:
      path = Path(folder) / "large.png"
      with path.open("wb") as file:
        png.Writer(width, height, greyscale=False, compression=1).write(file, (wrong if y == 7001 else row for y in range(height)))
      pixels, factor, size = pictures.read(path)
    self.assertEqual((size, factor, pixels.shape), ((width, height), 79, (127, 254, 3)))
    self.assertEqual(tuple(pixels[7001 // 79, 19998 // 79]), (213, 94, 0))
    self.assertEqual(int((pixels.max(axis=2) != pixels.min(axis=2)).sum()), 1)


if __name__ == "__main__":
  unittest.main()
