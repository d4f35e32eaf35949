"""Runs the lab: `python -m lab`, or `python3 lab` in a checkout, which is set up first if it is not."""

import os
import sys

# as in grader/__main__.py: nothing is imported from a student's folder
OURS = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
SAFE = sys.flags.isolated or getattr(sys.flags, "safe_path", False)
if not SAFE and os.path.realpath(sys.path[0]) != OURS:
    del sys.path[0]
if not __package__:  # `python3 lab` runs a folder
    sys.path.insert(0, OURS)

try:
    from lab.cli import main
except ModuleNotFoundError as error:
    own = os.path.join(OURS, ".venv", "bin", "python")
    if __package__ or sys.executable == own:
        raise
    # another Python than that of the checkout's environment
    import subprocess  # as above: not before the path is safe

    made = subprocess.run(
        [sys.executable, os.path.join(OURS, "grader", "bootstrap.py")], check=False
    )
    if made.returncode:
        raise SystemExit(made.returncode) from error
    os.execv(own, [own, os.path.join(OURS, "lab"), *sys.argv[1:]])  # noqa: S606 - our own Python

if __name__ == "__main__":
    raise SystemExit(main())
