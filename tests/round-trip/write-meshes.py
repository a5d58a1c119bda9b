"""write-meshes.py FOLDER: each FOLDER/NAME.mesh as OBJ, OFF, PLY and STL, by trimesh and plyfile.

A .mesh holds two uint64 (vertices, triangles), three float64 a vertex and three uint32 a triangle. What follows the name
says how the file is written; round-trip-test.cpp says what must come back of each.
"""

import sys
from pathlib import Path

import numpy
import plyfile
import trimesh
from trimesh.exchange import obj, off, ply, stl

# Digits after the point: no double of these meshes needs more to come back as it was.
DIGITS = 60


def read(path: Path) -> tuple[numpy.ndarray, numpy.ndarray]:
  data = path.read_bytes()
  vertices, triangles = (int(n) for n in numpy.frombuffer(data, "<u8", 2))
  positions = numpy.frombuffer(data, "<f8", 3 * vertices, 16).reshape(-1, 3)
  return positions, numpy.frombuffer(data, "<u4", 3 * triangles, 16 + 24 * vertices).reshape(-1, 3)


def with_trimesh(stem: str, positions: numpy.ndarray, faces: numpy.ndarray) -> None:
  mesh = trimesh.Trimesh(positions, faces, process=False, validate=False)
  Path(f"{stem}.obj").write_text(obj.export_obj(mesh, include_normals=False, digits=DIGITS))
  Path(f"{stem}-normals.obj").write_text(obj.export_obj(mesh, include_normals=True, digits=DIGITS))
  Path(f"{stem}.off").write_text(off.export_off(mesh, digits=DIGITS))
  Path(f"{stem}-text.stl").write_text(stl.export_stl_ascii(mesh))
  Path(f"{stem}.stl").write_bytes(stl.export_stl(mesh))
  Path(f"{stem}-float32-text.ply").write_bytes(ply.export_ply(mesh, "ascii"))
  Path(f"{stem}-float32.ply").write_bytes(ply.export_ply(mesh, "binary"))


def records(columns: dict[str, numpy.ndarray]) -> numpy.ndarray:
  count = len(next(iter(columns.values())))
  table = numpy.empty(count, [(name, column.dtype, column.shape[1:]) for name, column in columns.items()])
  for name, column in columns.items():
    table[name] = column
  return table


def with_plyfile(stem: str, positions: numpy.ndarray, faces: numpy.ndarray) -> None:
  x, y, z = positions.T
  count, of_faces = len(positions), len(faces)
  numbers = numpy.arange(max(count, of_faces))
  plain = [
    plyfile.PlyElement.describe(records({"x": x, "y": y, "z": z}), "vertex"),
    plyfile.PlyElement.describe(records({"vertex_indices": faces.astype("i4")}), "face"),
  ]
  vertex = {
    "u": numbers[:count].astype("i2"), "z": z, "red": numbers[:count].astype("u1"), "x": x, "confidence": (x * 2).astype("f4"), "y": y,
    "v": numbers[:count].astype("i4"),
  }
  # plyfile 1.1.5 leaves the numbers beside a list in the machine's own byte order, so a list among them has a file of its own.
  with_list = {"list": faces[:1].repeat(count, 0), **vertex}
  # Faces first, other orders, types and names, and more elements, properties and lists than anybody asked for.
  strange = [
    plyfile.PlyElement.describe(records({"key": numbers[:5].astype("u2"), "weight": numbers[:5] / 3}), "before"),
    plyfile.PlyElement.describe(
      records({"flags": numbers[:of_faces].astype("u1"), "vertex_index": faces, "s": (faces * 0.5).astype("f4"), "area": numbers[:of_faces] / 7}),
      "face",
      len_types={"vertex_index": "u2", "s": "i1"},
    ),
    plyfile.PlyElement.describe(records({"ends": faces[:, :2].astype("i2")}), "edge", len_types={"ends": "u4"}),
    plyfile.PlyElement.describe(records(vertex), "vertex"),
    plyfile.PlyElement.describe(records({"view": numpy.eye(3)[:2].astype("f4")}), "camera"),
  ]
  listed = [plyfile.PlyElement.describe(records(with_list), "vertex") if e.name == "vertex" else e for e in strange]
  for name, elements in (("", plain), ("-strange", strange), ("-list", listed)):
    for kind, text, order in (("text", True, "="), ("little", False, "<"), ("big", False, ">")):
      if name == "-list" and kind == "big":
        continue
      comments = ["made by a second library", ""]
      plyfile.PlyData(elements, text=text, byte_order=order, comments=comments, obj_info=["info"]).write(f"{stem}{name}-{kind}.ply")


for path in sorted(Path(sys.argv[1]).glob("*.mesh")):
  for write in with_trimesh, with_plyfile:
    write(str(path.with_suffix("")), *read(path))
