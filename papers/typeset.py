"""A write-up as PDF: typeset.py MAIN.typ DATA OUT.pdf. The same values give the same bytes: the fonts are those that Typst brings along
and the date is that of the rows. DATA is the folder of values.json and the figures."""
import datetime
import json
import os
import sys
import tempfile
from pathlib import Path

import typst

sys.path.append(str(Path(__file__).resolve().parents[1] / "experiments" / "report"))
from tessera_report import visible


def main(source, data, out):
  source, data, out = (Path(path).resolve() for path in (source, data, out))
  machine = json.loads((data / "values.json").read_text(encoding="utf-8"))["machine"]
  day = datetime.datetime(machine["year"], machine["month"], machine["day"], tzinfo=datetime.timezone.utc)
  # Paths in the text begin at the root of the file system: data may lie anywhere.
  content, warnings = typst.compile_with_warnings(source, root="/", sys_inputs={"data": str(data)}, ignore_system_fonts=True,
                                                  timestamp=int(day.timestamp()))
  for warning in warnings:
    print(visible.one_line(f"{source.name}: {warning}"), file=sys.stderr)
  with tempfile.TemporaryDirectory(dir=out.parent, prefix=out.name + ".", suffix=".tmp") as folder:
    new = Path(folder) / out.name
    new.write_bytes(content)
    os.replace(new, out)


if __name__ == "__main__":
  if len(sys.argv) != 4:
    sys.exit("usage: typeset.py MAIN.typ DATA OUT.pdf")
  try:
    main(*sys.argv[1:])
  except typst.TypstError as error:
    print(visible.visible(error.diagnostic), file=sys.stderr, end="")
    sys.exit(1)
