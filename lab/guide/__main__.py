"""Runs the guide: `python -m lab.guide`."""

import sys

from lab.guide.cli import main

if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
