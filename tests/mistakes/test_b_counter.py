"""Diagnoses of a counter: each statement is true of the program."""

from __future__ import annotations

import re

import pytest

from grader.mistakes.catalogue import CATALOGUE
from tests.mistakes.other_forms import RIGHT, START, STEP, changed
from tests.mistakes.test_from_source import line_of, raised


def kind_at(error: str, text: str, part: str) -> str:
    """Return the kind behind an error of the line that has this part."""
    found = raised(error, text, line_of(text, part))
    return "" if found is None else found.kind


@pytest.mark.parametrize(
    ("kind", "value"),
    [
        ("list", "[self.counter_]"),
        ("method", "self.get_name"),
        ("Time", "self.get_clock().now()"),
        ("bytes", "str(self.counter_).encode()"),
        ("int", "self.counter_"),
    ],
)
def test_only_a_number_is_told_to_be_made_a_string_of(kind: str, value: str) -> None:
    text = changed(RIGHT, ("str(self.counter_)", value))
    error = f'TypeError: can only concatenate str (not "{kind}") to str'
    is_number = kind == "int"
    assert (kind_at(error, text, "info(") == "node.str_plus_int") is is_number
    seen = CATALOGUE["node.str_plus_int"].seen
    assert (re.search(seen, error) is not None) is is_number


UNBOUND = (
    "UnboundLocalError: cannot access local variable '{}' where it is not associated with a value"
)


@pytest.mark.parametrize("step", ["counter_ += 1", "counter_ = counter_ + self.step"])
def test_a_counter_without_self_is_told(step: str) -> None:
    text = changed(RIGHT, (STEP, f"        {step}\n"))
    assert kind_at(UNBOUND.format("counter_"), text, step) == "node.counter_local"


@pytest.mark.parametrize(
    ("first", "step"),
    [
        ("'0'", "self.counter_ = str(self.counter_ + 1)"),
        ("0", "self.counter_ = str(self.counter_ + 1)"),
        ("'Hello time: '", "self.counter_ = str(self.counter_ + 1)"),
        ("'Hello time: '", "self.counter_ += 1"),
        ("f'Hello time: '", "self.counter_ += 1"),
        ("str(self.get_name())", "self.counter_ += 1"),
        ("self.first_text()", "self.counter_ = self.counter_ + 1"),
        ("input()", "self.counter_ = self.counter_ + 1"),
    ],
)
def test_str_is_not_told_where_the_counter_is_a_text(first: str, step: str) -> None:
    start = f"        self.counter_ = {first}\n"
    text = changed(RIGHT, (START, start), ("self.counter_ += 1", step))
    error = 'TypeError: can only concatenate str (not "int") to str'
    found = raised(error, text, line_of(text, step))
    assert found is None or found.kind != "node.str_plus_int"
