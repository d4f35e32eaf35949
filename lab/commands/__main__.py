"""Runs the `lab` program of the lab: `python -m lab.commands`."""

from lab.commands.cli import main

if __name__ == "__main__":
    raise SystemExit(main())
