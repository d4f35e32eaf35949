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
        ("f'Hello time: {self.counter_ / 1}'", "0.0", "self.counter_ / 1", "self.counter_"),
        ("'Hello time: %03d' % self.counter_", "000", "%03d", "%d"),
        ("'Hello time: %3d' % (self.counter_,)", "  0", "%3d", "%d"),
        ("'Hello time: %.1f' % self.counter_", "0.0", "%.1f", "%d"),
        ("'Hello time: {:03}'.format(self.counter_)", "000", "{:03}", "{}"),
        ("'Hello time: {n:02d}'.format(n=self.counter_)", "00", "{n:02d}", "{n}"),
        ("'Hello time: ' + str(self.counter_).zfill(3)", "000", "str(self.counter_).zfill(3)",
         "str(self.counter_)"),
        ("'Hello time: ' + str(float(self.counter_))", "0.0", "float(self.counter_)",
         "self.counter_"),
        ("'Hello time: ' + hex(self.counter_)", "0x0", "hex(self.counter_)", "str(self.counter_)"),
        ("'Hello time: ' + format(self.counter_, '03d')", "000", "format(self.counter_, '03d')",
         "str(self.counter_)"),
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


def test_a_form_in_a_variable_is_found(tmp_path: Path) -> None:
    lines = "n = str(self.counter_).zfill(3)\n        text = 'Hello time: ' + n\n        "
    text = changed((LOG, f"{lines}self.get_logger().info(text)"))
    found = look(text, "Hello time: 000")
    assert found is not None
    assert found.where is not None
    assert found.where.line == line_of(text, "zfill")
    assert ".zfill" not in patched(found, text, tmp_path)


@pytest.mark.parametrize("start", ["0.0", "float(0)", "float()"])
def test_a_float_is_corrected_where_it_comes_from(start: str, tmp_path: Path) -> None:
    text = changed(("self.counter_ = 0", f"self.counter_ = {start}"))
    found = look(text, "Hello time: 0.0")
    assert found is not None
    assert found.where is not None
    assert found.where.line == line_of(text, start)
    assert fix_of(found) == f"Write self.counter_ = 0 instead of self.counter_ = {start}."
    assert patched(found, text, tmp_path) == changed()


def test_all_pieces_are_named_and_replaced_at_once(tmp_path: Path) -> None:
    text = changed(
        ("self.counter_ = 0", "self.counter_ = 0.0"),
        (WRITTEN, "f'Hello time: {self.counter_:.1f}'"),
        ("self.counter_ += 1", "self.counter_ = self.counter_ + 1.0"),
    )
    found = look(text, "Hello time: 0.0")
    start, step = line_of(text, "= 0.0"), line_of(text, "+ 1.0")
    assert fix_of(found) == (
        "Write {self.counter_} instead of {self.counter_:.1f}. Write also: self.counter_ = 0 "
        f"instead of self.counter_ = 0.0 (line {start}), self.counter_ = self.counter_ + 1 instead "
        f"of self.counter_ = self.counter_ + 1.0 (line {step})."
    )
    assert "decimal point" in why_of(found)
    new = patched(found, text, tmp_path)
    assert new == changed(
        (WRITTEN, "f'Hello time: {self.counter_}'"),
        ("self.counter_ += 1", "self.counter_ = self.counter_ + 1"),
    )


def test_a_count_that_seems_to_start_at_10_is_padded(tmp_path: Path) -> None:
    text = changed((WRITTEN, "'Hello time: ' + f'{self.counter_:>2}'"))
    found = behind_symptom("run.wrong_start", Suspect(node_in(text), ASSIGNMENT))
    assert fix_of(found) == "Write {self.counter_} instead of {self.counter_:>2}."
    late = text.replace("self.counter_ = 0", "self.counter_ = 10")
    found = behind_symptom("run.wrong_start", Suspect(node_in(late), ASSIGNMENT))
    assert found is None or found.kind != "node.number_format"


def test_a_form_of_another_value_is_not_named() -> None:
    other = "self.get_logger().debug(f'{time():.1f}')"
    text = changed((LOG, f"{other}\n        self.get_logger().info('Hello time:  ' + self.text())"))
    found = look(text, "Hello time:   0")
    assert found is None or found.kind != "node.number_format"
