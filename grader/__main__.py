"""`python -m grader` is the same as `grader`."""

import os
import sys

# `-m` puts the current folder first; in a student's folder, their modules would replace ours
OURS = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
SAFE = sys.flags.isolated or getattr(sys.flags, "safe_path", False)
if not SAFE and os.path.realpath(sys.path[0]) != OURS:
    del sys.path[0]

from grader.cli.main import main

if __name__ == "__main__":
    raise SystemExit(main())
