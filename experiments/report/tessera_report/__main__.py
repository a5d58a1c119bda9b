"""python3 -m tessera_report: the page and figures of a sweep."""

import sys

from .command import run

sys.exit(run())
