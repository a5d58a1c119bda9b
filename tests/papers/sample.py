"""Rows of the three sweeps behind tiles-bins-cells, made up, in the cells that their sweep.toml gives."""
import hashlib
import itertools
import json
import random
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SWEEPS = ("tile-size", "bin-capacity", "pineda-cells")
SCHEMA = 3
ROUNDS = 5


def listed(values):
  """An axis' values as texts; {from, to, times} likewise."""
  if isinstance(values, dict):
    count = itertools.takewhile(lambda value: value <= values["to"], (values["from"] * values["times"] ** i for i in itertools.count()))
    values = list(count)
  return [str(value) for value in values]


def as_texts(table): return {axis: str(value) for axis, value in table.items()}


def asked_of(file):
  asked = [dict(zip(file["axes"], values)) for values in itertools.product(*map(listed, file["axes"].values()))]
  return [as_texts(file.get("set", {})) | cell for cell in (*asked, *map(as_texts, file.get("also", [])))]


def slowness(asked, area):
  """Small tiles and small queues are slow; from 1000 pixels on hierarchical is faster than the others."""
  factor = 1 + 4 / int(asked.get("tile", 64))
  if asked.get("overflow") == "drop":
    factor *= 0.8
  elif int(asked.get("capacity", 1024)) < 1024:
    factor *= 1.2
  return factor * (area / 1000) ** -0.05 if asked.get("traversal") == "hierarchical" else factor


def rows(name, slowness_=slowness):
  text = (ROOT / "experiments" / name / "sweep.toml").read_text(encoding="utf-8")
  file = tomllib.loads(text)
  noise = random.Random(1)
  asked = asked_of(file)
  reference = next(i for i, cell in enumerate(asked) if as_texts(file["reference"]).items() <= cell.items())
  cells = [(cell, i == reference, False) for i, cell in enumerate(asked)]
  cells.insert(reference + 1, (asked[reference], True, True))
  number = 0
  for group, (scene, about) in enumerate(file["scenes"].items()):
    about = about if isinstance(about, dict) else {"source": about}
    area = about.get("x", 100)
    for cell, is_reference, is_twin in cells:
      median = 1e7 * slowness_(cell, area)
      samples = [round(median * noise.gauss(1, 0.01)) for _ in range(ROUNDS)]
      lost = 40000 // int(cell["capacity"]) if cell.get("overflow") == "drop" else 0
      row = {
          "schema_version": SCHEMA, "run_id": f"{name}-{number}", "status": "ok",
          "variant": {"binning": "exact", "tile": "64", "traversal": "cell-reject", "step": "direct", "size-class": "off"} | cell,
          "scene": {"name": scene, "triangles": 20000, "size": [2048, 2048]},
          "time_ns": {"samples": samples, "rounds": list(range(ROUNDS)), "sessions": [0] * ROUNDS, "clock": "wall",
                      "stages": {"transform": 0.1 * median, "setup": 0.2 * median, "bin-count": 0.1 * median, "raster-tiles": 0.6 * median}},
          "error": {"pixels": 2048 * 2048, "coverage_mismatch": lost, "id_mismatch": lost, "depth_mismatch": lost},
          "counters": {"tests": 90000, "covered": 30000, "submitted": 20000, "pieces": 19000, "binned": 40000, "largestBin": 900,
                       "overflowed": lost, "retries": int(cell.get("overflow") == "retry" and int(cell["capacity"]) < 1024)},
          "provenance": {"git": "0123456789ab", "dirty": False, "compiler": "GNU 12.2.0", "slang": "2026.14.1", "cpu": "AMD EPYC", "os": "Linux",
                         "kernel_compiler": "g++ 12.2.0, -O3 (znver3)", "device": "AMD EPYC", "driver": "g++", "api": "cpu", "threads": 2,
                         "utc": "2026-11-23T12:00:00Z"},
          "sweep": {"title": file["title"], "question": file["question"], "sha256": hashlib.sha256(text.encode()).hexdigest(), "cell": number,
                    "group": group, "reference": is_reference, "twin": is_twin, "asked": cell, "swept": list(file["axes"]), "scene": scene,
                    "device": "cpu", "threads": 0},
      }
      if lost:
        row["error_samples"] = {key: [lost - 1, lost, lost + 1] for key in ("coverage_mismatch", "id_mismatch")}
      if "x" in about:
        row["sweep"]["x"] = about["x"]
      yield row
      number += 1


def write(folder, slowness_=slowness, change=lambda row: row):
  """Results folders of the three sweeps; `change` may alter a row, or leave it out by giving None. Gives the folders."""
  folders = []
  for name in SWEEPS:
    into = Path(folder) / name
    into.mkdir(parents=True)
    changed = filter(None, map(change, rows(name, slowness_)))
    (into / "rows.jsonl").write_text("".join(json.dumps(row) + "\n" for row in changed), encoding="utf-8")
    folders.append(into)
  return folders
