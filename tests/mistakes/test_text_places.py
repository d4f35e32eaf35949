"""A text that is made in steps: what is told is true of the line, and the fix leads to the right one."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.source.one_change import logged_lines
from grader.report.model import Where
from tests.marking import ASSIGNMENT
from tests.mistakes.test_from_source import FILE, line_of, look, node_in, raised
from tests.mistakes.test_named_exactly import LOG, STEP, changed, fix_of, patched, why_of

TEXT = "'Hello time: ' + str(self.counter_)"
CALLBACK = "    def timer_callback"
CLASS = "class MyFirstNode"
START = "self.counter_ = 0"
WANTED = [f"Hello time: {n}" for n in range(3)]


def behind(text: str, came: str, at: str = ".info(") -> RecognisedMistake | None:
    place = Where(file=FILE, line=line_of(text, at))
    return behind_symptom("run.wrong_text", Suspect(node_in(text), ASSIGNMENT, came, place))


def kept(value: str, given: str = "TEXT") -> str:
    """Return the node with its text in a constant."""
    return changed((CLASS, f"TEXT = {value}\n\n\n{CLASS}"), (TEXT, given))


@pytest.mark.parametrize(
    ("text", "came", "fix"),
    [
        (kept("'Hello time: %d'"), "Hello time: %d", "Write TEXT % self.counter_ instead of TEXT."),
        (kept("'Hello time: {}'"), "Hello time: {}",
         "Write TEXT.format(self.counter_) instead of TEXT."),
        (kept("'Hello time: %d'", "TEXT.format(self.counter_)"), "Hello time: %d",
         "Write TEXT % self.counter_ instead of TEXT.format(self.counter_)."),
        (changed((TEXT, "'Hello time: {n}'.replace('{count}', str(self.counter_))")),
         "Hello time: {n}", "Write '{n}' instead of '{count}'."),
    ],
    ids=["percent", "braces", "format of percent", "replace"],
)  # fmt: skip
def test_a_value_gets_into_a_text_that_is_kept_elsewhere(
    text: str, came: str, fix: str, tmp_path: Path
) -> None:
    found = behind(text, came)
    assert fix_of(found) == fix
    lines = logged_lines(node_in(patched(found, text, tmp_path)))
    assert lines is not None
    assert lines[:3] == WANTED


def test_an_f_is_not_written_where_its_values_are_unknown(tmp_path: Path) -> None:
    text = kept("'Hello time: {self.counter_}'")
    found = behind(text, "Hello time: {self.counter_}")
    assert fix_of(found).startswith("Write f'Hello time: {self.counter_}' instead of TEXT in this")
    assert "info(f'Hello time: {self.counter_}')" in patched(found, text, tmp_path)
    for_format = changed((TEXT, "'Hello time: {n}'"))
    found = behind(for_format, "Hello time: {n}")
    assert fix_of(found).startswith("Write .format(n=self.counter_) after the string, or")


def test_a_text_with_two_places_is_no_text_without_its_value() -> None:
    text = changed((TEXT, "'Hello time: %s {}'.format(self.counter_)"))
    assert behind(text, "Hello time: %s 0") is None


def test_the_counter_is_not_asked_for_where_it_is() -> None:
    text = changed((TEXT, "('Hello time: ' + str(self.counter_))[:12]"))
    found = behind(text, "Hello time: ")
    assert found is not None
    assert found.variant == "lost"
    assert why_of(found).startswith(f"Line {line_of(text, '[:12]')} uses the counter")


def test_no_counter_is_named_that_the_node_does_not_have() -> None:
    text = changed((TEXT, "'Hello time: '"), (START, "pass"), (STEP, ""))
    assert "self." not in fix_of(behind(text, "Hello time: "))


TEMPLATE = ("import rclpy\nfrom", "from string import Template\n\nimport rclpy\nfrom")


def test_a_template_takes_the_name_of_its_place(tmp_path: Path) -> None:
    for method in ("safe_substitute", "substitute"):
        text = changed(
            TEMPLATE, (TEXT, f"Template('Hello time: $count').{method}(counter=self.counter_)")
        )
        found = behind(text, "Hello time: $count")
        if method == "substitute":
            found = raised("KeyError: 'count'", text, line_of(text, "substitute"))
        assert fix_of(found).startswith(
            "Write count=self.counter_ instead of counter=self.counter_"
        )
        assert patched(found, text, tmp_path) == text.replace("(counter=", "(count=")


def test_a_string_of_which_nothing_is_in_the_line_is_not_the_wrong_one() -> None:
    text = changed(
        TEMPLATE,
        (CLASS, f"MESSAGE = Template('Hello time: $count')\n\n\n{CLASS}"),
        (TEXT, "MESSAGE.safe_substitute(self.values())"),
    )
    found = behind(text, "Hello time: $count")
    assert found is None or found.kind != "node.text_elsewhere"


TICKS = """\
class Ticks:
    def __init__(self):
        self.value = 0

    def {name}(self):
        return str(self.value)


class MyFirstNode"""
ADDRESS = "Hello time: <my_robot_controller.my_first_node.Ticks object at 0x7fe7aff952d0>"


@pytest.mark.parametrize(
    ("name", "fix"),
    [
        ("toString", "Write __str__ instead of toString: Python does not know toString."),
        ("as_text", "Log a value of the object, not the object itself"),
    ],
)
def test_an_object_in_the_text_needs_str(name: str, fix: str, tmp_path: Path) -> None:
    text = changed((CLASS, TICKS.format(name=name)), (START, "self.counter_ = Ticks()"))
    found = behind(text, ADDRESS)
    assert fix_of(found).startswith(fix)
    right = text.replace("toString", "__str__") if name == "toString" else ""
    assert patched(found, text, tmp_path) == right


@pytest.mark.parametrize(
    ("came", "variant"),
    [
        ("Hello time: <bound method MyFirstNode.number of <a.b object at 0x7f>>", "called"),
        ("Hello time: <generator object MyFirstNode.number at 0x7f>", "of_python"),
        ("Hello time: b'0'", "bytes"),
        ("Hello time: count(0)", "count"),
    ],
)
def test_what_python_shows_of_other_things_is_told(came: str, variant: str) -> None:
    method = "    def number(self):\n        return self.counter_\n\n"
    text = changed((CALLBACK, method + CALLBACK), (TEXT, "f'Hello time: {self.number}'"))
    found = behind(text, came)
    assert found is not None
    assert (found.kind, found.variant) == ("node.object_in_text", variant)


def test_a_text_that_is_set_anew_in_the_callback_does_not_grow() -> None:
    text = changed((LOG, f"text = 'Hello'\n        text += ' Time: '\n        {LOG}"))
    found = behind(text.replace(TEXT, "text + str(self.counter_)"), "Hello Time: 0")
    assert found is None or found.kind != "node.text_grows"


def test_a_text_that_has_the_lines_before_it_is_kept() -> None:
    found = behind(changed(), "Hello time: 0 Hello time: 1")
    assert found is not None
    assert found.kind == "node.text_kept"


OPTIONS = f"OPTIONS = {{'throttle_duration_sec': 2.0}}\n\n\n{CLASS}"
SAY = "    def say(self, text, **given):\n        self.get_logger().info(text, **given)\n\n"


@pytest.mark.parametrize(
    ("text", "fix"),
    [
        (changed((CLASS, OPTIONS), (TEXT, f"{TEXT}, **OPTIONS")), "**OPTIONS"),
        (changed((START, f"{START}\n        self.how = dict(throttle_duration_sec=3)"),
                 (TEXT, f"{TEXT}, **self.how")), "**self.how"),
        (changed((CALLBACK, SAY + CALLBACK),
                 (LOG, f"self.say({TEXT}, throttle_duration_sec=5)")), "throttle_duration_sec=…"),
    ],
    ids=["constant", "attribute", "method"],
)  # fmt: skip
def test_an_option_of_the_logger_is_found_where_it_is_kept(
    text: str, fix: str, tmp_path: Path
) -> None:
    found = look("run.wrong_step", text)
    assert fix_of(found) == f"Remove {fix} from the call in this line."
    assert found == look("run.wrong_period", text)
    lines = logged_lines(node_in(patched(found, text, tmp_path).replace(", **given", "")))
    assert lines is not None
    assert lines[:3] == WANTED


def test_a_throttle_shorter_than_the_period_leaves_out_no_line() -> None:
    text = changed((TEXT, f"{TEXT}, throttle_duration_sec=0.5"))
    found = look("run.wrong_step", text)
    assert found is None or found.kind != "node.log_option"


@pytest.mark.parametrize(
    ("written", "logged"),
    [
        (f"RCLCPP_INFO(self.get_logger(), {TEXT})", TEXT),
        ("System.out.println('Hello time: ' + self.counter_)", TEXT),
        ("printf(f'Hello time: {self.counter_}')", "f'Hello time: {self.counter_}'"),
    ],
)
def test_the_whole_call_of_another_language_is_written_for_the_logger(
    written: str, logged: str, tmp_path: Path
) -> None:
    text = changed((LOG, written))
    name = written.partition("(")[0].partition(".")[0]
    found = raised(f"NameError: name '{name}' is not defined", text, line_of(text, written))
    assert fix_of(found) == f"Write self.get_logger().info({logged}) instead of {written}."
    assert patched(found, text, tmp_path) == text.replace(
        written, f"self.get_logger().info({logged})"
    )


def test_a_digit_of_c_becomes_str(tmp_path: Path) -> None:
    text = changed(("str(self.counter_)", "chr(ord('0') + self.counter_)"))
    lines = tuple(logged_lines(node_in(text)) or ())
    assert lines[10] == "Hello time: :"
    suspect = Suspect(node_in(text), ASSIGNMENT, lines[10], None, lines[:10])
    found = behind_symptom("run.wrong_text", suspect)
    assert fix_of(found) == "Write str(self.counter_) instead of chr(ord('0') + self.counter_)."
    assert patched(found, text, tmp_path) == changed()


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
