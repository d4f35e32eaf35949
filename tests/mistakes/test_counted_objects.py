"""A count that is in a list or another object is not told to become a number."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import look
from tests.mistakes.test_named_exactly import LOG, STEP, changed, fix_of

START = "self.counter_ = 0"
LENGTH = "self.get_logger().info('Hello time: ' + str(len(self.counter_)))"
APPEND = "self.counter_.append('x')"


def test_a_list_that_grows_before_the_log_line_grows_after_it() -> None:
    text = changed((START, "self.counter_ = []"), (LOG, f"{APPEND}\n        {LENGTH}"), (STEP, ""))
    found = look("run.wrong_start", text)
    assert found is not None
    assert found.kind == "node.adds_before_log"
    assert fix_of(found).startswith(f"Move this line ({APPEND}) below line ")


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


def test_a_number_still_starts_where_the_count_starts() -> None:
    found = look("run.wrong_start", changed((START, "self.counter_ = int('1')")))
    assert fix_of(found) == "Write on that line: self.counter_ = 0"
