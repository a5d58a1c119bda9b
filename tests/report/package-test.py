"""The package's form: Python's names for what it defines, imports that go one way, and a folder that pip can install."""

import ast
import graphlib
from pathlib import Path
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "experiments" / "report"
PACKAGE = FOLDER / "tessera_report"


def definitions(tree):
  """(kind, name, line) of all that a module defines: classes, functions, arguments, variables, attributes, names of imports."""
  for node in ast.walk(tree):
    if isinstance(node, ast.ClassDef):
      yield "class", node.name, node.lineno
    elif isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
      yield "value", node.name, node.lineno
    elif isinstance(node, ast.arg):
      yield "value", node.arg, node.lineno
    elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
      yield "value", node.id, node.lineno
    elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
      yield "value", node.attr, node.lineno
    elif isinstance(node, ast.alias) and node.asname:
      yield "value", node.asname, node.lineno
    elif isinstance(node, ast.ExceptHandler) and node.name:
      yield "value", node.name, node.lineno


def not_pythons(tree):
  """Names in another style than PEP 8's: CapWords for classes and types, snake_case or CONSTANT_CASE for the rest."""
  types = {target.id for node in tree.body if isinstance(node, ast.Assign) and isinstance(node.value, ast.Subscript)
           for target in node.targets if isinstance(target, ast.Name)}
  external = {"MAX_IMAGE_PIXELS"}
  for kind, name, line in definitions(tree):
    style = r"_?([A-Z][a-z0-9]*)+" if kind == "class" or name in types else r"[a-z_][a-z0-9_]*|[A-Z][A-Z0-9_]*"
    if not re.fullmatch(style, name) and name not in external:
      yield f"{line}: {name}"


def imported(path, tree):
  """The package's modules that a module imports, also inside functions."""
  for node in ast.walk(tree):
    if isinstance(node, ast.ImportFrom) and node.level:
      yield from [node.module] if node.module else [alias.name for alias in node.names]
    elif isinstance(node, (ast.Import, ast.ImportFrom)):
      names = [node.module] if isinstance(node, ast.ImportFrom) else [alias.name for alias in node.names]
      if any(name.split(".")[0] in ("tessera_report", *modules()) for name in names):
        raise AssertionError(f"{path.name}:{node.lineno}: a module of the package; a relative import would be right")


def modules():
  return {path.stem for path in PACKAGE.glob("*.py")} - {"__init__", "__main__"}


def trees():
  return {path: ast.parse(path.read_text(encoding="utf-8")) for path in sorted(PACKAGE.glob("*.py"))}


class Package(unittest.TestCase):
  def test_names_are_pythons(self):
    found = [f"{path.name}:{place}" for path, tree in trees().items() for place in not_pythons(tree)]
    self.assertEqual(found, [])
    for wrong in ("def allRows(): pass", "def rows(allDevices): pass", "kPage = 1", "class sweep_file: pass", "self.xLog = 1",
                  "f = lambda someRow: 1", "import numpy as numPy", "for aRow in (): pass"):
      self.assertTrue(list(not_pythons(ast.parse(wrong))), wrong)

  def test_imports_go_one_way(self):
    graph = {path.stem: set(imported(path, tree)) for path, tree in trees().items()}
    self.assertIn("rows", graph["command"])  # an import in a function counts
    unknown = {name for names in graph.values() for name in names} - modules()
    self.assertEqual(unknown, set())
    try:
      graphlib.TopologicalSorter(graph).prepare()
    except graphlib.CycleError as error:
      self.fail(f"these modules import each other: {' <- '.join(error.args[1])}")

  def test_what_the_page_needs_is_in_the_package(self):
    about = tomllib.loads((FOLDER / "pyproject.toml").read_text(encoding="utf-8"))
    data = about["tool"]["setuptools"]["package-data"]["tessera_report"]
    self.assertEqual(sorted(data), sorted(path.name for path in PACKAGE.iterdir() if path.is_file() and path.suffix != ".py"))
    version = re.search(r"project\(tessera VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
    self.assertEqual(about["project"]["version"], version)
    # Each module from elsewhere is one of a package that is asked for.
    packages = {re.match(r"[\w-]+", line)[0] for line in about["project"]["dependencies"]}
    names = {"PIL": "pillow", "png": "pypng", "vl_convert": "vl-convert-python"}
    used = {alias.name.split(".")[0] for tree in trees().values() for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    used |= {node.module.split(".")[0] for tree in trees().values() for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and not node.level}
    self.assertEqual({names.get(name, name) for name in used - sys.stdlib_module_names}, packages)

  def test_each_way_to_run_it(self):
    """As a module, and from its folder with nothing else on Python's path."""
    with tempfile.TemporaryDirectory() as elsewhere:
      for words, folder in ((["-m", "tessera_report"], FOLDER), (["-I", FOLDER], elsewhere)):
        result = subprocess.run([sys.executable, "-B", *words, "nowhere/rows.jsonl", "--out", Path(elsewhere) / "out", "--schema", "3"],
                                cwd=folder, capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr.count("\n")), (2, 1), result.stderr)
        self.assertIn("tessera: nowhere/rows.jsonl: not a file", result.stderr)


if __name__ == "__main__":
  unittest.main()
