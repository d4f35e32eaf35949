"""A text that is made in steps: what is told is true of the line, and the fix leads to the right one."""

from __future__ import annotations

from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.report.model import Where
from tests.marking import ASSIGNMENT
from tests.mistakes.test_from_source import FILE, line_of, look, node_in
from tests.mistakes.test_named_exactly import LOG, STEP, changed, fix_of

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
    for_format = changed((TEXT, "'Hello time: {n}'"))
    found = behind(for_format, "Hello time: {n}")
    assert fix_of(found).startswith("Write .format(n=self.counter_) after the string, or")


def test_a_text_with_two_places_is_no_text_without_its_value() -> None:
    text = changed((TEXT, "'Hello time: %s {}'.format(self.counter_)"))
    assert behind(text, "Hello time: %s 0") is None


def test_no_counter_is_named_that_the_node_does_not_have() -> None:
    text = changed((TEXT, "'Hello time: '"), (START, "pass"), (STEP, ""))
    assert "self." not in fix_of(behind(text, "Hello time: "))


TEMPLATE = ("import rclpy\nfrom", "from string import Template\n\nimport rclpy\nfrom")


def test_a_string_of_which_nothing_is_in_the_line_is_not_the_wrong_one() -> None:
    text = changed(
        TEMPLATE,
        (CLASS, f"MESSAGE = Template('Hello time: $count')\n\n\n{CLASS}"),
        (TEXT, "MESSAGE.safe_substitute(self.values())"),
    )
    found = behind(text, "Hello time: $count")
    assert found is None or found.kind != "node.text_elsewhere"


def test_a_text_that_is_set_anew_in_the_callback_does_not_grow() -> None:
    text = changed((LOG, f"text = 'Hello'\n        text += ' Time: '\n        {LOG}"))
    found = behind(text.replace(TEXT, "text + str(self.counter_)"), "Hello Time: 0")
    assert found is None or found.kind != "node.text_grows"


def test_a_throttle_shorter_than_the_period_leaves_out_no_line() -> None:
    text = changed((TEXT, f"{TEXT}, throttle_duration_sec=0.5"))
    found = look("run.wrong_step", text)
    assert found is None or found.kind != "node.log_option"


def test_a_print_beside_the_logger_is_deleted_and_not_replaced() -> None:
    text = changed((LOG, f"print({TEXT})\n        {LOG}"))
    for symptom in ("run.twice", "run.print_not_logger"):
        found = look(symptom, text)
        assert fix_of(found) == "Delete this print(…): the logger logs the same text."
        assert found is not None
        assert found.where == Where(file=FILE, line=line_of(text, "print("))


def test_a_row_behind_a_line_end_of_a_logged_text_is_not_printed() -> None:
    text = changed(("'Hello time: '", "'\\nHello time: '"))
    found = look("run.print_not_logger", text)
    assert fix_of(found) == "Write 'Hello time: ' instead of '\\nHello time: '."
    assert look("run.print_not_logger", text.replace(LOG.split("(")[0], "print")) != found
