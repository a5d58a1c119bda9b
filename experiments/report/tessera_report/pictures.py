"""Pictures of differences, made small enough for the page without losing a wrong pixel."""

import base64
from dataclasses import dataclass
import hashlib
import io
from pathlib import Path

import numpy
from PIL import Image
import png

from .refused import Refused

# Of the pictures on the page, at most; the largest that fits the budget is taken. The page shows none smaller than it
# is, or a single wrong pixel could be lost on the way to the screen.
EDGE = 256
HALVINGS = 2
BUDGET = 3_000_000  # bytes of all pictures, as they stand in the page
LARGEST = 32768  # pixels along an edge of a raster
WHOLE = 1 << 24  # pixels that are read at once; Pillow would take 4 GB for the largest raster


def fold(rows, factor):
  """`factor` rows of pixels or fewer as one, a pixel for each `factor` columns.

  Of each block the most coloured pixel stays: what agrees is grey, and vermilion (coverage) outdoes blue (id), yellow
  (depth) and purple (the rest) by how far its channels are apart."""
  height, width, _ = rows.shape
  columns = -(-width // factor)
  padded = numpy.pad(rows, ((0, 0), (0, columns * factor - width), (0, 0)), mode="edge")
  blocks = padded.reshape(height, columns, factor, 3).swapaxes(0, 1).reshape(columns, height * factor, 3)
  telling = (blocks.max(axis=2).astype(int) - blocks.min(axis=2)).argmax(axis=1)
  return blocks[numpy.arange(columns), telling]


def pool(pixels, edge):
  """The picture with both sides at most `edge`, and the whole factor by which it became smaller."""
  height, width, _ = pixels.shape
  factor = -(-max(height, width) // edge)
  if factor == 1:
    return pixels, 1
  return numpy.stack([fold(pixels[first : first + factor], factor) for first in range(0, height, factor)]), factor


def pool_rows(rows, width, height, edge):
  """The same of rows as they come, so that no more than a block's are held."""
  factor = -(-max(height, width) // edge)
  small, block = [], []
  for row in rows:
    block.append(numpy.frombuffer(row, numpy.uint8).reshape(width, 3))
    if len(block) == factor:
      small.append(fold(numpy.stack(block), factor))
      block = []
  if block:
    small.append(fold(numpy.stack(block), factor))
  return numpy.stack(small), factor


def place_of(folder, name, where):
  """The picture's file. Nothing outside the folder is read, whatever a row says."""
  path, root = folder / name, folder.resolve()
  inside = not Path(name).is_absolute() and ".." not in Path(name).parts and path.resolve().is_relative_to(root)
  if not inside:
    raise Refused(f"{where}: picture: {name}: lies outside the folder; a path in the folder, such as pictures/3.png, would be right")
  return path


def read(path):
  """(pixels with both sides at most EDGE, factor, size) of a PNG. Throws OSError for what is none."""
  if not path.is_file():
    raise OSError("not a file")
  # The limit is ours: Pillow's own is for pictures from strangers that are read whole.
  Image.MAX_IMAGE_PIXELS = None
  with Image.open(path, formats=["PNG"]) as image:
    width, height = size = image.size
    if max(size) > LARGEST:
      raise OSError(f"larger than {LARGEST} pixels")
    if width * height <= WHOLE:
      return *pool(numpy.asarray(image.convert("RGB")), EDGE), size
  try:
    with path.open("rb") as file:
      _, _, rows, about = png.Reader(file=file).asRGB8()
      return *pool_rows(rows, width, height, EDGE), size
  except (png.Error, ValueError) as error:
    raise OSError(str(error)) from None


def data_uri(image):
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
    path = place_of(sweep.folder, name, f"{sweep.path}:{cell.line}")
    try:
      with path.open("rb") as file:
        key = cell.values["scene"], hashlib.file_digest(file, "sha256").digest() if path.is_file() else None
      if key not in found:
        found[key] = (*read(path), [])
      found[key][3].append(cell)
    except (OSError, SyntaxError, ValueError):  # Pillow has all three for damaged files
      notes.append(f"{name}: the picture of cell {cell.number} is not in the folder, or not one.")
  made = []
  for halvings in range(HALVINGS + 1):
    made = []
    for pixels, factor, size, cells in found.values():
      small, more = pool(pixels, max(EDGE >> halvings, 1)) if max(pixels.shape[:2]) > EDGE >> halvings else (pixels, 1)
      made.append(Picture(cells, data_uri(Image.fromarray(small)), size, small.shape[1::-1], factor * more))
    if sum(len(picture.uri) for picture in made) <= BUDGET:
      return made, notes
  kept = 0
  while sum(len(picture.uri) for picture in made[: kept + 1]) <= BUDGET:
    kept += 1
  notes.append(
    f"{len(made) - kept} of {len(made)} pictures are left out to keep the page small; the folder pictures/ has them."
  )
  return made[:kept], notes
