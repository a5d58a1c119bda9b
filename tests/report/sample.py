"""Rows as a sweep leaves them, made up: two scenes, sizes and machines, three axes, noise, errors of every kind."""

import hashlib
import json
import random
import sys
from pathlib import Path

SCHEMA = 3
TOML = """title = "Sample"
question = "Does the report show what the rows hold?"
sizes = [256, 512]
[scenes]
ball = {source = "generate:icosphere?level=4", x = 4}
field = {source = "generate:grid", x = 64}
[axes]
tile = [8, 16, 32]
binning = ["exact", "bitmask"]
edge = ["int32", "float32-plane"]
[[also]]
binning = "none"
[truth]
sub-pixel = 8
[plot]
curve = ["binning"]
against = ["tile", "scene", "x"]
x-label = "triangles along an edge"
heat = [["tile", "binning"]]
figure = "ratio-against-tile"
"""
EPYC = {
  "cpu": "AMD EPYC",
  "os": "Linux 6.1 x86_64",
  "device": "AMD EPYC",
  "driver": "g++ 12.2.0",
  "api": "cpu",
  "threads": 2,
}
XEON = {
  "cpu": "Intel Xeon",
  "os": "Linux 6.1 x86_64",
  "device": "Intel Xeon",
  "driver": "g++ 12.2.0",
  "api": "cpu",
  "threads": 8,
}
PIPE = {
  "cpu": "AMD EPYC",
  "os": "Linux 6.1 x86_64",
  "device": "llvmpipe",
  "driver": "Mesa 22.3.6",
  "api": "vulkan 1.3",
  "correctness_only": True,
}
STAGES = {"transform": 0.1, "setup": 0.15, "bin-count": 0.1, "bin-insert": 0.15, "raster-tiles": 0.5}
ROUNDS = 7


def picture(path, edge):
  """Grey, with one wrong pixel: what a smaller picture must not lose."""
  from PIL import Image

  image = Image.new("RGB", (edge, edge), (230, 230, 230))
  image.paste((190, 190, 190), (edge // 4, edge // 4, edge // 2, edge // 2))
  image.putpixel((3, edge - 5), (213, 94, 0))
  path.parent.mkdir(exist_ok=True)
  image.save(path)


def rows(folder, machines=((EPYC, "cpu", 1.0), (PIPE, "vulkan", 30.0), (XEON, "cpu", 0.6))):
  """Machines are (provenance, device as asked for, slowness). The times of a machine drift from round to round."""
  sha256 = hashlib.sha256(TOML.encode()).hexdigest()
  random_ = random.Random(7)
  cells = [
    {"tile": str(tile), "binning": binning, "edge": edge}
    for tile in (8, 16, 32)
    for binning in ("exact", "bitmask")
    for edge in ("int32", "float32-plane")
  ]
  cells.insert(1, cells[0])  # the twin
  cells.append({"binning": "none"})
  for machine, device, slowness in machines:
    number, group = (0, 0) if device == "cpu" else (1000, 100)
    for scene, x, triangles in (("ball", 4, 5120), ("field", 64, 8192)):
      for edge in (256, 512):
        drift = {turn: 1 + 0.3 * random_.random() for turn in range(-ROUNDS, ROUNDS)}
        for index, asked in enumerate(cells):
          row = {
            "schema_version": SCHEMA,
            "run_id": f"{machine['cpu']}-{number}",
            "variant": {"tile": "64", **asked, "sub-pixel": "8"},
            "scene": {"name": scene, "sha256": "0" * 64, "triangles": triangles, "size": [edge, edge]},
            "status": "ok",
          }
          # bitmask is as fast as exact, but for a hair; larger tiles are faster; the cheap edges save a tenth.
          size = int(asked.get("tile", 64))
          ms = (
            slowness * (edge / 256) ** 1.5 * x**0.2 * (1 + 8 / size) * (1.004 if asked["binning"] == "bitmask" else 1)
          )
          ms *= 0.9 if asked.get("edge") == "float32-plane" else 1
          if (scene, size, asked["binning"]) == ("field", 8, "bitmask"):
            row |= {
              "status": "unsupported",
              "message": "tile=8 with binning=bitmask: at least 16 would do <for masks & words>",
            }
          elif (scene, edge, size, asked.get("edge")) == ("field", 512, 16, "float32-plane"):
            row |= {"status": "timeout", "message": "a frame took longer than 60 s"}
          elif (scene, edge, size, asked["binning"], asked.get("edge")) == (
            "ball",
            512,
            32,
            "bitmask",
            "int32",
          ):
            row |= {"status": "error", "message": "12 pixels differ from the oracle"}
          elif (scene, edge, asked["binning"]) == ("ball", 512, "none"):
            row |= {"status": "overflow", "message": "bin 3 holds 9000 of 8192"}
          times = lambda turns: [round(1e6 * ms * drift[turn] * random_.gauss(1, 0.01)) for turn in turns]
          turns = list(range(ROUNDS))
          sessions = [0 if turn < 4 else 1 for turn in turns]
          samples = times(turns)
          ordered = sorted(samples)
          if row["status"] == "ok":
            median = ordered[ROUNDS // 2]
            row["time_ns"] = {
              "samples": samples,
              "rounds": turns,
              "sessions": sessions,
              "median": median,
              "min": ordered[0],
              "iqr": ordered[5] - ordered[1],
              "clock": "timestamp" if device == "vulkan" else "wall",
              "stages": {stage: share * median for stage, share in STAGES.items()},
            }
            if index < 2:  # a sweep that was resumed in round 4
              row["time_ns"]["again"] = {"samples": times([0, 1]), "rounds": [0, 1], "sessions": [1, 1]}
            wrong = round(edge * x / 8) if asked.get("edge") == "float32-plane" else 0
            row["error"] = {
              "pixels": edge * edge,
              "coverage_mismatch": wrong,
              "id_mismatch": 2 * wrong,
              "depth_mismatch": 0,
            }
            row["truth"] = {"sub-pixel": "8"}
            row["truth_error"] = {"coverage_mismatch": wrong, "id_mismatch": 2 * wrong}
            row["counters"] = {
              "tests": 1000 * size,
              "binned": 90000 // size,
              "covered": edge * edge // 2,
              "overflowed": 0,
            }
            row["memory"] = {"peak_buffer_bytes": 4096 * size}
            if wrong:
              row["picture"] = f"pictures/{number}.png"
              if not (folder / row["picture"]).exists():
                picture(folder / row["picture"], edge)
          row["plan"] = {"clear": {"kept": False, "why": "each tile writes all of its own pixels"}}
          row["provenance"] = {
            "git": "0123456789ab",
            "dirty": False,
            "build_type": "Release",
            "compiler": "GNU 12.2.0",
            "flags": "-O3",
            "slang": "2026.14.1",
            "kernel_compiler": "g++ 12.2.0",
            **machine,
            "seed": 1,
            "utc": "2026-11-23T12:00:00Z",
          }
          settings = " ".join(f"--set {axis}={value}" for axis, value in asked.items())
          row["command"] = (
            f"tessera render 'generate:icosphere?level=4' --size {edge}x{edge} {settings} --repeat 1 --json -"
          )
          row["sweep"] = {
            "title": "Sample",
            "question": "Does the report show what the rows hold?",
            "sha256": sha256,
            "cell": number,
            "group": group,
            "reference": index < 2,
            "twin": index == 1,
            "asked": asked,
            "swept": ["tile", "binning", "edge"],
            "scene": scene,
            "x": x,
            "device": device,
            "threads": 0,
          }
          yield row
          number += 1
        group += 1


def write(folder, change=lambda row: row, toml=TOML, **options):
  """A results folder; `change` may alter a row, or leave it out by giving None."""
  folder = Path(folder)
  folder.mkdir(parents=True, exist_ok=True)
  (folder / "sweep.toml").write_text(toml, encoding="utf-8")
  changed = [change(row) for row in rows(folder, **options)]
  (folder / "rows.jsonl").write_text("".join(json.dumps(row) + "\n" for row in changed if row), encoding="utf-8")
  return folder


if __name__ == "__main__":
  write(sys.argv[1])
