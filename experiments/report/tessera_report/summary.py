"""What came out, in sentences and two tables: what is fastest, and what has no time."""

from html import escape

from . import words
from .markup import quantity, table, text


class Summary:
  def __init__(self, sweep, plots):
    self.sweep, self.plots = sweep, plots
    self.places = plots.places(sweep.cells)

  def speed(self, cell):
    if cell.reference:
      return "the reference"
    if not cell.ratio:
      return ""
    return "equal" if cell.ratio.equal else f"{words.significant(1 / cell.ratio.median)} \u00d7"

  def html(self):
    sweep = self.sweep
    real = [cell for cell in sweep.cells if not cell.twin]
    lines = [self.counts()]
    groups = [group for group in sweep.groups if group.candidates and not self.hidden(group)]
    if groups:
      if sweep.swept:
        lines.append(self.fastest_words(groups))
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
    if self.plots.hidden_devices:
      lines.append(
        f"Times of software drivers ({words.listing(sorted(self.plots.hidden_devices))}) stand in the table"
        " only, since they say nothing about a GPU."
      )
    if len(sweep.machines()) > 1:
      lines.append(
        f"The rows come from {words.count(len(sweep.machines()), 'machine')}. They stand side by side; ratios"
        " are taken inside each machine only, never between two."
      )
    html = "".join(f"<p>{escape(line)}</p>" for line in lines)
    if groups and sweep.swept:
      html += self.fastest_table(groups)
    return html + self.failures(real)

  def outcome(self):
    """One line: what is fastest; where nothing is timed or varies, how the cells ended."""
    groups = [group for group in self.sweep.groups if group.candidates and not self.hidden(group)]
    if groups and self.sweep.swept:
      return self.fastest_words(groups)
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
    return all(cell.values["device"] in self.plots.hidden_devices for cell in group.cells)

  def name(self, cell):
    return words.cell_name(cell, self.sweep.swept)

  def ties(self, cells):
    """"; equal to it are b and c": those that no ratio tells from the first."""
    names = [self.name(cell) for cell in cells[1:]]
    return f"; equal to it {'is' if len(names) == 1 else 'are'} {words.listing(names)}" if names else ""

  def error_words(self):
    return f" {self.plots.truth_words()}" if self.sweep.truth else ""

  def fastest_words(self, groups):
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
    wrong = f", though not without errors{self.error_words()}" if any(cell.wrong for cell, _ in won) else ""
    if len(groups) == 1:
      winners = groups[0].fastest(groups[0].candidates)
      wrong = f", though not without errors{self.error_words()}" if winners[0].wrong else ""
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

  def fastest_table(self, groups):
    any_error = any(not cell.exact for group in groups for cell in group.candidates)
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
    if any_error:
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
      if any_error:
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
                  words.cell_name(member, self.sweep.swept),
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
