"""Diagnoses of a counter: each statement is true of the program."""

from __future__ import annotations

import re

import pytest

from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.report.model import Where
from tests.marking import ASSIGNMENT
from tests.mistakes.other_forms import LOG, RIGHT, START, STEP, TIMER, changed
from tests.mistakes.test_from_source import FILE, line_of, look, node_in, raised
from tests.mistakes.test_spun_and_ended import texts

INT_AND_STR = "TypeError: unsupported operand type(s) for +=: 'int' and 'str'"


def kind_at(error: str, text: str, part: str) -> str:
    """Return the kind behind an error of the line that has this part."""
    found = raised(error, text, line_of(text, part))
    return "" if found is None else found.kind


def test_the_number_in_quotes_is_that_of_the_line_and_not_of_another_one() -> None:
    rows = "        word = 'a'\n        word += '5'\n        self.counter_ += '1'\n"
    text = changed(RIGHT, (STEP, rows))
    found = raised(INT_AND_STR, text, line_of(text, "self.counter_ +="))
    assert found is not None
    assert found.kind == "node.step_is_text"
    assert "self.counter_ += 1" in texts(found)[1]


@pytest.mark.parametrize("added", ["' seconds'", "step"])
def test_what_is_no_number_in_quotes_is_not_told_to_lose_its_quotes(added: str) -> None:
    rows = f"        word = 'a'\n        word += '5'\n        step = '1'\n        self.counter_ += {added}\n"
    text = changed(RIGHT, (STEP, rows))
    assert kind_at(INT_AND_STR, text, "self.counter_ +=") != "node.step_is_text"


@pytest.mark.parametrize(
    ("kind", "value"),
    [
        ("list", "[self.counter_]"),
        ("method", "self.get_name"),
        ("Time", "self.get_clock().now()"),
        ("bytes", "str(self.counter_).encode()"),
        ("int", "self.counter_"),
    ],
)
def test_only_a_number_is_told_to_be_made_a_string_of(kind: str, value: str) -> None:
    text = changed(RIGHT, ("str(self.counter_)", value))
    error = f'TypeError: can only concatenate str (not "{kind}") to str'
    is_number = kind == "int"
    assert (kind_at(error, text, "info(") == "node.str_plus_int") is is_number
    seen = CATALOGUE["node.str_plus_int"].seen
    assert (re.search(seen, error) is not None) is is_number


UNBOUND = (
    "UnboundLocalError: cannot access local variable '{}' where it is not associated with a value"
)
SUM = "def add_up(numbers):\n    for one in numbers:\n        total += one\n    return total\n\n\nclass MyFirst"


@pytest.mark.parametrize(
    ("edit", "part", "name", "written"),
    [
        ((LOG, f"text += 'Hello time: ' + str(self.counter_)\n        {LOG}"), "text +=", "text", "text = ''"),
        ((LOG, f"text = text + f'{{self.counter_}}'\n        {LOG}"), "text =", "text", "text = ''"),
        ((STEP, "        for n in self.get_all():\n            n_ += n['step']\n"), "n_ +=", "n_", "n_ = 0"),
        (("class MyFirst", SUM), "total +=", "total", "total = 0"),
    ],
)  # fmt: skip
def test_a_text_or_a_sum_that_a_call_builds_is_not_told_to_outlast_the_call(
    edit: tuple[str, str], part: str, name: str, written: str
) -> None:
    text = changed(RIGHT, edit)
    found = raised(UNBOUND.format(name), text, line_of(text, part))
    assert found is not None
    assert (found.kind, found.variant) == ("node.variable_not_set", "added_to")
    assert f"Write {written} on" in texts(found)[1]


@pytest.mark.parametrize("step", ["counter_ += 1", "counter_ = counter_ + self.step"])
def test_a_counter_without_self_is_told(step: str) -> None:
    text = changed(RIGHT, (STEP, f"        {step}\n"))
    assert kind_at(UNBOUND.format("counter_"), text, step) == "node.counter_local"


def method(name: str, *rows: str) -> tuple[str, str]:
    """Return the edit that writes a method above the callback."""
    body = "".join(f"        {row}\n" for row in rows)
    return "    def timer_callback", f"    def {name}:\n{body}\n    def timer_callback"


COUNT = method("count(self)", "self.counter_ += 1")
OTHER_TIMER = (TIMER, f"self.create_timer(1.0, self.count)\n        {TIMER}")


@pytest.mark.parametrize(
    ("edits", "why", "fix"),
    [
        ([COUNT], "No line calls count", "self.count()"),
        ([method("count(self, n)", "self.counter_ += n")], "No line calls count", "Move the +="),
        ([method("count(self)", "self.counter_ += 1", "self.x = 1")], "No line calls", "Move the +="),
        ([COUNT, OTHER_TIMER], "a timer of its own", "Then delete count"),
        ([method("count(self)", "self.counter_ += 1", "self.x = 1"), OTHER_TIMER], "of its own", "Move"),
        ([COUNT, (TIMER, f"Thread(target=self.count).start()\n        {TIMER}")], "other times", "Move"),
    ],
)  # fmt: skip
def test_where_else_the_counter_is_increased_is_told_as_it_is(
    edits: list[tuple[str, str]], why: str, fix: str
) -> None:
    found = look("run.constant_counter", changed(RIGHT, (STEP, ""), *edits))
    assert found is not None
    assert found.kind == "node.counts_elsewhere"
    reason, change = texts(found)
    assert why in reason
    assert fix in change


@pytest.mark.parametrize("symptom", ["run.wrong_step", "run.wrong_start", "run.constant_counter"])
def test_a_method_that_nothing_calls_does_not_count_beside_the_callback(symptom: str) -> None:
    for step in ("self.counter_ += 2", "self.more()"):
        more = method("more(self)", "self.counter_ += 2")
        text = changed(RIGHT, (STEP, f"        {step}\n"), COUNT, more)
        found = look(symptom, text)
        assert found is None or found.kind != "node.counts_elsewhere"


def test_a_method_that_never_runs_does_not_change_the_first_number() -> None:
    found = look("run.wrong_start", changed(RIGHT, (STEP, ""), COUNT))
    assert found is None or found.kind != "node.counts_elsewhere"


def behind_lines(symptom: str, numbers: list[int], text: str) -> RecognisedMistake | None:
    """Return the mistake behind a symptom of a node that logs these numbers."""
    lines = tuple(f"Hello time: {number}" for number in numbers)
    return behind_symptom(symptom, Suspect(node_in(text), ASSIGNMENT, lines=lines))


def test_a_step_that_grows_is_not_another_addition_to_the_counter() -> None:
    rows = "        self.counter_ += self.step\n        self.step += 1\n"
    text = changed(RIGHT, (STEP, rows), (START, f"{START}        self.step = 1\n"))
    found = behind_lines("run.wrong_step", [0, 1, 3, 6], text)
    assert found is not None
    assert found.kind == "node.other_step"
    assert "self.counter_ += self.step" in texts(found)[1]


@pytest.mark.parametrize(
    ("rows", "numbers", "kind"),
    [
        ("self.counter_ = (self.counter_ + 1) % 2", [0, 1, 0, 1], "node.counter_reset"),
        ("self.counter_ += 2 if self.counter_ % 2 else 1", [0, 1, 3, 5], ""),
        ("self.counter_ += 1\n        if self.counter_ % 2 == 0:\n            self.counter_ += 1",
         [0, 1, 3, 5], "node.adds_twice"),
        ("self.counter_ += 2\n        if self.counter_ % 3 == 0:\n            self.counter_ -= 1",
         [0, 2, 4, 5], ""),
    ],
)  # fmt: skip
def test_a_rest_that_is_only_asked_for_does_not_reset_the_counter(
    rows: str, numbers: list[int], kind: str
) -> None:
    found = behind_lines("run.wrong_step", numbers, changed(RIGHT, (STEP, f"        {rows}\n")))
    assert found is None or found.kind not in {"node.counter_reset", "node.adds_twice"} - {kind}
    assert not kind or (found is not None and found.kind == kind)


@pytest.mark.parametrize(
    ("given", "is_bare"),
    [
        ("self.timer_callback", True),
        ("callback=self.timer_callback", True),
        ("partial(self.timer_callback, 0)", False),
        ("functools.partial(self.timer_callback, number=self.counter_)", False),
        ("lambda: self.timer_callback(self.counter_)", False),
    ],
)
def test_a_callback_that_gets_a_value_does_not_begin_with_its_default(
    given: str, is_bare: bool
) -> None:
    text = changed(
        RIGHT,
        ("(1.0, self.timer_callback)", f"(1.0, {given})"),
        ("timer_callback(self)", "timer_callback(self, number=0)"),
        ("str(self.counter_)", "str(number)"),
        (STEP, "        number += 1\n"),
    )
    found = look("run.constant_counter", text)
    assert (found is not None and found.kind == "node.counts_in_variable") is is_bare


@pytest.mark.parametrize("test", ["not rclpy.init()", "rclpy.init() is None", "rclpy.init() != 0"])
def test_a_condition_that_is_met_ends_main_and_does_not_hide_its_block(test: str) -> None:
    assert _kind_of_tested(test, "return") == "node.init_tested"
    assert _kind_of_tested(test, "print('ok')") != "node.init_tested"


@pytest.mark.parametrize("test", ["rclpy.init()", "rclpy.init() is not None", "rclpy.init() == 0"])
def test_a_condition_that_is_not_met_hides_its_block_and_does_not_end_main(test: str) -> None:
    assert _kind_of_tested(test, "print('ok')") == "node.init_tested"
    assert _kind_of_tested(test, "return") != "node.init_tested"


def _kind_of_tested(test: str, then: str) -> str:
    text = changed(RIGHT, ("    rclpy.init(args=args)\n", f"    if {test}:\n        {then}\n"))
    found = look("run.exits_at_once", text)
    return "" if found is None else found.kind


@pytest.mark.parametrize(
    ("first", "step", "reads"),
    [
        ("'0'", "self.counter_ = str(self.counter_ + 1)", True),
        ("0", "self.counter_ = str(self.counter_ + 1)", True),
        ("'Hello time: '", "self.counter_ = str(self.counter_ + 1)", False),
        ("'Hello time: '", "self.counter_ += 1", False),
        ("f'Hello time: '", "self.counter_ += 1", False),
        ("str(self.get_name())", "self.counter_ += 1", False),
        ("self.first_text()", "self.counter_ = self.counter_ + 1", False),
        ("input()", "self.counter_ = self.counter_ + 1", False),
    ],
)
def test_int_is_only_told_for_a_text_of_digits(first: str, step: str, reads: bool) -> None:
    start = f"        self.counter_ = {first}\n"
    text = changed(RIGHT, (START, start), ("self.counter_ += 1", step))
    error = 'TypeError: can only concatenate str (not "int") to str'
    found = raised(error, text, line_of(text, step))
    assert (found is not None and found.variant == "kept_text") is reads
    assert reads or found is None or found.kind != "node.str_plus_int"


SEVERITY = "ValueError: {} is not a valid LoggingSeverity"


@pytest.mark.parametrize(
    ("given", "swapped"),
    [
        ("LoggingSeverity.INFO, 'text'", True),
        ("20, 'text'", True),
        ("'text', 'INFO'", False),
        ("'text', 1", False),
        ("'INFO', 'text'", False),
        ("str(self.counter_), self.counter_", False),
    ],
)
def test_only_a_severity_before_the_text_is_told_to_be_put_behind_it(
    given: str, swapped: bool
) -> None:
    text = changed(RIGHT, (LOG, f"self.get_logger().log({given})"))
    kind = kind_at(SEVERITY.format("'text'"), text, ".log(")
    assert (kind == "node.log_order") is swapped


def test_a_method_that_a_dict_does_not_have_is_no_entry() -> None:
    rows = "        self.seen = {}\n        self.seen.last = 0\n"
    call = "        self.seen.append(self.counter_)\n"
    text = changed(RIGHT, (START, START + rows), (STEP, call + STEP))
    error = "AttributeError: 'dict' object has no attribute '{}'"
    assert kind_at(error.format("append"), text, "append") != "node.dict_attribute"
    found = raised(error.format("last"), text, line_of(text, "seen.last"))
    assert found is not None
    assert found.kind == "node.dict_attribute"
    assert "append" not in texts(found)[1]


@pytest.mark.parametrize(("given", "sure"), [("{'n': 1}", True), ("{**data, 'n': 1}", False)])
def test_a_key_is_not_told_to_be_renamed_where_others_are_not_known(given: str, sure: bool) -> None:
    text = changed(RIGHT, (LOG, f"self.get_logger().info('Hello time: %(count)d' % {given})"))
    found = raised("KeyError: 'count'", text, line_of(text, "info("))
    assert (found is not None and found.variant == "key") is sure


@pytest.mark.parametrize(
    "rows",
    [
        "if self.counter_ > 0:\n            self.counter_ += 1\n        else:\n            self.counter_ = 0",
        "if self.counter_ < 1:\n            self.counter_ = 0\n        else:\n            self.counter_ += 1",
        "if self.on:\n            self.counter_ += 1\n        if self.off:\n            self.counter_ = 0",
    ],
)
def test_a_reset_in_another_branch_than_the_sum_is_not_said_to_be_in_each_call(rows: str) -> None:
    found = look("run.constant_counter", changed(RIGHT, (STEP, f"        {rows}\n")))
    assert found is None or found.kind != "node.counter_reset"


@pytest.mark.parametrize(
    "rows",
    [
        "self.counter_ += 1\n        if self.counter_ > 0:\n            self.counter_ = 0",
        "if self.counter_ >= 0:\n            self.counter_ += 1\n            self.counter_ = 0",
    ],
)
def test_a_reset_that_runs_when_the_sum_has_run_is_told(rows: str) -> None:
    found = look("run.constant_counter", changed(RIGHT, (STEP, f"        {rows}\n")))
    assert found is not None
    assert found.kind == "node.counter_reset"


NO_ITERATOR = "TypeError: '{}' object is not an iterator"
YIELDS = method("numbers(self)", "n = 0", "while True:", "    yield n", "    n += 1")


@pytest.mark.parametrize(
    ("kind", "edits", "fix"),
    [
        ("int", [("str(self.counter_)", "str(next(self.counter_))")],
         "Write self.counter_ instead of next(self.counter_)"),
        ("int", [("str(self.counter_)", "str(next(self.counter_))"), (STEP, "")], ""),
        ("NoneType", [("str(self.counter_)", "str(next(self.numbers))")], ""),
        ("method", [("str(self.counter_)", "str(next(self.numbers))"), YIELDS],
         "write self.numbers_ = self.numbers() in __init__"),
        ("method", [("str(self.counter_)", "str(next(self.numbers))"),
                    method("numbers(self)", "return self.counter_")], ""),
    ],
)  # fmt: skip
def test_iter_is_not_told_for_what_has_no_items(
    kind: str, edits: list[tuple[str, str]], fix: str
) -> None:
    text = changed(RIGHT, *edits)
    found = raised(NO_ITERATOR.format(kind), text, line_of(text, "info("))
    assert (found is not None and found.kind == "node.not_an_iterator") is bool(fix)
    assert fix in (texts(found)[1] if fix else "")


@pytest.mark.parametrize(
    ("given", "written"),
    [
        ("'text', 'INFO'", ".info('text')"),
        ("'warn', 'text'", ".warn('text')"),
        ("'text', 'LOUD'", ""),
        ("'text', 1", ""),
    ],
)
def test_a_level_in_quotes_is_told_to_be_the_method(given: str, written: str) -> None:
    text = changed(RIGHT, (LOG, f"self.get_logger().log({given})"))
    found = raised(SEVERITY.format("'text'"), text, line_of(text, ".log("))
    assert (found is not None and found.kind == "node.log_severity") is bool(written)
    assert written in (texts(found)[1] if written else "")


JOIN = "'Hello time: '.join(str(self.counter_))"


@pytest.mark.parametrize(
    ("line", "edit", "is_cause"),
    [
        ("0", (LOG, f"self.get_logger().info({JOIN})"), True),
        ("0", (LOG, f"text = {JOIN}\n        self.get_logger().info(text)"), True),
        ("Hello Time: 0", (LOG, "self.get_logger().info('Hello Time: ' + ''.join(str(self.counter_)))"), False),
        ("Hello Time: 0", (LOG, f"{LOG.replace('time', 'Time')}\n        self.last = '-'.join(str(12))"), False),
    ],
)  # fmt: skip
def test_only_a_join_in_the_logged_text_changes_it(
    line: str, edit: tuple[str, str], is_cause: bool
) -> None:
    text = changed(RIGHT, edit)
    place = Where(file=FILE, line=line_of(text, "().info("))
    suspect = Suspect(node_in(text), ASSIGNMENT, text=line, lines=(line,), place=place)
    found = behind_symptom("run.wrong_text", suspect)
    assert (found is not None and found.kind == "node.text_joined") is is_cause


@pytest.mark.parametrize(
    ("shown", "step", "part", "is_cause"),
    [
        ("str(self.counter_)", "self.counter_ += self.step", "self.counter_ +=", True),
        ("str(self.counter_)", "self.counter_ = 1 + self.counter_", "self.counter_ = 1", True),
        ("self.counter_ + str(0) + self.number", "self.number += 1", "info(", False),
        ("'v' + self.counter_ + self.number", "self.number += 1", "info(", False),
    ],
)
def test_a_start_in_quotes_is_only_told_where_it_is_added(
    shown: str, step: str, part: str, is_cause: bool
) -> None:
    text = changed(
        RIGHT,
        (START, "        self.counter_ = '2'\n        self.number = 0\n"),
        ("str(self.counter_)", shown),
        (STEP, f"        {step}\n"),
    )
    error = 'TypeError: can only concatenate str (not "int") to str'
    assert (kind_at(error, text, part) == "node.start_is_text") is is_cause


@pytest.mark.parametrize(("value", "again"), [("0", True), ("1", True), ("10", False)])
def test_a_jump_to_another_number_is_not_a_new_start(value: str, again: bool) -> None:
    row = f"        if self.counter_ == 4:\n            self.counter_ = {value}\n"
    found = look("run.wrong_step", changed(RIGHT, (STEP, STEP + row)))
    assert (found is not None and found.variant == "if") is again
