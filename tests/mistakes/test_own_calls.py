"""Exceptions at a call: of an own function or class, of the entry point, and inside of a library."""

from __future__ import annotations

import pytest

from grader.mistakes.recognised import RecognisedMistake
from tests.mistakes.test_from_source import line_of, raised
from tests.mistakes.test_named_exactly import changed, fix_of

START = "self.counter_ = 0"


def at(error: str, text: str, part: str, inside: str = "") -> RecognisedMistake:
    found = raised(error, text, line_of(text, part), inside)
    assert found is not None
    return found


def test_a_parameter_that_the_def_uses_is_not_told_to_be_removed() -> None:
    text = changed(
        (START, f"{START}\n        self.show()"),
        (
            "    def timer_callback",
            "    def show(self, text):\n        print(text)\n\n    def timer_callback",
        ),
    )
    error = "TypeError: MyFirstNode.show() missing 1 required positional argument: 'text'"
    assert "remove" not in fix_of(at(error, text, "self.show()")).lower()


@pytest.mark.parametrize(
    "error",
    [
        "TypeError: 'int' object is not iterable",
        "TypeError: 'NoneType' object is not subscriptable",
        "TypeError: '<' not supported between instances of 'str' and 'int'",
        "TypeError: cannot unpack non-iterable int object",
        "KeyError: 'x'",
        "IndexError: list index out of range",
    ],
)
def test_an_error_of_a_library_is_not_explained_by_the_line(error: str) -> None:
    text = changed((START, f"{START}\n        self.load('x')"))
    assert raised(error, text, line_of(text, "self.load"), "Python") is None


def test_a_text_before_percent_may_be_meant_as_a_number() -> None:
    text = changed((START, f"{START}\n        self.rest = self.given % 10"))
    error = "TypeError: not all arguments converted during string formatting"
    found = at(error, text, "self.given")
    assert "If the remainder is meant, the value before %" in fix_of(found)


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("open('notes/log.txt', 'w')", "Create the folder of 'notes/log.txt'"),
        ("open('notes/log.txt', mode='a')", "Create the folder of 'notes/log.txt'"),
        ("open('notes/log.txt', 'r')", "Write the values that the program takes from"),
    ],
)
def test_a_file_that_is_written_needs_its_folder(line: str, told: str) -> None:
    text = changed((START, f"self.counter_ = {line}"))
    error = "FileNotFoundError: [Errno 2] No such file or directory: 'notes/log.txt'"
    assert told in fix_of(at(error, text, "open("))


def test_a_program_that_cannot_be_started_is_no_file_to_be_read() -> None:
    text = changed((START, "subprocess.run(['rviz'])"))
    error = "FileNotFoundError: [Errno 2] No such file or directory: 'rviz'"
    assert raised(error, text, line_of(text, "subprocess.run")) is None
