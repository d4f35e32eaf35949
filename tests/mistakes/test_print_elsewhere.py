"""A print() for the logger, in a method of the node and in a function that has no self of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.mistakes.test_from_source import look
from tests.mistakes.test_named_exactly import LOG, changed, fix_of, patched

TEXT = "'Hello time: ' + str(self.counter_)"
CLASS = "class MyFirstNode"


@pytest.mark.parametrize(
    ("printed", "logged"),
    [
        (f"print({TEXT})", TEXT),
        ("print('Hello time:', self.counter_, flush=True)", "f'Hello time: {self.counter_}'"),
    ],
)
def test_a_printed_line_is_written_as_a_call_of_the_logger(
    printed: str, logged: str, tmp_path: Path
) -> None:
    text = changed((LOG, printed))
    found = look("run.print_not_logger", text)
    new = f"self.get_logger().info({logged})"
    assert fix_of(found) == f"Write {new} instead of {printed}."
    assert patched(found, text, tmp_path) == changed((LOG, new))


def test_a_function_that_only_prints_has_no_logger_of_its_own() -> None:
    helper = "def print_line(text):\n    print(text)\n"
    text = changed((CLASS, f"{helper}\n\n{CLASS}"), (LOG, f"print_line({TEXT})"))
    fix = fix_of(look("run.print_not_logger", text))
    assert fix.startswith("In print_line, self is not the node. Give it the node's logger")
