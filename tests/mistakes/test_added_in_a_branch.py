"""An addition in a branch that is left before the log line is not told as one before that line."""

from __future__ import annotations

from tests.mistakes.test_diagnose import RIGHT
from tests.mistakes.test_from_source import look

BRANCH = """\
        if self.counter_ == 0:
            self.counter_ += 1
            return
"""


def test_only_what_runs_before_the_line_adds_before_it() -> None:
    log = next(line for line in RIGHT.splitlines(keepends=True) if ".info(" in line)
    found = look("run.wrong_start", RIGHT.replace(log, BRANCH + log))
    assert found is None or found.kind != "node.adds_before_log"
