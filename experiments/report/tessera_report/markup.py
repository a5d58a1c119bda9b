"""HTML of whole pages, tables and legends."""

from html import escape
from pathlib import Path

from . import words

SHAPES = {  # of the legend, in a box from -6 to 6
  "circle": "M-4,0a4,4 0 1,0 8,0a4,4 0 1,0 -8,0",
  "square": "M-3.5,-3.5h7v7h-7z",
  "triangle-up": "M0,-4.5L4.5,3.5H-4.5z",
  "diamond": "M0,-5L4,0L0,5L-4,0z",
  "triangle-down": "M0,4.5L4.5,-3.5H-4.5z",
  "cross": "M-1.5,-4.5h3v3h3v3h-3v3h-3v-3h-3v-3h3z",
  "triangle-right": "M4.5,0L-3.5,4.5V-4.5z",
}


def swatch(colour, shape="square"):
  return (
    f'<svg width="14" height="14" viewBox="-7 -7 14 14" aria-hidden="true"><path d="{SHAPES[shape]}"'
    f' fill="{colour}"/></svg>'
  )


def table(name, caption, heads, rows, sortable=True):
  """`heads`: (text, class); `rows`: lists of (HTML, value to sort by or None)."""

  def head(text, kind):
    inner = f'<button type="button">{escape(text)}</button>' if sortable else escape(text)
    return f'<th scope="col" class="{kind}">{inner}</th>'

  def cell(content, value, kind):
    sort = f' data-value="{value!r}"' if value is not None else ""
    return f'<td class="{kind}"{sort}>{content}</td>'

  body = "\n".join(
    "<tr>" + "".join(cell(*entry, kind) for entry, (_, kind) in zip(row, heads)) + "</tr>" for row in rows
  )
  return (
    f'<div class="scroll" role="region" aria-label="{escape(caption.split(".")[0])}" tabindex="0">'
    f'<table id="{name}"{" class=sortable" if sortable else ""}><caption><span>{escape(caption)}</span></caption>'
    f"<thead><tr>{''.join(head(*h) for h in heads)}</tr></thead>\n<tbody>\n{body}\n</tbody></table></div>"
  )


def text(value):
  return (escape(str(value)), None) if value not in (None, "") else ("\u2013", None)


def quantity(value, digits=3):
  return (words.significant(value, digits), float(value)) if value is not None else ("\u2013", None)


def document(title, policy, body, style=""):
  """A page with the report's style and `style`; `policy` says what it may load and run."""
  style = Path(__file__).with_name("page.css").read_text(encoding="utf-8") + style
  return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{escape(title)}</title>
<link rel="icon" href="data:,">
<style>
{style}</style>
</head>
<body>
{body}
</body>
</html>
"""
