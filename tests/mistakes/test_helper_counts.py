"""A counter that another function changes: the fix names that function and what it has."""

from __future__ import annotations

from tests.mistakes.test_from_source import line_of, look, raised
from tests.mistakes.test_named_exactly import LOG, STEP, UNBOUND, changed, fix_of

START = "        self.counter_ = 0\n"
TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
CALLBACK = "    def timer_callback"


def test_an_attribute_that_init_has_is_not_asked_for_again() -> None:
    text = changed(("self.counter_ += 1", "counter_ += 1"))
    found = raised(UNBOUND.format("counter_"), text, line_of(text, "        counter_ += 1"))
    assert fix_of(found) == "Write self.counter_ instead of counter_ in timer_callback."


def test_a_method_that_the_log_line_calls_is_not_the_counter() -> None:
    text = changed(
        (LOG, LOG.replace("self.counter_", "self.current()")),
        (STEP, ""),
        (CALLBACK, f"    def current(self):\n        return self.counter_\n\n{CALLBACK}"),
    )
    found = look("run.constant_counter", text)
    assert found is None or "self.current" not in fix_of(found)
