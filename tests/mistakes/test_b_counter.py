"""Diagnoses of a counter: each statement is true of the program."""

from __future__ import annotations

import re

import pytest

from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import RecognisedMistake, Suspect
from tests.marking import ASSIGNMENT
from tests.mistakes.other_forms import RIGHT, START, STEP, changed
from tests.mistakes.test_from_source import line_of, look, node_in, raised
from tests.mistakes.test_spun_and_ended import texts

INT_AND_STR = "TypeError: unsupported operand type(s) for +=: 'int' and 'str'"


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


@pytest.mark.parametrize("step", ["counter_ += 1", "counter_ = counter_ + self.step"])
def test_a_counter_without_self_is_told(step: str) -> None:
    text = changed(RIGHT, (STEP, f"        {step}\n"))
    assert kind_at(UNBOUND.format("counter_"), text, step) == "node.counter_local"


def method(name: str, *rows: str) -> tuple[str, str]:
    """Return the edit that writes a method above the callback."""
    body = "".join(f"        {row}\n" for row in rows)
    return "    def timer_callback", f"    def {name}:\n{body}\n    def timer_callback"


COUNT = method("count(self)", "self.counter_ += 1")


@pytest.mark.parametrize("symptom", ["run.wrong_step", "run.wrong_start", "run.constant_counter"])
def test_a_method_that_nothing_calls_does_not_count_beside_the_callback(symptom: str) -> None:
    for step in ("self.counter_ += 2", "self.more()"):
        more = method("more(self)", "self.counter_ += 2")
        text = changed(RIGHT, (STEP, f"        {step}\n"), COUNT, more)
        found = look(symptom, text)
        assert found is None or found.kind != "node.counts_elsewhere"


def test_a_method_that_never_runs_does_not_change_the_first_number() -> None:
    found = look("run.wrong_start", changed(RIGHT, (STEP, ""), COUNT))
    assert found is None or found.kind != "node.counts_elsewhere"


def behind_lines(symptom: str, numbers: list[int], text: str) -> RecognisedMistake | None:
    """Return the mistake behind a symptom of a node that logs these numbers."""
    lines = tuple(f"Hello time: {number}" for number in numbers)
    return behind_symptom(symptom, Suspect(node_in(text), ASSIGNMENT, lines=lines))


@pytest.mark.parametrize(
    ("rows", "numbers", "kind"),
    [
        ("self.counter_ = (self.counter_ + 1) % 2", [0, 1, 0, 1], "node.counter_reset"),
        ("self.counter_ += 2 if self.counter_ % 2 else 1", [0, 1, 3, 5], ""),
        ("self.counter_ += 1\n        if self.counter_ % 2 == 0:\n            self.counter_ += 1",
         [0, 1, 3, 5], ""),
        ("self.counter_ += 2\n        if self.counter_ % 3 == 0:\n            self.counter_ -= 1",
         [0, 2, 4, 5], ""),
    ],
)  # fmt: skip
def test_a_rest_that_is_only_asked_for_does_not_reset_the_counter(
    rows: str, numbers: list[int], kind: str
) -> None:
    found = behind_lines("run.wrong_step", numbers, changed(RIGHT, (STEP, f"        {rows}\n")))
    assert found is None or found.kind not in {"node.counter_reset", "node.adds_twice"} - {kind}
    assert not kind or (found is not None and found.kind == kind)


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


@pytest.mark.parametrize(
    "rows",
    [
        "if self.counter_ > 0:\n            self.counter_ += 1\n        else:\n            self.counter_ = 0",
        "if self.counter_ < 1:\n            self.counter_ = 0\n        else:\n            self.counter_ += 1",
        "if self.on:\n            self.counter_ += 1\n        if self.off:\n            self.counter_ = 0",
    ],
)
def test_a_reset_in_another_branch_than_the_sum_is_not_said_to_be_in_each_call(rows: str) -> None:
    found = look("run.constant_counter", changed(RIGHT, (STEP, f"        {rows}\n")))
    assert found is None or found.kind != "node.counter_reset"


@pytest.mark.parametrize(
    ("shown", "step", "part", "is_cause"),
    [
        ("str(self.counter_)", "self.counter_ += self.step", "self.counter_ +=", True),
        ("str(self.counter_)", "self.counter_ = 1 + self.counter_", "self.counter_ = 1", True),
        ("self.counter_ + str(0) + self.number", "self.number += 1", "info(", False),
        ("'v' + self.counter_ + self.number", "self.number += 1", "info(", False),
    ],
)
def test_a_start_in_quotes_is_only_told_where_it_is_added(
    shown: str, step: str, part: str, is_cause: bool
) -> None:
    text = changed(
        RIGHT,
        (START, "        self.counter_ = '2'\n        self.number = 0\n"),
        ("str(self.counter_)", shown),
        (STEP, f"        {step}\n"),
    )
    error = 'TypeError: can only concatenate str (not "int") to str'
    assert (kind_at(error, text, part) == "node.start_is_text") is is_cause


@pytest.mark.parametrize(("value", "again"), [("0", True), ("1", True), ("10", False)])
def test_a_jump_to_another_number_is_not_a_new_start(value: str, again: bool) -> None:
    row = f"        if self.counter_ == 4:\n            self.counter_ = {value}\n"
    numbers = [0, 1, 2, 3, int(value), int(value) + 1]
    found = behind_lines("run.wrong_step", numbers, changed(RIGHT, (STEP, STEP + row)))
    assert (found is not None and found.variant == "if") is again
