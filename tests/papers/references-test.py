"""papers/references.bib, the notes and the list of axes agree. Takes the path of `tessera`."""
import json
import re
import subprocess
import sys
import unicodedata
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAPERS = ROOT / "papers"


def read_entries():
  """Key -> fields. An entry begins with @ and ends with a } on a line of its own, a field a line: as the file is written."""
  entries = {}
  text = (PAPERS / "references.bib").read_text(encoding="utf-8")
  for key, body in re.findall(r"^@\w+\{([^,\s]+),\n(.*?)^\}$", text, re.MULTILINE | re.DOTALL):
    if key in entries:
      raise ValueError(f"references.bib: {key} is there twice")
    entries[key] = dict(re.findall(r"^  (\w+)\s*= \{(.*)\},$", body, re.MULTILINE))
  return entries


def plain(name):
  """A surname in the letters of keys: M{\\"u}ller -> mueller, Müller -> mueller."""
  name = re.sub(r'\{\\"(\w)\}', r"\1e", name).replace("{\\l}", "l")
  name = re.sub("[äöü]", lambda found: unicodedata.normalize("NFD", found[0])[0] + "e", name)
  return re.sub(r"[^a-z-]", "", name.lower())


def first_surname(authors):
  first = authors.split(" and ")[0]
  return plain(first.split(",")[0] if "," in first else first.split()[-1])


def key_of(source):
  """Pineda, A parallel ..., SIGGRAPH 1988 -> pineda1988; Slang user guide, chapter ... -> slang-user-guide."""
  year = re.search(r"\b(1[5-9]|20)\d\d\b", source)
  if year:
    return plain(re.split(r"[ ,]", source)[0]) + year[0]
  return re.split(r"[,:]", source)[0].lower().replace(" ", "-")


def sources():
  """(axis, source) of all axes and values; several are apart by semicolons, and a shorter name of a source stands for it."""
  axes = json.loads(subprocess.run([tessera, "variants", "--json"], check=True, capture_output=True, text=True).stdout)
  found = {}
  for axis in axes:
    for place in (axis, *axis.get("values", [])):
      for source in filter(None, map(str.strip, place["source"].split(";"))):
        found.setdefault(source, axis["name"])
  return found


class References(unittest.TestCase):
  def test_keys_are_author_and_year(self):
    for key, fields in read_entries().items():
      with self.subTest(key):
        self.assertIn("title", fields)
        if "author" in fields:
          self.assertEqual(key, first_surname(fields["author"]) + fields["year"])

  def test_each_source_of_an_axis_is_there(self):
    found = sources()
    self.assertGreater(len(found), 10)
    entries = read_entries()
    for source, axis in found.items():
      self.assertTrue(key_of(source) in entries, f'axis {axis} names "{source}"; references.bib should have an entry {key_of(source)}')

  def test_each_note_is_of_an_entry_and_in_the_index(self):
    index = (PAPERS / "README.md").read_text(encoding="utf-8")
    entries = read_entries()
    notes = {path.stem for path in (PAPERS / "notes").iterdir()}
    self.assertEqual(notes - entries.keys(), set(), "notes without an entry")
    self.assertEqual(sorted(re.findall(r"^\| `([^`]+)` \|", index, re.MULTILINE)), sorted(entries), "rows of README.md")
    self.assertEqual(set(re.findall(r"\]\(notes/(.+?)\.md\)", index)), notes, "notes linked from README.md")

  def test_what_notes_name_is_there(self):
    """A link's file is there, and the names in code behind it, up to the next link, occur in the file."""
    names = 0
    for page in (*sorted((PAPERS / "notes").iterdir()), PAPERS / "README.md"):
      for line in page.read_text(encoding="utf-8").splitlines():
        links = list(re.finditer(r"\[[^\]]*\]\(([^)#]+)\)", line))
        for link, following in zip(links, [*links[1:], None]):
          if "://" in link[1]:
            continue
          target = (page.parent / link[1]).resolve()
          self.assertTrue(target.exists(), f"{page}: {link[1]} is not there")
          if not line.startswith("|") or not target.is_file() or PAPERS in target.parents:
            continue
          text = target.read_text(encoding="utf-8")
          for name in re.findall(r"`(\w+)`", line[link.end():following.start() if following else len(line)]):
            names += 1
            self.assertRegex(text, rf"\b{name}\b", f"{page}: {link[1]} has no {name}")
    self.assertGreater(names, 50)


if __name__ == "__main__":
  tessera = sys.argv.pop(1)
  unittest.main()
