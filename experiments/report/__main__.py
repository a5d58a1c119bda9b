"""Runs the package from this folder: python3 -I experiments/report ARGUMENTS, as `tessera report` does. With -I neither PYTHONPATH
nor the working folder counts, so that the package need not be installed and no other package of its name is taken."""

import sys

from tessera_report.command import run

sys.exit(run())
