"""Puts experiments/report on Python's path: its package tessera_report reads rows, compares times and draws."""
from pathlib import Path
import sys

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "experiments" / "report"))
