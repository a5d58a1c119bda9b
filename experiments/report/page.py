"""The page: one file that needs no network."""

from html import escape
import json
import os
from pathlib import Path
from urllib.parse import quote

import altair
import vl_convert

import charts
from markup import quantity, swatch, table, text
import panels
import pictures
import ratios
from tables import Tables
import words

# The page may not ask for anything. Vega compiles expressions, hence 'unsafe-eval'.
kPolicy = "default-src 'none'; script-src 'unsafe-inline' 'unsafe-eval'; style-src 'unsafe-inline'; img-src data:"


class Page:
  def __init__(self, sweep, plots, figures, folder=None):
    """`figures`: the names of those that were written beside the page, into `folder`."""
    self.sweep, self.plots, self.figures = sweep, plots, figures
    self.folder = folder or sweep.folder / "report"
    self.places = plots.places(sweep.cells)
    self.tables = Tables(sweep, plots)
    self.specs = []
    self.notes = list(sweep.notes)

  # -- summary

  def speed(self, cell):
    if cell.reference:
      return "the reference"
    if not cell.ratio:
      return ""
    return "equal" if cell.ratio.equal else f"{words.significant(1 / cell.ratio.median)} \u00d7"

  def summary(self):
    sweep = self.sweep
    real = [cell for cell in sweep.cells if not cell.twin]
    lines = [self.counts()]
    groups = [group for group in sweep.groups if group.candidates and not self.hidden(group)]
    if groups:
      if sweep.swept:
        lines.append(self.fastestWords(groups))
      floors = [group.floor for group in groups if group.floor]
      if floors:
        low, high = min(floors), max(floors)
        span = (
          words.percent(high)
          if words.percent(low) == words.percent(high)
          else f"{words.percent(low)} to {words.percent(high)}"
        )
        lines.append(
          f"The A/A noise floor, the reference against itself, is {span}: what differs by less is called equal."
        )
    if self.plots.hiddenDevices:
      lines.append(
        f"Times of software drivers ({words.listing(sorted(self.plots.hiddenDevices))}) stand in the table"
        " only, since they say nothing about a GPU."
      )
    if len(sweep.machines()) > 1:
      lines.append(
        f"The rows come from {words.count(len(sweep.machines()), 'machine')}. They stand side by side; ratios"
        " are taken inside each machine only, never between two."
      )
    html = "".join(f"<p>{escape(line)}</p>" for line in lines)
    if groups and sweep.swept:
      html += self.fastestTable(groups)
    return html + self.failures(real)

  def outcome(self):
    """One line: what is fastest; where nothing is timed or varies, how the cells ended."""
    groups = [group for group in self.sweep.groups if group.candidates and not self.hidden(group)]
    if groups and self.sweep.swept:
      return self.fastestWords(groups)
    return self.counts()

  def counts(self):
    real = [cell for cell in self.sweep.cells if not cell.twin]
    statuses = {}
    for cell in real:
      statuses[cell.status] = statuses.get(cell.status, 0) + 1
    counts = ", ".join(f"{number:,} {status}" for status, number in statuses.items())
    quick = " of a --quick sweep" if self.sweep.cells[0].row["sweep"].get("quick") else ""
    return f"{words.count(len(real), 'cell')}{quick}: {counts}."

  def hidden(self, group):
    return all(cell.values["device"] in self.plots.hiddenDevices for cell in group.cells)

  def name(self, cell):
    return words.cellName(cell, self.sweep.swept)

  def ties(self, cells):
    """"; equal to it are b and c": those that no ratio tells from the first."""
    names = [self.name(cell) for cell in cells[1:]]
    return f"; equal to it {'is' if len(names) == 1 else 'are'} {words.listing(names)}" if names else ""

  def errorWords(self):
    return f" {self.plots.truthWords()}" if self.sweep.truth else ""

  def fastestWords(self, groups):
    """The winner in a sentence: which values are fastest, or equal to the fastest, where, and by how much."""
    wins = {}
    for group in groups:
      for cell in group.fastest(group.candidates):
        wins.setdefault(self.name(cell), []).append((cell, group))
    name, won = max(wins.items(), key=lambda item: len(item[1]))
    tied = [other for other, others in wins.items() if other != name and len(others) == len(won)]
    compared = [cell for cell, _ in won if cell.ratio]
    speeds = sorted(1 / cell.ratio.median for cell in compared if not cell.ratio.equal)
    if speeds:
      speed = f", {words.span(speeds)} times as fast as the reference"
    elif won[0][0].reference:
      speed = ", and is the reference"
    else:
      speed = ", equal to the reference" if compared else "; there is no time of the reference to compare with"
    speed += f" in {len(speeds)} of them and equal to it in the rest" if 0 < len(speeds) < len(compared) else ""
    wrong = f", though not without errors{self.errorWords()}" if any(cell.wrong for cell, _ in won) else ""
    if len(groups) == 1:
      winners = groups[0].fastest(groups[0].candidates)
      wrong = f", though not without errors{self.errorWords()}" if winners[0].wrong else ""
      exact = groups[0].fastest([cell for cell in groups[0].candidates if cell.exact]) if wrong else []
      first = winners[0]
      compared = first.ratio and not first.reference
      speed = (
        ", and is the reference" if first.reference
        else "; there is no time of the reference to compare with" if not compared
        else ", equal to the reference" if first.ratio.equal
        else f", {words.significant(1 / first.ratio.median)} times as fast as the reference"
      )
      return (
        f"Fastest is {self.name(first)}: {words.significant(first.ms)} ms{speed}{wrong}{self.ties(winners)}."
        + (
          f" Without an error it is {self.name(exact[0])}: {words.significant(exact[0].ms)} ms{self.ties(exact)}."
          if exact
          else ""
        )
      )
    return (
      f"{name} is fastest, or equal to the fastest, in {len(won)} of {words.count(len(groups), 'group')}{speed}{wrong}"
      + (f"; so {'is' if len(tied) == 1 else 'are'} {words.listing(tied)} in as many" if tied else "")
      + "."
    )

  def fastestTable(self, groups):
    anyError = any(not cell.exact for group in groups for cell in group.candidates)
    places = self.plots.places([cell for group in groups for cell in group.cells])
    heads = [(place, "short") for place in places]
    heads += [
      ("fastest", "name"),
      ("ms", "number"),
      ("quartiles", "number"),
      ("speed against the reference", ""),
      ("equal to it", "name"),
      ("A/A floor", "number"),
    ]
    if anyError:
      heads += [("fastest without an error" + (" from truth" if self.sweep.truth else ""), "name"), ("equal to that", "name")]
    rows = []
    for group in groups:
      first, *others = group.fastest(group.candidates)
      _, low, high = first.spread
      name = escape(self.name(first))
      if first.wrong:
        name += ' <span class="bad">(with errors)</span>'
      row = [text(group.values.get(place)) for place in places]
      row += [
        (name, None),
        quantity(first.ms),
        (f"{words.significant(low)} to {words.significant(high)}", None),
        text(self.speed(first)),
        text("; ".join(self.name(cell) for cell in others)),
        (words.percent(group.floor), group.floor) if group.floor else text(""),
      ]
      if anyError:
        exact = group.fastest([cell for cell in group.candidates if cell.exact])
        row += [
          text(
            ""
            if not exact
            else "the same" if exact[0] is first else f"{self.name(exact[0])}, {words.significant(exact[0].ms)} ms"
          ),
          text("; ".join(self.name(cell) for cell in exact[1:])),
        ]
      rows.append(row)
    return table(
      "fastest",
      "The fastest cell of each group, and those that equal it within the noise. A group is what was measured in"
      " turns: one scene, size, device and number of threads on one machine.",
      heads,
      rows,
    )

  def failures(self, cells):
    failed = {}
    for cell in cells:
      if cell.status != "ok":
        failed.setdefault((cell.status, cell.message), []).append(cell)
    if not failed:
      return "<p>Every cell has a time.</p>" if all(cell.timed for cell in cells) else ""
    rows = [
      [
        text(status),
        text(message),
        quantity(len(members)),
        text(
          "; ".join(
            dict.fromkeys(
              " ".join(
                [
                  *(member.values.get(place, "") for place in self.places),
                  words.cellName(member, self.sweep.swept),
                ]
              ).strip()
              for member in members[:6]
            )
          )
          + (f"; and {len(members) - 6} more" if len(members) > 6 else "")
        ),
      ]
      for (status, message), members in failed.items()
    ]
    return "<h3>What has no time, and why</h3>" + table(
      "failures",
      "Cells that did not end as ok, by reason.",
      [("status", "short"), ("reason", "reason"), ("cells", "number"), ("which", "")],
      rows,
    )

  # -- plots

  def legend(self, plot):
    if plot.kind == "bars":
      entries = [
        (stage, panels.kStageColours[index % len(panels.kStageColours)], "square")
        for index, stage in enumerate(plot.rows)
      ]
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

  def pictures(self):
    sweep_ = self.sweep
    made, notes = pictures.embed(sweep_)
    self.notes += notes
    if not made:
      return None
    key = "".join(
      f'<span class="swatch" style="background:{colour}"></span>{name}'
      for name, colour in (
        ("covered in one image only", "#d55e00"),
        ("another triangle", "#0072b2"),
        ("another depth", "#f0e442"),
        ("another value, colour or hit count", "#cc79a7"),
        ("equal, drawn", "#bebebe"),
        ("equal, empty", "#e6e6e6"),
      )
    )
    figures = []
    for picture in made:
      first = picture.cells[0]
      counts = [
        f"{words.pixels(value, name)}{origin}"
        for source, origin in (("error", ""), ("truth_error", f" {self.plots.truthWords()}"))
        for name, value in first.row.get(source, {}).items()
        if name.endswith("_mismatch") and name != "winner_mismatch" and value and (source == "error" or value != first.row.get("error", {}).get(name))
      ]
      names = ", ".join(
        [*(first.values.get(place, "") for place in self.places), words.cellName(first, self.sweep.swept)]
      )
      others = (
        f" The same in {words.count(len(picture.cells) - 1, 'other cell')}:"
        f" {', '.join(str(cell.number) for cell in picture.cells[1:])}."
        if picture.cells[1:]
        else ""
      )
      name = quote(os.path.relpath(sweep_.folder / first.row["picture"], self.folder))
      (width, height), (small, _) = picture.size, picture.shown
      size = f"{width} \u00d7 {height} pixels" + (
        "" if small == width else f", each pixel here the most different of {picture.factor} \u00d7 {picture.factor}"
      )
      figures.append(
        f'<figure><img decoding="async" src="{picture.uri}" width="{picture.shown[0]}"'
        f' height="{picture.shown[1]}" alt="Where the image of cell {first.number} differs:'
        f' {escape("; ".join(counts))}"><figcaption><b>{escape(names)}</b> (cell {first.number}).'
        f' {escape("; ".join(counts))}. {size}; <a href="{name}">as it is</a>.{others}</figcaption></figure>'
      )
    return (
      "pictures",
      "Where images differ",
      (
        f'<p class="note">{key}. A picture that is shown smaller keeps of each block the pixel that differs'
        " most, so that a single wrong pixel is still seen. A cell with errors from its own oracle shows"
        f' these, else those from the truth.</p><div class="pictures">{"".join(figures)}</div>'
      ),
    )

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
      f" replacement, {ratios.kDraws:,} times; 95 % of the medians lie within the floor, which is never less than"
      " the A/A ratio itself. A ratio inside the floor is called equal. Each session of a sweep that was resumed"
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
      ("summary", "Summary", self.summary()),
      self.section("error-time", "Error against time", ("precision", "strip")),
      self.section("axes", "Along each axis", ("lines",)),
      self.section("heat", "Two axes at once", ("heat",)),
      self.section("time", "Stages", ("bars",)),
      self.pictures(),
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
      json.dumps({"config": charts.kConfig, "specs": self.specs}, separators=(",", ":"))
      .replace("</", "<\\/")
      .replace("<!--", "<\\u0021--")
    )
    bundle = vl_convert.javascript_bundle(vl_version=".".join(altair.SCHEMA_VERSION.lstrip("v").split(".")[:2]))
    read = lambda name: Path(__file__).with_name(name).read_text(encoding="utf-8")
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{kPolicy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{escape(sweep.title)}</title>
<link rel="icon" href="data:,">
<style>
{read("page.css")}</style>
</head>
<body>
<header>
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
{read("page.js")}</script>
</body>
</html>
"""
