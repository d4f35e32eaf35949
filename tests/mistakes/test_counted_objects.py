"""A count that is in a list or another object is not told to become a number."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import look
from tests.mistakes.test_named_exactly import LOG, STEP, changed

START = "self.counter_ = 0"
LENGTH = "self.get_logger().info('Hello time: ' + str(len(self.counter_)))"
APPEND = "self.counter_.append('x')"


@pytest.mark.parametrize(
    ("start", "shown", "step"),
    [
        ("['x']", "len(self.counter_)", "self.counter_.append('x')"),
        ("{'n': 1}", "self.counter_['n']", "self.counter_['n'] += 1"),
        ("make_counts()", "self.counter_['n']", "self.counter_['n'] += 1"),
        ("Counter(1)", "self.counter_.value", "self.counter_.value += 1"),
        ("count(1)", "next(self.counter_)", "pass"),
        ("self.numbers", "self.counter_()", "pass"),
    ],
)
def test_an_object_with_the_count_in_it_stays_what_it_is(start: str, shown: str, step: str) -> None:
    text = changed(
        (START, f"self.counter_ = {start}"),
        (LOG, f"self.get_logger().info('Hello time: ' + str({shown}))"),
        (STEP, f"        {step}\n"),
    )
    found = look("run.wrong_start", text)
    assert found is None or found.kind != "node.starts_elsewhere"
