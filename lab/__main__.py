"""Runs the lab: `python -m lab`."""

import os
import sys

# as in grader/__main__.py: nothing is imported from a student's folder
OURS = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
SAFE = sys.flags.isolated or getattr(sys.flags, "safe_path", False)
if not SAFE and os.path.realpath(sys.path[0]) != OURS:
    del sys.path[0]

from lab.cli import main

if __name__ == "__main__":
    raise SystemExit(main())
