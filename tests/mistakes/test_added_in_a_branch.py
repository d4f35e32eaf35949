"""An addition in a branch that is left before the log line is not told as one before that line."""

from __future__ import annotations

import pytest

from tests.mistakes.test_diagnose import RIGHT
from tests.mistakes.test_from_source import look

BRANCH = """\
        if self.counter_ == 0:
            self.counter_ += 1
            {leave}
"""


@pytest.mark.parametrize(("leave", "is_told"), [("return", False), ("pass", True)])
def test_only_what_runs_before_the_line_adds_before_it(leave: str, *, is_told: bool) -> None:
    log = next(line for line in RIGHT.splitlines(keepends=True) if ".info(" in line)
    found = look("run.wrong_start", RIGHT.replace(log, BRANCH.format(leave=leave) + log))
    assert (found is not None and found.kind == "node.adds_before_log") is is_told
