"""A callback is not said to log nothing where it may log through a value."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import look
from tests.mistakes.test_named_exactly import LOG, changed

START = "        self.counter_ = 0\n"
LINE = "'Hello time: ' + str(self.counter_)"


@pytest.mark.parametrize(
    ("start", "line"),
    [
        ("        self.level = 'debug'\n", f"getattr(self.get_logger(), self.level)({LINE})"),
        ("        self.say = self.get_logger().debug\n", f"self.say({LINE})"),
    ],
)
def test_a_logger_that_is_a_value_may_log(start: str, line: str) -> None:
    found = look("run.no_lines", changed((START, START + start), (LOG, line)))
    assert found is None or found.kind != "node.log_missing"


def test_a_callback_without_a_logger_logs_nothing() -> None:
    found = look("run.no_lines", changed((LOG, "")))
    assert found is not None
    assert found.kind == "node.log_missing"
