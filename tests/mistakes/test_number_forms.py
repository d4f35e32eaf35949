"""What gives the counter another form is named, and the fix writes the plain integer."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import RecognisedMistake, Suspect
from tests.marking import ASSIGNMENT
from tests.mistakes.test_from_source import line_of, node_in
from tests.mistakes.test_named_exactly import changed, fix_of, patched, why_of

WRITTEN = "'Hello time: ' + str(self.counter_)"
LOG = f"self.get_logger().info({WRITTEN})"


def look(text: str, shown: str) -> RecognisedMistake | None:
    suspect = Suspect(node_in(text), ASSIGNMENT, text=shown)
    return behind_symptom("run.wrong_text", suspect)


@pytest.mark.parametrize(
    ("logged", "shown", "piece", "new"),
    [
        ("f'Hello time: {self.counter_:03d}'", "000", "{self.counter_:03d}", "{self.counter_}"),
        ("f'Hello time: {self.counter_:.1f}'", "0.0", "{self.counter_:.1f}", "{self.counter_}"),
        ("f'Hello time: {self.counter_:>3}'", "  0", "{self.counter_:>3}", "{self.counter_}"),
    ],
)  # fmt: skip
def test_the_piece_is_named_and_replaced(
    logged: str, shown: str, piece: str, new: str, tmp_path: Path
) -> None:
    text = changed((WRITTEN, logged))
    found = look(text, f"Hello time: {shown}")
    assert found is not None
    assert found.kind == "node.number_format"
    assert found.where is not None
    assert found.where.line == line_of(text, logged)
    assert fix_of(found) == f"Write {new} instead of {piece}."
    assert "sets the form" in why_of(found)
    assert patched(found, text, tmp_path) == changed((WRITTEN, logged.replace(piece, new)))


def test_a_float_is_corrected_where_it_comes_from(tmp_path: Path) -> None:
    text = changed(("self.counter_ = 0", "self.counter_ = 0.0"))
    found = look(text, "Hello time: 0.0")
    assert found is not None
    assert found.where is not None
    assert found.where.line == line_of(text, "0.0")
    assert fix_of(found) == "Write 0 instead of 0.0."
    assert patched(found, text, tmp_path) == changed()


def test_a_form_of_another_value_is_not_named() -> None:
    other = "self.get_logger().debug(f'{time():.1f}')"
    text = changed((LOG, f"{other}\n        self.get_logger().info('Hello time:  ' + self.text())"))
    found = look(text, "Hello time:   0")
    assert found is None or found.kind != "node.number_format"
