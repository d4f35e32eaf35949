"""`python -m tests.bench_matrix`: the solution, the starter and every mutant of hello_time, marked.

It exits with 1 if something is not as expected or takes longer than an instructor would wait.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from tests import processes
from tests.bench import at_least, bound

MOST_SECONDS = 600.0
LEAST_MUTANTS = 120


def main() -> int:
    """Measure and print; return 1 if a bound of the project is not kept."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "matrix.json"
        begin = time.monotonic()
        done = subprocess.run(
            processes.grader("validate", "hello_time", "--json", file),
            cwd=processes.ROOT,
            stdout=subprocess.PIPE,
            text=True,
            check=False,
        )
        seconds = time.monotonic() - begin
        if done.returncode != 0:
            sys.exit(done.stdout)
        figures = json.loads(file.read_text(encoding="utf-8"))["figures"]
    named = figures["mistake_named_first"] / figures["named"]
    failed = figures["failed_where_they_must"]
    kept = [
        at_least("mutants that fail where they must", failed, LEAST_MUTANTS),
        at_least("  of those that must fail: share", failed / figures["that_must_fail"], 1.0),
        at_least("named mistake is the first: share", named, 0.95),
        bound("the whole matrix: seconds", seconds, MOST_SECONDS),
    ]
    return 0 if all(kept) else 1


if __name__ == "__main__":
    raise SystemExit(main())
