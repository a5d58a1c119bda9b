"""The rows as one table of DuckDB, in a Parquet or DuckDB file."""

import errno
import json
import os
from pathlib import Path
import tempfile

import duckdb

from .files import beside, NotWritten, writing


def cause(error):
  """What the system said, of one of DuckDB's errors: that has a name of ours and more lines around it. Else its first line."""
  text = str(error)
  return next((os.strerror(number) for number in errno.errorcode if os.strerror(number) in text), text.split("\n")[0])


def write(sweep, path):
  """Table `rows`: fields as in rows.jsonl, nested ones as structs, and first what the report adds. Throws NotWritten."""
  try:
    with writing(path):
      write_table(sweep, path)
  except duckdb.Error as error:
    raise NotWritten(f"{path}: could not be written: {cause(error)}") from error


def write_table(sweep, path):
  with beside(path) as new, tempfile.TemporaryDirectory() as folder:
    lines = Path(folder) / "rows.jsonl"
    with writing(lines), lines.open("w", encoding="utf-8") as file:
      for cell in sweep.cells:
        ratio = cell.ratio
        added = {
          "machine": cell.machine,
          "ms": cell.ms if cell.timed else None,
          "ratio": ratio.median if ratio else None,
          "ratio_low": ratio.low if ratio else None,
          "ratio_high": ratio.high if ratio else None,
          "floor": ratio.floor if ratio else None,
          "verdict": ratio.verdict if ratio else None,
        }
        file.write(json.dumps({**added, **cell.row}) + "\n")
    # Every row counts for the columns' types; keys that few rows have are fields of a struct all the same.
    read = (
      f"SELECT * FROM read_json('{lines}', format='newline_delimited', sample_size=-1,"
      " map_inference_threshold=-1, maximum_object_size=67108864)"
    )
    with duckdb.connect(str(new) if path.suffix == ".duckdb" else ":memory:") as database:
      database.execute(f"CREATE TABLE rows AS {read}")
      if path.suffix == ".parquet":
        database.execute(f"COPY rows TO '{str(new).replace(chr(39), 2 * chr(39))}' (FORMAT parquet)")
