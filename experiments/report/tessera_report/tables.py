"""The page's tables of all rows, of counters and of the environment."""

from html import escape

from . import words
from .markup import quantity, table, text


class Tables:
  def __init__(self, sweep, plots):
    self.sweep, self.plots = sweep, plots
    self.places = plots.places(sweep.cells)

  def verdict(self, cell):
    if cell.twin:
      return "A/A"
    if cell.reference:
      return "reference"
    return cell.ratio.verdict if cell.ratio else ""

  def error_text(self, cell, source, name):
    """With its range, where it differs from run to run."""
    shown, value = quantity(cell.error(source, name))
    samples = (
      [sample for sample in cell.row.get("error_samples", {}).get(name, []) if sample is not None]
      if source == "error"
      else []
    )
    if samples and min(samples) < max(samples):
      shown += f" ({words.significant(min(samples))} to {words.significant(max(samples))})"
    return shown, value

  def identity(self, cell):
    return [
      quantity(cell.number),
      *(text(cell.values.get(place)) for place in self.places),
      *(text(cell.values.get(axis)) for axis in self.sweep.swept),
    ]

  def identity_heads(self):
    return [
      ("cell", "number"),
      *((place, "short") for place in self.places),
      *((axis, "short") for axis in self.sweep.swept),
    ]

  def rows(self):
    fields = [
      name
      for name in dict.fromkeys(
        [self.plots.error_name, "coverage_mismatch", "id_mismatch", "depth_mismatch", "attribute_max", "psnr"]
      )
      if any(cell.error("error", name) for cell in self.sweep.cells) or name == self.plots.error_name
    ]
    columns = [
      ("error", name) for name in fields if any(cell.error("error", name) is not None for cell in self.sweep.cells)
    ]
    columns += [("truth_error", self.plots.error_name)] if self.sweep.truth else []
    heads = self.identity_heads() + [
      ("status", "short"),
      ("ms", "number"),
      ("quartiles", "number"),
      ("ratio", "number"),
      ("verdict", "short"),
    ]
    heads += [(name + (" from truth" if source == "truth_error" else ""), "number") for source, name in columns]
    any_reason = any(cell.message for cell in self.sweep.cells)
    heads += [("reason", "reason")] * any_reason + [("command", "command")]
    rows = []
    for cell in self.sweep.cells:
      row = self.identity(cell)
      kind = "good" if cell.status == "ok" else "bad"
      row.append((f'<span class="{kind}">{escape(cell.status)}</span>{" (software)" * cell.software}', None))
      row += [
        quantity(cell.ms if cell.timed else None),
        text(" to ".join(words.significant(v) for v in cell.spread[1:]) if cell.timed else ""),
      ]
      row += [quantity(cell.ratio.median if cell.ratio else None), text(self.verdict(cell))]
      row += [self.error_text(cell, source, name) for source, name in columns]
      row += [text(cell.message)] * any_reason
      row += [(f"<code>{escape(cell.row.get('command', ''))}</code>", None)]
      rows.append(row)
    return (
      "rows",
      "All rows",
      '<div class="filter"><label for="filter">Show rows with</label><input id="filter" type="search"'
      ' data-filters="all-rows" aria-describedby="filter-shown" placeholder="words, such as unsupported tile"'
      ' autocomplete="off"><span id="filter-shown" aria-live="polite"></span></div>'
      + table(
        "all-rows",
        "Every cell of the sweep. Times are medians and quartiles of a frame, in ms; the ratio is to the"
        " reference of its group, paired by round. A click on a heading sorts, and one on a command"
        " selects it.",
        heads,
        rows,
      ),
    )

  def counters(self):
    cells = [cell for cell in self.sweep.cells if cell.row.get("counters") and not cell.twin]
    names = [
      name
      for name in dict.fromkeys(name for cell in cells for name in cell.row["counters"])
      if any(cell.row["counters"].get(name) for cell in cells)
    ]
    if not names:
      return None
    heads = (
      self.identity_heads()
      + [("ms", "number")]
      + [(name, "number") for name in names]
      + [("peak of buffers, KiB", "number")]
    )
    rows = []
    for cell in cells:
      peak = cell.row.get("memory", {}).get("peak_buffer_bytes")
      rows.append(
        self.identity(cell)
        + [quantity(cell.ms if cell.timed else None)]
        + [quantity(cell.row["counters"].get(name)) for name in names]
        + [quantity(round(peak / 1024) if peak is not None else None)]
      )
    return (
      "counters",
      "Counters beside times",
      table(
        "all-counters",
        "What each cell's frame counted, beside its time. Counters that are 0 everywhere are left out.",
        heads,
        rows,
      ),
    )

  def environment(self):
    """What differs between the rows stands a column each machine and device; what is the same, once."""
    kinds = {}
    for cell in self.sweep.cells:
      kinds.setdefault((cell.machine, cell.values["device"], cell.values.get("threads", "")), []).append(cell)
    names = [
      name
      for name in dict.fromkeys(name for cell in self.sweep.cells for name in cell.row["provenance"])
      if name not in ("kernels",)
    ]

    def value(cells, name):
      found = list(dict.fromkeys(str(cell.row["provenance"][name]) for cell in cells if name in cell.row["provenance"]))
      if name == "utc":
        return found[0] if len(found) == 1 else f"{min(found)} to {max(found)}" if found else ""
      return "; ".join({"True": "yes", "False": "no"}.get(entry, entry) for entry in found)

    heads = [("", "short")] + [
      (
        ", ".join(part if index < 2 else words.place("threads", part) for index, part in enumerate(key) if part),
        "",
      )
      for key in kinds
    ]
    rows = [[text(name)] + [text(value(cells, name)) for cells in kinds.values()] for name in names]
    clocks = [
      [text("clock")]
      + [
        text("; ".join(dict.fromkeys(cell.row["time_ns"]["clock"] for cell in cells if cell.timed)))
        for cells in kinds.values()
      ]
    ]
    return "<h3>Environment</h3>" + table(
      "environment",
      "The machines and builds that gave the rows. Clock: wall is a steady clock of the CPU, timestamp the GPU's own.",
      heads,
      rows + clocks,
      sortable=False,
    )
