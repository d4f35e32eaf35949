"""A number is added to what is text already, or to the text of a number."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.mistakes.test_from_source import line_of, raised
from tests.mistakes.test_named_exactly import changed, fix_of, patched, why_of

ERROR = 'TypeError: can only concatenate str (not "int") to str'
WRITTEN = "'Hello time: ' + str(self.counter_)"


@pytest.mark.parametrize(
    ("logged", "right", "late"),
    [
        ("'Hello time: %d' % self.counter_ + 1", "'Hello time: %d' % (self.counter_ + 1)", True),
        ("'Hello time: ' + str(self.counter_) + 1", "'Hello time: ' + str(self.counter_ + 1)", True),
        ("'Hello time: {}'.format(self.counter_) + 1",
         "'Hello time: {}'.format(self.counter_ + 1)", True),
        ("'Hello time: ' + self.counter_ + 1", "'Hello time: ' + str(self.counter_ + 1)", False),
        ("'Hello time: ' + self.counter_", "'Hello time: ' + str(self.counter_)", False),
    ],
)  # fmt: skip
def test_the_numbers_are_added_before_they_become_text(
    logged: str, right: str, late: bool, tmp_path: Path
) -> None:
    text = changed((WRITTEN, logged))
    found = raised(ERROR, text, line=line_of(text, "info("))
    assert found is not None
    assert found.kind == "node.str_plus_int"
    assert ("string first" in why_of(found)) == late
    assert f"Write {found.params['written']} instead of {found.params['name']}" in fix_of(found)
    assert patched(found, text, tmp_path) == changed((WRITTEN, right))


@pytest.mark.parametrize(
    "logged",
    ["'Hello time: %d %d' % (self.counter_, 2) + 1", "self.text('Hello time: ') + 1"],
)
def test_what_the_number_belongs_to_is_not_guessed(logged: str) -> None:
    text = changed((WRITTEN, logged))
    found = raised(ERROR, text, line=line_of(text, "info("))
    assert found is not None
    assert "string first" not in why_of(found)
