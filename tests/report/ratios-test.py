"""Ratios and their noise floor against figures worked by hand; groups, machines, fronts and pictures."""

from html import unescape
import re
import tempfile
import unittest
from pathlib import Path

import support
import numpy
import sample
from tessera_report import along_axis, error_time, page, panels, pictures, plots, ratios, scales, words


class Summary(unittest.TestCase):
  """What the page calls fastest: within the noise there are ties, and what is without an error is so against [truth]."""

  def page(self, change):
    group = support.only(scene="ball", edge=256, device="cpu", cpu="AMD EPYC")
    chosen = lambda row: group(row) if "tile" in row["sweep"]["asked"] else None  # not the one cell beside the product
    with tempfile.TemporaryDirectory() as folder:
      sweep = support.read(sample.write(folder, lambda row: chosen(row) and change(row)))
      return page.Page(sweep, plots.Plots(sweep, False), [])

  def cells(self, html):
    """Heads and cells of the table of the fastest, as text; it has one row."""
    found = re.search(r'<table id="fastest".*?</table>', html, re.S)[0]
    texts = lambda tag: [unescape(re.sub(r"<[^>]*>", "", cell)).strip() for cell in re.findall(rf"<{tag}\b.*?</{tag}>", found, re.S)]
    return dict(zip((re.sub("[\u2195\u2191\u2193\u00a0]", "", head).strip() for head in texts("th")), texts("td"), strict=True))

  def wrong_against(self, truth):
    """float32-plane, the fastest, is wrong against [truth] and right by its own oracle, or the other way round."""

    def change(row):
      approximate = row["sweep"]["asked"].get("edge") == "float32-plane"
      row["error"] = {"coverage_mismatch": 0 if approximate == truth else 5}
      row["truth_error"] = {"coverage_mismatch": 5 if approximate == truth else 0}
      return row

    return change

  def test_ties_are_named(self):
    """bitmask is four thousandths slower than exact, far within the noise: which is first is chance, that both are named is not."""
    made = self.page(self.wrong_against(False))
    row = self.cells(made.summary.html())
    names = {"tile=32 binning=exact edge=float32-plane", "tile=32 binning=bitmask edge=float32-plane"}
    self.assertEqual({row["fastest"], row["equal to it"]}, names)
    self.assertRegex(made.summary.outcome(), rf"^Fastest is {row['fastest']}: .*; equal to it is {row['equal to it']}\.$")

  def test_without_a_tie_none_is_named(self):
    def change(row):
      if row["sweep"]["asked"]["binning"] == "bitmask":
        row["time_ns"]["samples"] = [2 * time for time in row["time_ns"]["samples"]]
      return self.wrong_against(False)(row)

    made = self.page(change)
    self.assertEqual(self.cells(made.summary.html())["equal to it"], "\u2013")
    self.assertNotIn("equal to it", made.summary.outcome())

  def test_notes_of_a_scene(self):
    """What the reader of a mesh had to say is on the page, once."""

    def change(row):
      row["scene"]["notes"] = ["ball.obj: 3 polygons are not convex: cut"]
      return self.wrong_against(False)(row)

    self.assertEqual(self.page(change).html().count("Scene ball: ball.obj: 3 polygons are not convex: cut."), 1)

  def test_errors_count_from_truth(self):
    made = self.page(self.wrong_against(True))
    row = self.cells(made.summary.html())
    exact = {"tile=32 binning=exact edge=int32", "tile=32 binning=bitmask edge=int32"}
    self.assertIn("(with errors)", row["fastest"])
    self.assertEqual({row["fastest without an error from truth"].split(",")[0], row["equal to that"]}, exact)
    self.assertRegex(made.summary.outcome(), "though not without errors.* Without an error it is tile=32 binning=.* edge=int32: ")

    row = self.cells(self.page(self.wrong_against(False)).summary.html())
    self.assertNotIn("(with errors)", row["fastest"])
    self.assertEqual(row["fastest without an error from truth"], "the same")


class Ratios(unittest.TestCase):
  def test_pairs_by_round_and_session(self):
    # The machine is twice as slow in round 1, and three times in session 1: the ratio is 1.5 throughout.
    reference = {(0, 0): [10.0], (0, 1): [20.0], (1, 2): [30.0]}
    cell = {(0, 0): [15.0], (0, 1): [30.0], (1, 2): [45.0]}
    self.assertEqual(ratios.paired(cell, reference), {0: [1.5, 1.5], 1: [1.5]})
    # A round that only one of them has is no pair, nor is one of another session.
    self.assertEqual(ratios.paired({(0, 0): [15.0], (1, 1): [1.0]}, reference), {0: [1.5]})

  def test_frames_of_a_turn_are_one_median(self):
    self.assertEqual(ratios.paired({(0, 0): [2.0, 100.0, 4.0]}, {(0, 0): [1.0, 2.0, 3.0]}), {0: [2.0]})

  def test_ratio_is_median_of_pairs_with_quartiles(self):
    reference = {(0, turn): [10.0] for turn in range(5)}
    cell = {(0, turn): [time] for turn, time in enumerate((10.0, 20.0, 30.0, 40.0, 50.0))}
    found = ratios.ratio(cell, reference, {0: 1.1})
    self.assertEqual((found.median, found.low, found.high, found.count, found.floor), (3.0, 2.0, 4.0, 5, 1.1))
    self.assertIsNone(ratios.ratio(cell, {(1, 0): [1.0]}, {}))

  def test_verdict(self):
    verdict = lambda median, floor: ratios.Ratio(median, median, median, 5, floor).verdict
    self.assertEqual(verdict(1.05, 1.06), "equal")
    self.assertEqual(verdict(1 / 1.05, 1.06), "equal")  # a floor is as wide below 1 as above
    self.assertEqual(verdict(1.07, 1.06), "slower")
    self.assertEqual(verdict(0.9, 1.06), "faster")
    self.assertEqual(verdict(1.0001, None), "slower")  # without a floor nothing is called equal

  def test_floor_of_one_round_is_its_ratio(self):
    self.assertAlmostEqual(ratios.noise_floor([1.25]), 1.25)
    self.assertAlmostEqual(ratios.noise_floor([0.8]), 1.25)

  def test_floor_of_equal_times_is_one(self):
    self.assertEqual(ratios.noise_floor([1.0] * 7), 1.0)

  def test_floor_is_no_less_than_what_was_seen(self):
    self.assertGreaterEqual(ratios.noise_floor([1.2, 1.2, 1.2, 1.2, 1.2, 1.2, 1.2]), 1.2)

  def test_floor_of_two_ratios_by_hand(self):
    # Of logs +-a and +-b a draw's median is the mean of two: |mean| is b with probability 1/8 (twice b, of one sign),
    # so that the 95th percentile is b itself.
    self.assertAlmostEqual(ratios.noise_floor([1.1, 1.3]), 1.3)

  def test_floor_shrinks_with_rounds(self):
    few, many = [1.1, 0.9, 1.05], [1.1, 0.9, 1.05] * 20
    self.assertLess(ratios.noise_floor(many), ratios.noise_floor(few))
    self.assertEqual(ratios.noise_floor(many), ratios.noise_floor(many))

  def test_floor_holds_for_the_same_cell_twice(self):
    # A cell that is the reference is called equal in some nineteen of twenty sweeps, with noise that both share on top.
    random = numpy.random.default_rng(3)
    equal = 0
    for _ in range(200):
      drift = random.uniform(1, 2, 9)
      reference, twin, cell = (
        {(0, turn): [t] for turn, t in enumerate(drift * numpy.exp(random.normal(0, 0.03, 9)))} for _ in range(3)
      )
      floors = {0: ratios.noise_floor(ratios.paired(twin, reference)[0])}
      equal += ratios.ratio(cell, reference, floors).equal
    self.assertGreater(equal, 170)

  def test_widest_floor_of_the_sessions(self):
    times = {(0, 0): [1.0], (1, 1): [1.0]}
    self.assertEqual(ratios.ratio(times, times, {0: 1.01, 1: 1.2}).floor, 1.2)


class Sample(unittest.TestCase):
  @classmethod
  def setUpClass(cls):
    cls.folder = tempfile.TemporaryDirectory()
    cls.sweep = support.read(sample.write(Path(cls.folder.name)))

  @classmethod
  def tearDownClass(cls):
    cls.folder.cleanup()

  def test_each_machine_has_its_own_reference(self):
    self.assertEqual(self.sweep.machines(), ["AMD EPYC", "Intel Xeon"])
    for group in self.sweep.groups:
      self.assertEqual(len({cell.full_key for cell in group.cells}), 1)
    mine, other = (
      next(group for group in self.sweep.groups if group.cells[0].machine == machine)
      for machine in self.sweep.machines()
    )
    self.assertIsNone(mine.compare(other.candidates[1], mine.reference))
    self.assertAlmostEqual(other.reference.ratio.median, 1)

  def test_what_is_within_the_noise_is_equal(self):
    found = {"exact32": [], "bitmask8": []}
    for group in self.sweep.groups:
      for cell in group.candidates:
        name = cell.values["binning"] + cell.values.get("tile", "")
        if name in found and cell.values.get("edge") == "int32":
          found[name].append(cell.ratio.verdict)
    self.assertEqual(set(found["exact32"]), {"faster"})  # by a third
    # By four thousandths, under noise of one hundredth; a floor of 95 % may let one slip.
    self.assertGreaterEqual(found["bitmask8"].count("equal"), len(found["bitmask8"]) - 1)
    self.assertGreaterEqual(len(found["bitmask8"]), 6)

  def test_resumed_sessions_have_their_own_floor(self):
    group = self.sweep.groups[0]
    self.assertEqual(sorted(group.floors), [0, 1])
    pairs = ratios.paired(group.twin.samples, group.reference.samples)
    self.assertEqual(
      [len(pairs[session]) for session in (0, 1)], [4, 5]
    )  # three rounds of session 1, and two taken again
    self.assertEqual(group.candidates[1].ratio.floor, max(group.floors.values()))
    self.assertEqual(group.candidates[1].ratio.count, sample.ROUNDS)  # only the reference was taken again

  def test_fastest_names_its_equals(self):
    group = self.sweep.groups[0]
    names = [words.cell_name(cell, self.sweep.swept) for cell in group.fastest(group.candidates)]
    self.assertIn("tile=32 binning=exact edge=float32-plane", names)
    self.assertIn("tile=32 binning=bitmask edge=float32-plane", names)
    self.assertNotIn("tile=16 binning=exact edge=float32-plane", names)

  def test_plots_and_what_is_left_out(self):
    made = plots.Plots(self.sweep, False)
    names = [plot.name for plot in made.list]
    for name in (
      "work-precision",
      "against-tile",
      "ratio-against-tile",
      "error-against-tile",
      "against-scene",
      "against-x",
      "heat-tile-binning",
      "stages",
    ):
      self.assertIn(name, names)
    self.assertEqual(made.figure(), "ratio-against-tile")
    for plot in made.list:
      self.assertRegex(plot.caption, r"^[A-Z][^{}]*\.$")
    self.assertTrue(any("llvmpipe" in line and "--all-devices" in line for line in made.skipped), made.skipped)
    self.assertTrue(
      any(line.startswith("coverage_mismatch from the exact image") for line in made.skipped), made.skipped
    )
    timed = next(plot for plot in made.list if plot.name == "against-tile")
    self.assertEqual(
      [panel.title for panel in timed.panels][:2], ["AMD EPYC, ball, 256 x 256", "AMD EPYC, ball, 512 x 512"]
    )
    self.assertTrue(timed.x_log)
    self.assertEqual(len(timed.panels[0].points), 12)
    self.assertEqual([curve for curve, _, _ in timed.panels[0].levels], ["binning=none"])  # it has no tile
    self.assertEqual([x for x, _ in timed.panels[2].failed], [8, 8])
    reference = timed.panels[0].band[0] * timed.panels[0].band[1]
    self.assertAlmostEqual(reference, self.sweep.groups[0].reference.ms ** 2)
    # Errors are the same on every device, so that one panel a scene and size is enough.
    errors = next(plot for plot in made.list if plot.name == "error-against-tile")
    self.assertEqual(
      [panel.title for panel in errors.panels],
      ["ball, 256 x 256", "ball, 512 x 512", "field, 256 x 256", "field, 512 x 512"],
    )

  def test_software_drivers_where_asked_for(self):
    with tempfile.TemporaryDirectory() as folder:
      sweep = support.read(sample.write(Path(folder)), all_devices=True)
      titles = [panel.title for panel in plots.Plots(sweep, True).list[0].panels]
      self.assertIn("AMD EPYC, ball, 256 x 256, vulkan (software)", titles)

  def test_without_errors_times_stand_on_a_line(self):
    def exact(row):
      row = support.only(cpu="AMD EPYC", device="cpu", edge=256)(row)
      if row:
        row.pop("picture", None), row.pop("truth", None), row.pop("truth_error", None)
        if "error" in row:
          row["error"] = dict.fromkeys(row["error"], 0)
      return row

    with tempfile.TemporaryDirectory() as folder:
      made = plots.Plots(support.read(sample.write(Path(folder), exact)), False)
      self.assertEqual(made.list[0].kind, "strip")
      self.assertIn("Every image is the oracle's", made.list[0].caption)
      self.assertTrue(
        any("no cell has an error" in line and "work-precision" in line for line in made.skipped), made.skipped
      )
      self.assertFalse(any(plot.name.startswith("error-") for plot in made.list))


class Parts(unittest.TestCase):
  def test_front(self):
    point = lambda x, y: panels.Point(x, y, x, x, "", "")
    self.assertEqual(
      error_time.front([point(3, 1), point(1, 5), point(2, 6), point(2, 4), point(4, 1), point(5, 0.5)]),
      [(1, 5), (2, 4), (3, 1), (5, 0.5)],
    )

  def test_logarithmic_axes(self):
    self.assertTrue(along_axis.is_logarithmic([8, 16, 64]))
    self.assertTrue(along_axis.is_logarithmic([10, 100]))
    self.assertTrue(along_axis.is_logarithmic([1.1, 2, 32]))
    self.assertFalse(along_axis.is_logarithmic([0, 4, 8]))
    self.assertFalse(along_axis.is_logarithmic([3, 4, 5]))

  def test_ticks(self):
    self.assertEqual(scales.ticks(0.9, 11, True), [1, 2, 5, 10])
    self.assertEqual(scales.ticks(3.1, 3.9, True), [3.2, 3.4, 3.6, 3.8])
    self.assertEqual(panels.error_ticks((0.05, 30), 0.1), ([0.1, 1, 2, 5, 10, 20], ["0", "1", "2", "5", "10", "20"]))

  def test_numbers(self):
    self.assertEqual(
      [words.significant(value) for value in (0, 12, 1234.5, 0.012345, 2.5e-7)],
      ["0", "12", "1,234", "0.0123", "2.50e-07"],
    )

  def test_smaller_picture_keeps_the_wrong_pixel(self):
    pixels = numpy.full((1000, 700, 3), 230, numpy.uint8)
    pixels[100:400] = 190
    pixels[501, 333] = (0, 114, 178)  # id
    pixels[502, 334] = (213, 94, 0)  # coverage, in the same block: it tells more
    pixels[999, 699] = (240, 228, 66)  # depth, in the corner
    small, factor = pictures.pool(pixels, 256)
    self.assertEqual((small.shape, factor), ((250, 175, 3), 4))
    self.assertEqual([tuple(small[125, 83]), tuple(small[249, 174])], [(213, 94, 0), (240, 228, 66)])
    self.assertEqual(int((small.max(axis=2) != small.min(axis=2)).sum()), 2)
    self.assertIs(pictures.pool(small, 256)[0], small)


if __name__ == "__main__":
  unittest.main()
