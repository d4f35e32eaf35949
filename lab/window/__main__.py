"""Runs the window: `python -m lab.window`."""

import sys

from lab.window.cli import main

if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
