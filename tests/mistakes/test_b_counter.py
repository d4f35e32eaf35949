"""Diagnoses of a counter: each statement is true of the program."""

from __future__ import annotations

import re

import pytest

from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.recognised import RecognisedMistake
from tests.mistakes.other_forms import LOG, RIGHT, STEP, changed
from tests.mistakes.test_from_source import line_of, raised

INT_AND_STR = "TypeError: unsupported operand type(s) for +=: 'int' and 'str'"


def texts(found: RecognisedMistake | None) -> tuple[str, str]:
    """Return the reason and the fix."""
    assert found is not None
    kind, words = CATALOGUE[found.kind], {**found.params, **found.words}
    return str(kind.rationale(words, found.variant)), str(kind.fix_text(words, found.variant))


def kind_at(error: str, text: str, part: str) -> str:
    """Return the kind behind an error of the line that has this part."""
    found = raised(error, text, line_of(text, part))
    return "" if found is None else found.kind


def test_the_number_in_quotes_is_that_of_the_line_and_not_of_another_one() -> None:
    rows = "        word = 'a'\n        word += '5'\n        self.counter_ += '1'\n"
    text = changed(RIGHT, (STEP, rows))
    found = raised(INT_AND_STR, text, line_of(text, "self.counter_ +="))
    assert found is not None
    assert found.kind == "node.step_is_text"
    assert "self.counter_ += 1" in texts(found)[1]


@pytest.mark.parametrize("added", ["' seconds'", "step"])
def test_what_is_no_number_in_quotes_is_not_told_to_lose_its_quotes(added: str) -> None:
    rows = f"        word = 'a'\n        word += '5'\n        step = '1'\n        self.counter_ += {added}\n"
    text = changed(RIGHT, (STEP, rows))
    assert kind_at(INT_AND_STR, text, "self.counter_ +=") != "node.step_is_text"


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
SUM = "def add_up(numbers):\n    for one in numbers:\n        total += one\n    return total\n\n\nclass MyFirst"


@pytest.mark.parametrize(
    ("edit", "part", "name", "written"),
    [
        ((LOG, f"text += 'Hello time: ' + str(self.counter_)\n        {LOG}"), "text +=", "text", "text = ''"),
        ((LOG, f"text = text + f'{{self.counter_}}'\n        {LOG}"), "text =", "text", "text = ''"),
        ((STEP, "        for n in self.get_all():\n            n_ += n['step']\n"), "n_ +=", "n_", "n_ = 0"),
        (("class MyFirst", SUM), "total +=", "total", "total = 0"),
    ],
)  # fmt: skip
def test_a_text_or_a_sum_that_a_call_builds_is_not_told_to_outlast_the_call(
    edit: tuple[str, str], part: str, name: str, written: str
) -> None:
    text = changed(RIGHT, edit)
    found = raised(UNBOUND.format(name), text, line_of(text, part))
    assert found is not None
    assert (found.kind, found.variant) == ("node.variable_not_set", "added_to")
    assert f"Write {written} on" in texts(found)[1]


@pytest.mark.parametrize("step", ["counter_ += 1", "counter_ = counter_ + self.step"])
def test_a_counter_without_self_is_told(step: str) -> None:
    text = changed(RIGHT, (STEP, f"        {step}\n"))
    assert kind_at(UNBOUND.format("counter_"), text, step) == "node.counter_local"
