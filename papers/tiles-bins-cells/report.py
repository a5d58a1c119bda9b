"""Puts experiments/report on Python's path: what reads rows, compares times and draws is there."""
from pathlib import Path
import sys

kRoot = Path(__file__).resolve().parents[2]
sys.path.append(str(kRoot / "experiments" / "report"))
