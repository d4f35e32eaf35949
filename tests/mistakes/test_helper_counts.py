"""A counter that another function changes: the fix names that function and what it has."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.mistakes.test_from_source import line_of, look, raised
from tests.mistakes.test_named_exactly import LOG, STEP, UNBOUND, changed, fix_of, patched, why_of

START = "        self.counter_ = 0\n"
TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
READ_ONLY = "AttributeError: property '{}' of 'MyFirstNode' object has no setter"
CALLBACK = "    def timer_callback"


@pytest.mark.parametrize(
    ("body", "alone"),
    [("self.counter_ += 1", True), ("self.get_clock().now()\n        self.counter_ += 1", False)],
)
def test_a_second_timer_that_only_counts_is_deleted(body: str, alone: bool) -> None:
    text = changed(
        (STEP, ""),
        (TIMER, f"{TIMER}        self.create_timer(0.5, self.count)\n"),
        (CALLBACK, f"    def count(self):\n        {body}\n\n{CALLBACK}"),
    )
    found = look("run.wrong_start", text)
    assert found is not None
    assert found.kind == "node.counts_elsewhere"
    assert "loop" not in why_of(found)
    assert ("delete count, which does nothing else" in fix_of(found)) == alone


@pytest.mark.parametrize(
    ("returned", "fix"),
    [
        ("self._count", "write self._count instead of self.count in line "),
        ("len(self.seen)", "Assign to an attribute with another name"),
    ],
)
def test_a_property_is_kept_if_another_attribute_has_its_value(returned: str, fix: str) -> None:
    text = changed(
        (START, "        self._count = 0\n        self.seen = []\n"),
        (CALLBACK, f"    @property\n    def count(self):\n        return {returned}\n\n{CALLBACK}"),
        (LOG, LOG.replace("self.counter_", "self.count")),
        (STEP, "        self.count += 1\n"),
    )
    found = raised(READ_ONLY.format("count"), text, line_of(text, "self.count += 1"))
    assert found is not None
    assert found.kind == "node.property_set"
    assert fix in fix_of(found)


def test_a_property_named_like_an_attribute_of_init_is_deleted() -> None:
    given = f"    @property\n    def counter_(self):\n        return 0\n\n{CALLBACK}"
    text = changed((CALLBACK, given))
    found = raised(READ_ONLY.format("counter_"), text, line_of(text, START.strip()))
    assert fix_of(found).startswith("Delete the property counter_")


@pytest.mark.parametrize(
    ("added", "fix"),
    [
        ("class Counter:\n    value = 0\n\n    def up(self):\n        value += 1",
         "Write self.value instead of value in up."),
        ("class Counter:\n    def __init__(self):\n        self.value = 0\n\n"
         "    def up(self):\n        value += 1", "Write self.value instead of value in up."),
        ("class Counter:\n    def up(self):\n        value += 1",
         "Write self.value instead of value in up, and self.value = 0 in __init__ of the same "
         "class."),
        ("def up():\n    value += 1",
         "Write value = 0 below the imports of the file, and global value as the first line of "
         "up."),
    ],
)  # fmt: skip
def test_the_function_that_counts_without_self_is_named(added: str, fix: str) -> None:
    text = changed(("class MyFirstNode", f"{added}\n\n\nclass MyFirstNode"))
    found = raised(UNBOUND.format("value"), text, line_of(text, "value += 1"))
    assert found is not None
    assert found.kind == "node.counter_local"
    assert fix_of(found) == fix


def test_an_attribute_that_init_has_is_not_asked_for_again() -> None:
    text = changed(("self.counter_ += 1", "counter_ += 1"))
    found = raised(UNBOUND.format("counter_"), text, line_of(text, "        counter_ += 1"))
    assert fix_of(found) == "Write self.counter_ instead of counter_ in timer_callback."


def test_a_function_outside_of_the_class_cannot_change_an_attribute() -> None:
    text = changed(
        ("class MyFirstNode", "def add():\n    counter_ += 1\n\n\nclass MyFirstNode"),
        ("        self.counter_ += 1", "        add()"),
    )
    found = raised(UNBOUND.format("counter_"), text, line_of(text, "    counter_ += 1"))
    assert fix_of(found) == (
        "add is outside of the class and has no self. Write self.counter_ += 1 in timer_callback "
        "instead of the call of add."
    )


def test_a_method_that_the_log_line_calls_is_not_the_counter() -> None:
    text = changed(
        (LOG, LOG.replace("self.counter_", "self.current()")),
        (STEP, ""),
        (CALLBACK, f"    def current(self):\n        return self.counter_\n\n{CALLBACK}"),
    )
    found = look("run.constant_counter", text)
    assert found is None or "self.current" not in fix_of(found)


def test_a_callback_that_makes_its_own_timer_is_not_left_without_one(tmp_path: Path) -> None:
    text = changed((TIMER, "        self.timer_callback()\n"), (STEP, f"{STEP}{TIMER}"))
    found = look("run.by_hand", text)
    assert found is not None
    assert found.kind == "node.called_by_hand"
    assert fix_of(found) == (
        f"Write {TIMER.strip()} in __init__ instead of self.timer_callback(), and delete the "
        "create_timer from timer_callback."
    )
    assert patched(found, text, tmp_path) == ""


def test_a_method_that_init_calls_too_keeps_its_line(tmp_path: Path) -> None:
    text = changed(
        (START, "        self.reset()\n"),
        (LOG, f"self.reset()\n        {LOG}"),
        (CALLBACK, f"    def reset(self):\n{START}        self.seen = 0\n\n{CALLBACK}"),
    )
    found = look("run.constant_counter", text)
    assert found is not None
    assert found.kind == "node.counter_reset"
    assert "Delete the call of reset from timer_callback" in fix_of(found)
    assert patched(found, text, tmp_path) == ""
