"""The page in a real browser: headless chromium by Selenium."""

import json
import os
import tempfile
import time
import unittest
from pathlib import Path

import support
from tessera_report import page, plots
import sample
from selenium import webdriver
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys


class Browser(unittest.TestCase):
  @classmethod
  def setUpClass(cls):
    cls.folder = tempfile.TemporaryDirectory()
    folder = sample.write(Path(cls.folder.name) / "sample")
    cls.sweep = support.read(folder)
    cls.plots = plots.Plots(cls.sweep, False)
    cls.file = folder / "index.html"
    cls.file.write_text(page.Page(cls.sweep, cls.plots, []).html(), encoding="utf-8")
    options = webdriver.ChromeOptions()
    options.binary_location = "/usr/bin/chromium"
    for argument in (
      "--headless=new",
      "--no-sandbox",
      "--disable-dev-shm-usage",
      "--disable-gpu",
      f"--user-data-dir={cls.folder.name}/profile",
    ):
      options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    cls.driver = webdriver.Chrome(options=options, service=webdriver.ChromeService("/usr/bin/chromedriver"))
    cls.open(1280)

  @classmethod
  def tearDownClass(cls):
    cls.driver.quit()
    cls.folder.cleanup()

  @classmethod
  def open(cls, width):
    cls.driver.execute_cdp_cmd(
      "Emulation.setDeviceMetricsOverride",
      {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False},
    )
    cls.driver.get(cls.file.as_uri())
    for _ in range(300):
      if cls.driver.execute_script("return document.body.dataset.charts") == "drawn":
        return
      time.sleep(0.1)
    raise AssertionError(f"the charts were not drawn: {cls.driver.get_log('browser')}")

  def visible(self, column):
    """The texts of a column of the rows that are shown."""
    return self.driver.execute_script(
      """
      return [...document.querySelector('#all-rows').tBodies[0].rows].filter(row => row.offsetParent !== null)
        .map(row => row.cells[arguments[0]].textContent)""",
      column,
    )

  def column(self, name):
    heads = [
      head.text.strip("\u2195\u2191\u2193\u00a0 ")
      for head in self.driver.find_elements(By.CSS_SELECTOR, "#all-rows thead th")
    ]
    return heads.index(name)

  def test_no_error_and_no_request(self):
    self.driver.get_log("performance"), self.driver.get_log("browser")
    self.open(1280)
    self.assertEqual(self.driver.get_log("browser"), [])
    events = [json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")]
    asked = [event["params"]["request"]["url"] for event in events if event["method"] == "Network.requestWillBeSent"]
    self.assertIn(self.file.as_uri(), asked)
    self.assertEqual([url for url in asked if url != self.file.as_uri() and not url.startswith("data:")], [])

  def test_the_policy_stops_requests(self):
    """What the test before relies on is seen at work: a request is refused, and the log says so."""
    self.driver.execute_script("fetch('https://example.org/').catch(() => document.body.dataset.refused = 'yes')")
    for _ in range(50):
      if self.driver.execute_script("return document.body.dataset.refused") == "yes":
        break
      time.sleep(0.1)
    self.assertTrue(any("Content Security Policy" in entry["message"] for entry in self.driver.get_log("browser")))

  def test_every_chart_has_its_marks(self):
    counts = self.driver.execute_script("""
      return [...document.querySelectorAll('.chart')].map(chart => ({
        symbols: chart.querySelectorAll('svg .mark-symbol.role-mark path').length,
        rects: chart.querySelectorAll('svg .mark-rect.role-mark path').length,
        label: chart.getAttribute('aria-label') ?? ''}))""")
    panels = [(plot, panel) for plot in self.plots.list for panel in plot.panels]
    self.assertEqual(len(counts), len(panels))
    for count, (plot, panel) in zip(counts, panels):
      name = f"{plot.name}: {panel.title}"
      if plot.kind in ("precision", "strip", "lines"):
        self.assertEqual(count["symbols"], len(panel.points) + len(panel.failed), name)
      else:
        self.assertGreaterEqual(count["rects"], len(panel.cells), name)
      self.assertIn(plot.title, count["label"], name)

  def test_neither_width_scrolls_sideways(self):
    for width in (1280, 400):
      self.open(width)
      size = self.driver.execute_script(
        "return [document.documentElement.scrollWidth, window.innerWidth, document.querySelector('.chart"
        " svg').getBoundingClientRect().right]"
      )
      self.assertEqual(size[1], width)
      self.assertLessEqual(size[0], width)
      self.assertLessEqual(size[2], width)
    self.open(1280)

  def test_pictures_are_whole_and_not_smaller_than_they_are(self):
    shown = self.driver.execute_script(
      "return [...document.images].map(image => [image.complete, image.naturalWidth,"
      " image.getBoundingClientRect().width, image.alt])"
    )
    self.assertGreater(len(shown), 0)
    for complete, natural, width, alt in shown:
      self.assertTrue(complete and natural > 0)
      self.assertGreaterEqual(width, natural)
      self.assertIn("pixels", alt)

  def test_filter(self):
    status = self.column("status")
    box = self.driver.find_element(By.ID, "filter")
    self.assertEqual(len(self.visible(status)), len(self.sweep.cells))
    box.send_keys("unsupported Xeon")
    wanted = [cell for cell in self.sweep.cells if cell.status == "unsupported" and cell.machine == "Intel Xeon"]
    self.assertEqual(self.visible(status), ["unsupported"] * len(wanted))
    self.assertEqual(
      self.driver.find_element(By.ID, "filter-shown").text, f"{len(wanted)} of {len(self.sweep.cells)} rows"
    )
    box.send_keys(Keys.CONTROL, "a")
    box.send_keys(Keys.DELETE)
    self.assertEqual(len(self.visible(status)), len(self.sweep.cells))

  def test_sort_by_keyboard_and_mouse(self):
    ms = self.column("ms")
    button = self.driver.find_elements(By.CSS_SELECTOR, "#all-rows thead button")[ms]
    numbers = lambda: [float(text.replace(",", "")) for text in self.visible(ms) if text != "\u2013"]
    empty = sum(not cell.timed for cell in self.sweep.cells)
    button.send_keys(Keys.ENTER)
    self.assertEqual(numbers(), sorted(numbers()))
    self.assertEqual(self.visible(ms)[-empty:], ["\u2013"] * empty)
    self.assertEqual(button.find_element(By.XPATH, "..").get_attribute("aria-sort"), "ascending")
    self.driver.execute_script("arguments[0].click()", button)
    self.assertEqual(numbers(), sorted(numbers(), reverse=True))
    self.assertNotEqual(numbers(), sorted(numbers()))
    self.assertEqual(self.visible(ms)[-empty:], ["\u2013"] * empty)

  def test_words_say_what_the_rows_hold(self):
    text = self.driver.find_element(By.TAG_NAME, "body").text
    for part in (
      self.sweep.question,
      "tile=8 with binning=bitmask: at least 16 would do <for masks & words>",
      "a frame took longer than 60 s",
      "never between two",
      "is fastest, or equal to the fastest, in",
    ):
      self.assertIn(part, text)
    commands = {element.text for element in self.driver.find_elements(By.CSS_SELECTOR, "#all-rows td.command code")}
    self.assertEqual(commands, {cell.row["command"] for cell in self.sweep.cells})
    for name in ("fastest", "failures", "all-rows", "all-counters", "floors", "environment"):
      self.assertTrue(self.driver.find_element(By.CSS_SELECTOR, f"#{name} caption").text, name)

  def test_size(self):
    self.assertLess(os.path.getsize(self.file), 6_000_000)


if __name__ == "__main__":
  unittest.main()
