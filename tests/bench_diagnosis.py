"""`python -m tests.bench_diagnosis`: the time that the diagnosis and the fix add to a verdict.

Real verdicts on broken packages of every stage; seconds of wall time within `diagnose` and
`with_tried_fix` (which tries nothing here), all failed checks of a package together.
"""

from __future__ import annotations

import argparse
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any
from unittest import mock

from grader.verdict import diagnose as diagnosing
from grader.verdict import try_fixes
from tests.bench import bound
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.marking import mark

MOST_SECONDS = 0.15


class Stopwatch:
    """Sums the seconds that functions take."""

    def __init__(self) -> None:
        self.seconds = 0.0

    def on(self, function: Callable[..., Any]) -> Callable[..., Any]:
        """Return the function wrapped with a timer."""

        def timed(*args: Any) -> Any:
            begin = time.perf_counter()
            try:
                return function(*args)
            finally:
                self.seconds += time.perf_counter() - begin

        return timed


def main() -> int:
    """Measure and print; return 1 if the bound is not kept."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--every", type=int, default=6, help="every n-th package of the corpus")
    asked = options.parse_args()
    taken: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as folder:
        for package in BROKEN[:: asked.every]:
            watch = Stopwatch()
            with (
                mock.patch.object(diagnosing, "diagnose", watch.on(diagnosing.diagnose)),
                mock.patch.object(try_fixes, "with_tried_fix", watch.on(try_fixes.with_tried_fix)),
            ):
                mark(write(package, Path(folder)))
            taken[package.name] = watch.seconds
    slowest = max(taken, key=lambda name: taken[name])
    middle = statistics.median(taken.values())
    print(f"diagnosis of {len(taken)} packages: median {middle:.3f} s, slowest {slowest}")
    return 0 if bound("diagnosis and change: seconds", taken[slowest], MOST_SECONDS) else 1


if __name__ == "__main__":
    raise SystemExit(main())
