"""A counter that is something else than a plain number is named, with its line."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import RecognisedMistake, Suspect
from tests.marking import ASSIGNMENT
from tests.mistakes.test_from_source import line_of, node_in
from tests.mistakes.test_named_exactly import STEP, changed, fix_of, patched, why_of

START = "self.counter_ = 0"
SHOWN = "str(self.counter_)"


def found_in(text: str, came: str) -> RecognisedMistake | None:
    return behind_symptom("run.wrong_text", Suspect(node_in(text), ASSIGNMENT, came))


@pytest.mark.parametrize(
    ("value", "came", "what"),
    [
        ("np.zeros(1)", "[0.]", "an array of numpy"),
        ("numpy.array([0])", "[0]", "an array of numpy"),
        ("0j", "0j", "a complex number"),
        ("complex(0)", "0j", "a complex number"),
        ("timedelta(0)", "0:00:00", "a time"),
        ("Decimal('0.0')", "0.0", "a number with its own form"),
    ],
)
def test_what_the_counter_is_is_said(value: str, came: str, what: str, tmp_path: Path) -> None:
    text = changed((START, f"self.counter_ = {value}"))
    found = found_in(text, f"Hello time: {came}")
    line = line_of(text, f"= {value}")
    assert f"self.counter_ is {what}, made in line {line}." in why_of(found)
    assert fix_of(found) == f"Write self.counter_ = 0 instead of self.counter_ = {value}."
    assert patched(found, text, tmp_path) == changed()


@pytest.mark.parametrize(
    ("value", "came", "step"),
    [
        ("(0,)", "(0,)", "self.counter_ = (self.counter_[0] + 1,)"),
        ("{'n': 0}", "{'n': 0}", "self.counter_['n'] += 1"),
        ("set()", "set()", "self.counter_.add(1)"),
        ("np.zeros(1)", "[0.]", "self.counter_[0] += 1"),
    ],
)
def test_what_changes_it_is_named_too(value: str, came: str, step: str) -> None:
    text = changed((START, f"self.counter_ = {value}"), (STEP, f"        {step}\n"))
    found = found_in(text, f"Hello time: {came}")
    assert f"self.counter_ += 1 instead of what changes it (line {line_of(text, step)})." in (
        fix_of(found)
    )
    assert "Write self.counter_ = 0 instead of" in fix_of(found)


def test_an_element_is_written_as_an_integer(tmp_path: Path) -> None:
    text = changed(
        (START, "self.counter_ = np.zeros(1)"),
        (SHOWN, "str(self.counter_[0])"),
        (STEP, "        self.counter_[0] += 1\n"),
    )
    found = found_in(text, "Hello time: 0.0")
    assert fix_of(found) == "Write int(self.counter_[0]) instead of self.counter_[0]."
    assert "str(int(self.counter_[0]))" in patched(found, text, tmp_path)


@pytest.mark.parametrize(
    ("value", "came"),
    [("np.zeros(1)", "0"), ("0", "[0]"), ("Counter()", "[0.]"), ("0.0", "0.0")],
)
def test_nothing_is_said_of_other_texts(value: str, came: str) -> None:
    text = changed((START, f"self.counter_ = {value}"))
    found = found_in(text, f"Hello time: {came}")
    assert found is None or found.kind != "node.counter_other_value"
