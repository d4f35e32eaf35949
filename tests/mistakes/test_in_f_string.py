"""What is around the counter's name in an f-string is said as it is; lines without effect too."""

from __future__ import annotations

import pytest

from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import Suspect
from grader.package.source.counter import without_effect, wrapped_at
from grader.report.model import Where
from tests.marking import ASSIGNMENT
from tests.mistakes.test_from_source import FILE, line_of, node_in
from tests.mistakes.test_named_exactly import STEP, changed, fix_of, why_of

TEXT = "'Hello time: ' + str(self.counter_)"
WRAP = "        if self.counter_ > 5:\n            self.counter_ = 0\n"


@pytest.mark.parametrize(
    ("inside", "came", "why"),
    [
        ("(self.counter_)", "(self.counter_)", "A name without braces"),
        ("<self.counter_>", "<self.counter_>", "A name without braces"),
        ("self.counter_", "self.counter_", "A name without braces"),
        ("{{self.counter_}}", "{self.counter_}", "is one shown brace"),
    ],
)
def test_the_reason_is_about_what_is_there(inside: str, came: str, why: str) -> None:
    text = changed((TEXT, f"f'Hello time: {inside}'"), (STEP, f"{STEP}{WRAP}"))
    place = Where(file=FILE, line=line_of(text, "info("))
    suspect = Suspect(node_in(text), ASSIGNMENT, f"Hello time: {came}", place)
    found = behind_symptom("run.wrong_text", suspect)
    assert why in why_of(found)
    assert "{self.counter_}" in fix_of(found)


def test_a_count_that_begins_again_above_a_number_is_found() -> None:
    source = node_in(changed((STEP, f"{STEP}{WRAP}")))
    found = wrapped_at(source)
    assert found is not None
    assert found[1] == 6


@pytest.mark.parametrize("row", ["++self.counter_", "self.counter_ + 1", "+self.counter_"])
def test_a_line_without_effect_is_found(row: str) -> None:
    text = changed((STEP, f"        {row}\n"))
    found = without_effect(node_in(text))
    assert found is not None
    assert (found[0].lineno, found[1]) == (line_of(text, f"    {row}"), "self.counter_")


@pytest.mark.parametrize("row", ["self.counter_ += 1", "self.counter_", "pass", "print(1 + 1)"])
def test_other_lines_are_not_said_to_be_without_effect(row: str) -> None:
    assert without_effect(node_in(changed((STEP, f"        {row}\n")))) is None


@pytest.mark.parametrize(
    ("text", "line", "number"),
    [
        (changed(("str(self.counter_)", "str(self.counter_ % 60)")), "% 60", 60),
        (
            changed(
                (STEP, f"{STEP}        if self.counter_ >= 100:\n            self.counter_ = 0\n")
            ),
            "    self.counter_ = 0",
            100,
        ),
    ],
)
def test_what_begins_again_later_is_found(text: str, line: str, number: int) -> None:
    found = wrapped_at(node_in(text))
    assert found is not None
    assert line in text.splitlines()[found[0].lineno - 1]
    assert found[1] == number
