"""One page over the reports of several sweeps: python3 -m tessera_report.index OUT NAME... --schema N, of the folders OUT/NAME.

It needs no network: figures are in it, small, and each links to its sweep's report beside it."""

import argparse
from html import escape
from pathlib import Path
import sys
from urllib.parse import quote

from PIL import Image

from . import rows, visible
from .files import write_beside
from .markup import document
from .pictures import data_uri
from .plots import Plots
from .refused import Refused
from .summary import Summary

POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
EDGE = 640  # pixels of a figure's longer side, at most
STYLE = """
.sweeps { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 22rem), 1fr)); gap: 1.6rem; margin: 2rem 0; }
.sweeps article { border-top: 1px solid var(--line); min-width: 0; }
.sweeps h2 { border: 0; margin: .6rem 0 .2rem; padding: 0; font-size: 1.2rem; }
.sweeps img { width: 100%; height: 13rem; object-fit: contain; object-position: left top; background: #fff; }
"""


def thumbnail(path):
  """A data URI of a figure, or None where there is none."""
  if not path.is_file():
    return None
  with Image.open(path, formats=["PNG"]) as image:
    image.thumbnail((EDGE, EDGE))
    return data_uri(image.convert("RGB").quantize(64))


def entry(out, name, schema):
  report = out / name / "report"
  link = f"{quote(name)}/report/index.html"
  try:
    sweep = rows.read_sweep(out / name, schema)
  except Refused as refused:
    return f"<article><h2>{escape(name)}</h2><p>No report: {escape(visible.visible(str(refused)))}</p></article>"
  outcome = Summary(sweep, Plots(sweep, False)).outcome()
  image = thumbnail(report / "figures" / "figure.png")
  figure = f'<a href="{link}"><img src="{image}" alt="Figure of {escape(name)}"></a>' if image else "<p>No figure.</p>"
  title = escape(sweep.title)
  head = f'<a href="{link}">{title}</a>' if (report / "index.html").is_file() else title
  return (
    f'<article><h2>{head}</h2>{figure}<p class="note">{escape(sweep.question)}</p>'
    f"<p>{escape(outcome)}</p></article>"
  )


def html(out, names, schema):
  entries = "\n".join(entry(out, name, schema) for name in names)
  body = f"""<header><h1>Experiments</h1><p class="question">What came out of each sweep here.</p></header>
<main><div class="sweeps">
{entries}
</div></main>"""
  return document("Experiments", POLICY, body, STYLE)


def main():
  parser = argparse.ArgumentParser(prog="tessera_report.index")
  parser.add_argument("out", type=Path)
  parser.add_argument("names", nargs="+")
  parser.add_argument("--schema", type=int, required=True)
  arguments = parser.parse_args()
  path = arguments.out / "index.html"
  write_beside(path, html(arguments.out, arguments.names, arguments.schema).encode())
  print(visible.one_line(f"wrote {path}"))


if __name__ == "__main__":
  sys.exit(main())
