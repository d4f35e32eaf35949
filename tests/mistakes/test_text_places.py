"""A text that is made in steps: what is told is true of the line, and the fix leads to the right one."""

from __future__ import annotations

from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.report.model import Where
from tests.marking import ASSIGNMENT
from tests.mistakes.test_from_source import FILE, line_of, look, node_in
from tests.mistakes.test_named_exactly import LOG, changed, fix_of

TEXT = "'Hello time: ' + str(self.counter_)"
CALLBACK = "    def timer_callback"
CLASS = "class MyFirstNode"
START = "self.counter_ = 0"


def behind(text: str, came: str, at: str = ".info(") -> RecognisedMistake | None:
    place = Where(file=FILE, line=line_of(text, at))
    return behind_symptom("run.wrong_text", Suspect(node_in(text), ASSIGNMENT, came, place))


def kept(value: str, given: str = "TEXT") -> str:
    """Return the node with its text in a constant."""
    return changed((CLASS, f"TEXT = {value}\n\n\n{CLASS}"), (TEXT, given))


def test_an_f_is_not_written_where_its_values_are_unknown() -> None:
    text = kept("'Hello time: {self.counter_}'")
    found = behind(text, "Hello time: {self.counter_}")
    assert found is None or found.kind != "node.f_prefix"


def test_a_text_that_is_set_anew_in_the_callback_does_not_grow() -> None:
    text = changed((LOG, f"text = 'Hello'\n        text += ' Time: '\n        {LOG}"))
    found = behind(text.replace(TEXT, "text + str(self.counter_)"), "Hello Time: 0")
    assert found is None or found.kind != "node.text_grows"


def test_a_print_beside_the_logger_is_deleted_and_not_replaced() -> None:
    text = changed((LOG, f"print({TEXT})\n        {LOG}"))
    for symptom in ("run.print_not_logger",):
        found = look(symptom, text)
        assert fix_of(found) == "Delete this print(…): the logger logs the same text."
        assert found is not None
        assert found.where == Where(file=FILE, line=line_of(text, "print("))


def test_a_row_behind_a_line_end_of_a_logged_text_is_not_printed() -> None:
    text = changed(("'Hello time: '", "'\\nHello time: '"))
    found = look("run.print_not_logger", text)
    assert fix_of(found) == "Write 'Hello time: ' instead of '\\nHello time: '."
    assert look("run.print_not_logger", text.replace(LOG.split("(")[0], "print")) != found
