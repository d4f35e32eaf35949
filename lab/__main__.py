"""Runs the lab: `python -m lab`, or `python3 lab` in a checkout, which is set up first if it is not."""

import os
import sys

# as in grader/__main__.py: nothing is imported from a student's folder
OURS = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
SAFE = sys.flags.isolated or getattr(sys.flags, "safe_path", False)
if not SAFE and os.path.realpath(sys.path[0]) != OURS:
    del sys.path[0]
if not __package__:  # `python3 lab` runs a folder, with any Python: its libraries may differ
    sys.path.insert(0, OURS)
    own = os.path.realpath(os.path.join(OURS, ".venv"))
    if os.path.realpath(sys.prefix) != own:
        import subprocess  # not before the path is safe

        bootstrap = [sys.executable, os.path.join(OURS, "grader", "bootstrap.py")]
        made = subprocess.run(bootstrap, check=False)
        if made.returncode:
            raise SystemExit(made.returncode)
        python = os.path.join(own, "bin", "python")
        os.execv(python, [python, os.path.join(OURS, "lab"), *sys.argv[1:]])  # noqa: S606

from lab.cli import main

if __name__ == "__main__":
    raise SystemExit(main())
