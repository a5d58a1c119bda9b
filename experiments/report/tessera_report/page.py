"""The page: one file that needs no network."""

from html import escape
import json
from pathlib import Path

import altair
import vl_convert

from . import charts, panels, ratios, words
from .gallery import gallery
from .markup import document, quantity, swatch, table, text
from .summary import Summary
from .tables import Tables

# The page may not ask for anything. Vega compiles expressions, hence 'unsafe-eval'.
POLICY = "default-src 'none'; script-src 'unsafe-inline' 'unsafe-eval'; style-src 'unsafe-inline'; img-src data:"


class Page:
  def __init__(self, sweep, plots, figures, folder=None):
    """`figures`: the names of those that were written beside the page, into `folder`."""
    self.sweep, self.plots, self.figures = sweep, plots, figures
    self.folder = folder or sweep.folder / "report"
    self.places = plots.places(sweep.cells)
    self.summary = Summary(sweep, plots)
    self.tables = Tables(sweep, plots)
    self.specs = []
    self.notes = list(sweep.notes)

  def legend(self, plot):
    if plot.kind == "bars":
      entries = [(stage, colour, "square") for stage, colour in panels.stage_colours(plot)]
    elif len(plot.curves) > 1 and plot.kind != "strip":
      entries = [(curve, *panels.style(plot.curves, curve)) for curve in plot.curves]
    else:
      return ""
    return (
      '<ul class="legend">'
      + "".join(f"<li>{swatch(colour, shape)}{escape(name)}</li>" for name, colour, shape in entries)
      + "</ul>"
    )

  def figure(self, plot):
    wide = " wide" if plot.kind in ("bars", "heat", "strip") else ""
    parts = []
    for panel in plot.panels:
      self.specs.append(charts.spec(plot, panel))
      title = f"<h4>{escape(panel.title)}</h4>" if panel.title else ""
      parts.append(
        f'<div class="panel">{title}<div class="scroll" tabindex="0" role="group"'
        f' aria-label="{escape(plot.title)}{", " + escape(panel.title) if panel.title else ""}"><div'
        f' class="chart" data-spec="{len(self.specs) - 1}"></div></div></div>'
      )
    files = [name for name in self.figures if name == plot.name or name.startswith(plot.name + "-page-")]
    links = "; ".join(
      " ".join(f'<a href="figures/{name}.{kind}">{kind.upper()}</a>' for kind in ("svg", "pdf", "png"))
      for name in files
    )
    return (
      f'<figure id="{escape(plot.name)}"><h3>{escape(plot.title)}</h3>{self.legend(plot)}<div'
      f' class="panels{wide}">{"".join(parts)}</div>'
      f"<figcaption>{escape(plot.caption)}{' As a file: ' + links + '.' if links else ''}</figcaption></figure>"
    )

  def section(self, name, title, kinds):
    found = [plot for plot in self.plots.list if plot.kind in kinds]
    if not found:
      return None
    return name, title, "".join(self.figure(plot) for plot in found)

  def gallery(self):
    found, notes = gallery(self.sweep, self.plots, self.folder)
    self.notes += notes
    return found

  # -- how it was measured

  def method(self):
    sweep = self.sweep
    times = [cell.row["time_ns"] for cell in sweep.cells if cell.timed]
    html = (
      "<p>Each cell's image was held against the oracle before its time counted. Cells of a group took turns, in"
      " an order drawn anew each round, so a machine that slows down shows as spread, not as a winner. A ratio"
      " is the median over the rounds of a cell's time over the reference's in the same round and"
      " session.</p><p>The A/A noise floor comes from the reference's twin, the same cell measured once more:"
      " from their paired ratios, each turned over or not by chance, as many as there are rounds are drawn with"
      f" replacement, {ratios.DRAWS:,} times; {100 * ratios.CONFIDENCE:g} % of the medians lie within the floor, which is never less"
      " than the A/A ratio itself. A ratio inside the floor is called equal. Each session of a sweep that was resumed"
      " has a floor of its own, and a cell measured in several has the widest of theirs.</p>"
    )
    floors = [(group, session) for group in sweep.groups for session in group.floors]
    if floors:
      heads = [(place, "short") for place in self.places] + [
        ("session", "number"),
        ("rounds", "number"),
        ("A/A ratio", "number"),
        ("floor", "number"),
      ]
      rows = []
      for group, session in floors:
        pairs = ratios.paired(group.twin.samples, group.reference.samples)[session]
        rows.append(
          [text(group.values.get(place)) for place in self.places]
          + [
            quantity(session),
            quantity(len(pairs)),
            quantity(ratios.spread(pairs)[0]),
            (words.percent(group.floors[session]), group.floors[session]),
          ]
        )
      html += table(
        "floors",
        "The A/A noise floor of each group and session; session 0 is the first, higher ones are of a sweep that"
        " was resumed.",
        heads,
        rows,
      )
    elif times:
      html += (
        "<p>There is no twin of the reference with times here, so there is no noise floor, and nothing is"
        " called equal.</p>"
      )
    return "method", "How it was measured", html + self.tables.environment() + self.skipped()

  def skipped(self):
    lines = self.plots.skipped + self.notes
    if not lines:
      return ""
    return (
      '<h3>What is not shown</h3><ul id="skipped">' + "".join(f"<li>{escape(line)}</li>" for line in lines) + "</ul>"
    )

  # -- the whole

  def html(self):
    sweep = self.sweep
    sections = [
      ("summary", "Summary", self.summary.html()),
      self.section("error-time", "Error against time", ("precision", "strip")),
      self.section("axes", "Along each axis", ("lines",)),
      self.section("heat", "Two axes at once", ("heat",)),
      self.section("time", "Stages", ("bars",)),
      self.gallery(),
      self.tables.rows(),
      self.tables.counters(),
      self.method(),
    ]
    sections = [section for section in sections if section]
    nav = "".join(f'<a href="#{name}">{escape(title)}</a>' for name, title, _ in sections)
    body = "".join(
      f'<section aria-labelledby="{name}"><h2 id="{name}">{escape(title)}</h2>{content}</section>\n'
      for name, title, content in sections
    )
    # A script's text ends at the first "</": in JSON it can be written in another way.
    data = (
      json.dumps({"config": charts.CONFIG, "specs": self.specs}, separators=(",", ":"))
      .replace("</", "<\\/")
      .replace("<!--", "<\\u0021--")
    )
    bundle = vl_convert.javascript_bundle(vl_version=".".join(altair.SCHEMA_VERSION.lstrip("v").split(".")[:2]))
    body = f"""<header>
<h1>{escape(sweep.title)}</h1>
<p class="question">{escape(sweep.question)}</p>
<nav aria-label="Sections">{nav}</nav>
</header>
<main>
{body}</main>
<footer><p>Made by <code>tessera report</code> from {words.count(len(sweep.cells), "row")} of the sweep
{sweep.sha256[:12]}. This file is complete in itself.</p></footer>
<script>{bundle.replace("</script", "<" + chr(92) + "/script")}</script>
<script type="application/json" id="charts">{data}</script>
<script>
{Path(__file__).with_name("page.js").read_text(encoding="utf-8")}</script>"""
    return document(sweep.title, POLICY, body)
