"""Pictures of where images differ, as the page has them."""

from html import escape
import os
from urllib.parse import quote

from . import pictures, words

KEY = (
  ("covered in one image only", "#d55e00"),
  ("another triangle", "#0072b2"),
  ("another depth", "#f0e442"),
  ("another value, colour or hit count", "#cc79a7"),
  ("equal, drawn", "#bebebe"),
  ("equal, empty", "#e6e6e6"),
)


def gallery(sweep, plots, folder):
  """The section's (name, title, HTML), or None where there is no picture; and lines on pictures that are missing. Links begin at
  `folder`."""
  made, notes = pictures.embed(sweep)
  if not made:
    return None, notes
  places = plots.places(sweep.cells)
  key = "".join(f'<span class="swatch" style="background:{colour}"></span>{name}' for name, colour in KEY)
  figures = []
  for picture in made:
    first = picture.cells[0]
    counts = [
      f"{words.pixels(value, name)}{origin}"
      for source, origin in (("error", ""), ("truth_error", f" {plots.truth_words()}"))
      for name, value in first.row.get(source, {}).items()
      if name.endswith("_mismatch") and name != "winner_mismatch" and value and (source == "error" or value != first.row.get("error", {}).get(name))
    ]
    names = ", ".join([*(first.values.get(place, "") for place in places), words.cell_name(first, sweep.swept)])
    others = (
      f" The same in {words.count(len(picture.cells) - 1, 'other cell')}:"
      f" {', '.join(str(cell.number) for cell in picture.cells[1:])}."
      if picture.cells[1:]
      else ""
    )
    name = quote(os.path.relpath(sweep.folder / first.row["picture"], folder))
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
  section = (
    "pictures",
    "Where images differ",
    (
      f'<p class="note">{key}. A picture that is shown smaller keeps of each block the pixel that differs'
      " most, so that a single wrong pixel is still seen. A cell with errors from its own oracle shows"
      f' these, else those from the truth.</p><div class="pictures">{"".join(figures)}</div>'
    ),
  )
  return section, notes
