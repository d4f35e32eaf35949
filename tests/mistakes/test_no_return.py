"""A function that returns nothing is named, with the return to write."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.source.one_change import logged_lines
from tests.marking import ASSIGNMENT
from tests.mistakes.test_from_source import line_of, node_in, raised
from tests.mistakes.test_named_exactly import LOG, STEP, changed, fix_of, patched, why_of

TEXT = "'Hello time: ' + str(self.counter_)"
CALLBACK = "    def timer_callback"
CLASS = "class MyFirstNode(Node)"
HELPER = (STEP, "        self.counter_ = add_one(self.counter_)\n")


def found_in(text: str, came: str) -> RecognisedMistake | None:
    return behind_symptom("run.wrong_text", Suspect(node_in(text), ASSIGNMENT, came))


def helper(*lines: str) -> str:
    return changed((CLASS, "\n    ".join(["def add_one(x):", *lines]) + f"\n\n\n{CLASS}"), HELPER)


def method(*lines: str) -> str:
    body = "\n        ".join(["    def text(self):", *lines])
    return changed((f"info({TEXT})", "info(str(self.text()))"), (CALLBACK, f"{body}\n\n{CALLBACK}"))


@pytest.mark.parametrize(
    ("text", "came", "said"),
    [
        (helper("y = x + 1"), "Hello time: None", "Write return y below this line"),
        (helper("x += 1"), "Hello time: None", "Write return x below this line"),
        (helper("x + 1"), "Hello time: None", "Write return x + 1 instead of x + 1."),
        (helper("y = x + 1", "return"), "Hello time: None", "Write return y instead of return."),
        (helper("print(x + 1)"), "Hello time: None", "Write return x + 1 instead of print(x + 1)."),
        (helper("return print(x + 1)"), "Hello time: None",
         "Write return x + 1 instead of return print(x + 1)."),
        (method(f"text = {TEXT}"), "None", "Write return text below this line"),
        (method(TEXT), "None", f"Write return {TEXT} instead of {TEXT}."),
        (method("'Hello time: %d' % self.counter_"), "None", "Write return 'Hello time: %d' %"),
        (method("'Hello time: {}'.format(self.counter_)"), "None", "Write return 'Hello time: {}'"),
        (method(f"self.get_logger().info({TEXT})"), "None", f"Write return {TEXT} instead of self."),
        (changed((LOG, "show = lambda n: print(f'Hello time: {n}')\n"
                       "        self.get_logger().info(str(show(self.counter_)))")),
         "None", "Write f'Hello time: {n}' instead of print(f'Hello time: {n}')."),
    ],
)  # fmt: skip
def test_the_return_to_write_is_said(text: str, came: str, said: str, tmp_path: Path) -> None:
    found = found_in(text, came)
    assert found is not None
    assert found.kind == "node.nothing_returned"
    assert said in fix_of(found)
    new = patched(found, text, tmp_path)
    if "show" not in text:
        assert logged_lines(node_in(new)) == [f"Hello time: {n}" for n in range(12)]
    else:
        assert said.split()[1] in new


def test_a_return_under_a_condition_is_not_enough() -> None:
    text = helper("if x < 0:", "    return x + 1")
    found = found_in(text, "Hello time: None")
    assert f"only if the condition in line {line_of(text, 'if x <')} is true" in why_of(found)
    assert "Add a return with a value as the last line of add_one" in fix_of(found)


def test_the_error_that_follows_is_explained_by_it() -> None:
    text = helper("y = x + 1")
    error = "TypeError: unsupported operand type(s) for +: 'NoneType' and 'int'"
    found = raised(error, text, line_of(text, "y = x + 1"))
    assert fix_of(found).startswith("Write return y below this line")


def test_a_text_that_is_printed_for_the_logger_is_to_be_returned() -> None:
    text = method(f"print({TEXT})")
    found = behind_symptom("run.print_not_logger", Suspect(node_in(text), ASSIGNMENT))
    assert fix_of(found) == f"Write return {TEXT} instead of print({TEXT})."


@pytest.mark.parametrize(
    ("text", "came"),
    [
        (helper("return x + 1"), "Hello time: None"),
        (helper("y = x + 1"), "Hello time: 0!"),
        (helper("raise ValueError"), "Hello time: None"),
        (helper("yield x"), "Hello time: None"),
        (helper("if x:", "    return x + 1", "else:", "    return 1"), "Hello time: None"),
        (changed((CLASS, f"@cache\ndef add_one(x):\n    y = x\n\n\n{CLASS}"), HELPER), "None"),
        (changed((STEP, "        self.grow()\n"),
                 (CALLBACK, f"    def grow(self):\n{STEP}\n{CALLBACK}")), "Hello time: None"),
    ],
)  # fmt: skip
def test_nothing_is_said_of_other_functions(text: str, came: str) -> None:
    found = found_in(text, came)
    assert found is None or found.kind != "node.nothing_returned"
