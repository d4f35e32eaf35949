"""A number is added to what is text already: str() around it is not told."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import line_of, raised
from tests.mistakes.test_named_exactly import changed

ERROR = 'TypeError: can only concatenate str (not "int") to str'
WRITTEN = "'Hello time: ' + str(self.counter_)"


@pytest.mark.parametrize(
    "logged",
    [
        "'Hello time: %d' % self.counter_ + 1",
        "'Hello time: ' + str(self.counter_) + 1",
        "'Hello time: {}'.format(self.counter_) + 1",
        "'Hello time: %d %d' % (self.counter_, 2) + 1",
    ],
)
def test_a_number_behind_a_text_is_not_made_a_text(logged: str) -> None:
    found = raised(ERROR, text := changed((WRITTEN, logged)), line=line_of(text, "info("))
    assert found is None or found.kind != "node.str_plus_int"
