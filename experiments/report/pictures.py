"""Pictures of differences, made small enough for the page without losing a wrong pixel."""

import base64
from dataclasses import dataclass
import io

import numpy
from PIL import Image

# Of the pictures on the page, at most; the largest that fits the budget is taken. The page shows none smaller than it
# is, or a single wrong pixel could be lost on the way to the screen.
kEdges = (256, 192, 128, 64)
kBudget = 3_000_000  # bytes of all pictures, as they stand in the page


def pool(pixels, edge):
  """The picture with both sides at most `edge`, and the whole factor by which it became smaller.

  Of each block the most coloured pixel stays: what agrees is grey, and vermilion (coverage) outdoes blue (id), yellow
  (depth) and purple (the rest) by how far its channels are apart."""
  height, width, _ = pixels.shape
  factor = -(-max(height, width) // edge)
  if factor == 1:
    return pixels, 1
  rows, columns = -(-height // factor), -(-width // factor)
  padded = numpy.pad(pixels, ((0, rows * factor - height), (0, columns * factor - width), (0, 0)), mode="edge")
  blocks = padded.reshape(rows, factor, columns, factor, 3).swapaxes(1, 2).reshape(rows, columns, factor * factor, 3)
  colour = blocks.max(axis=3).astype(int) - blocks.min(axis=3)
  telling = colour.argmax(axis=2)
  return numpy.take_along_axis(blocks, telling[:, :, None, None], axis=2)[:, :, 0], factor


def encode(pixels):
  """A data URI."""
  image = Image.fromarray(pixels)
  file = io.BytesIO()
  image.save(file, "PNG", optimize=True)
  return "data:image/png;base64," + base64.b64encode(file.getvalue()).decode()


@dataclass
class Picture:
  cells: list  # that have this very picture
  uri: str
  size: tuple  # width and height, in pixels
  shown: tuple  # the same, on the page
  factor: int  # how many pixels' edge became one


def embed(sweep):
  """The pictures, equal ones once, and lines on what is missing."""
  found, notes = {}, []
  for cell in sweep.cells:
    name = cell.row.get("picture")
    if not name:
      continue
    try:
      with Image.open(sweep.folder / name) as image:
        pixels = numpy.asarray(image.convert("RGB"))
    except OSError:
      notes.append(f"{name}: the picture of cell {cell.number} is not in the folder, or not one.")
      continue
    found.setdefault((cell.values["scene"], pixels.shape, pixels.tobytes()), (pixels, []))[1].append(cell)
  for edge in kEdges:
    made = []
    for pixels, cells in found.values():
      small, factor = pool(pixels, edge)
      made.append(Picture(cells, encode(small), pixels.shape[1::-1], small.shape[1::-1], factor))
    if sum(len(picture.uri) for picture in made) <= kBudget:
      return made, notes
  kept = 0
  while sum(len(picture.uri) for picture in made[: kept + 1]) <= kBudget:
    kept += 1
  notes.append(
    f"{len(made) - kept} of {len(made)} pictures are left out to keep the page small; the folder pictures/ has them."
  )
  return made[:kept], notes
