"""Files that appear whole or not at all."""

from contextlib import contextmanager
import fcntl
import os
from pathlib import Path
import re
import shutil
import stat
import tempfile

from .refused import Refused


def lock(folder):
  """A descriptor that holds the folder as one in use, or None where another has it."""
  descriptor = os.open(folder, os.O_RDONLY | os.O_NOFOLLOW)
  try:
    fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    return descriptor
  except OSError:
    os.close(descriptor)
    return None


def clear_temporaries(parent, stem):
  """Removes what killed runs left, which nobody holds, as host/support/temporary.cpp does."""
  for entry in list(os.scandir(parent)):
    if re.fullmatch(re.escape(stem) + r"\.\d+-[a-z0-9_]+\.tmp", entry.name) and entry.is_dir(follow_symlinks=False):
      descriptor = lock(entry.path)
      if descriptor is not None:
        shutil.rmtree(entry.path, ignore_errors=True)
        os.close(descriptor)


class NotWritten(Exception):
  """One line: file, and why it could not be written."""


@contextmanager
def writing(path):
  """What fails in it is said of `path`: a write has no name, and that of a temporary file says nothing."""
  try:
    yield
  except OSError as error:
    raise NotWritten(f"{path}: could not be written: {error.strerror}") from error


@contextmanager
def beside(path):
  """A new file to write, in a folder of its own beside `path`; synced and renamed over it at the end. Symbolic links lead to their target."""
  target = Path(os.path.realpath(path))
  stem = target.name.encode()[:100].decode(errors="ignore")
  clear_temporaries(target.parent, stem)
  with tempfile.TemporaryDirectory(dir=target.parent, prefix=f"{stem}.{os.getpid()}-", suffix=".tmp") as folder:
    held = lock(folder)
    new = Path(folder) / "new"
    yield new
    with new.open("rb") as file:
      os.fsync(file.fileno())
    if target.exists():
      new.chmod(stat.S_IMODE(target.stat().st_mode))
    os.replace(new, target)
    if held is not None:
      os.close(held)


def write_beside(path, content):
  with writing(path), beside(path) as new:
    new.write_bytes(content)


def check_apart(path, rows):
  """Refuses an output that is no file, or is one that the report reads, under whatever name."""
  if path.exists() and not path.is_file():
    raise Refused(f"{path}: is no file; a file name would do")
  for read in (rows, rows.parent / "journal.jsonl", rows.parent / "sweep.toml"):
    if path.exists() and read.exists() and path.samefile(read):
      raise Refused(f"{path}: is {read}, which the report reads; another name would keep it")
