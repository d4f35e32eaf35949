"""Numbers that are taken by next(), parts of join(), defaults of parameters, and other names and keys."""

from __future__ import annotations

import ast

import pytest

from grader.mistakes.made_by import lines_that_make
from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import Suspect
from grader.package.source.played import played
from tests.marking import ASSIGNMENT
from tests.mistakes.test_from_source import line_of, look, node_in, raised
from tests.mistakes.test_named_exactly import LOG, STEP, changed, fix_of
from tests.mistakes.test_worked_out import found_in

START = "        self.counter_ = 0\n"
TEXT = "'Hello time: ' + str(self.counter_)"
CLASS = "class MyFirstNode"
IMPORT = "import rclpy\n"
ITERATOR = (
    (IMPORT, "import itertools\n\nimport rclpy\n"),
    (TEXT, "f'Hello time: {next(self.numbers)}'"),
    (STEP, ""),
)
TRIED = "        self.numbers = itertools.count()\n        first = next(self.numbers)\n"
POINT = "from collections import namedtuple\n\nimport rclpy\n"


def logged(text: str, ticks: int = 3) -> list[str] | None:
    found = played(ast.parse(text), "main", ticks)
    return [line.text for line in found] if found is not None else None


def test_a_number_that_is_looked_at_is_taken() -> None:
    check = f"{TRIED}        if first != 0:\n            raise ValueError\n"
    text = changed((START, check), *ITERATOR)
    found = found_in("run.wrong_start", text)
    assert found is not None
    assert found.kind == "node.number_taken"
    line = line_of(text, "first = next")
    assert f"(lines {line}-{line + 2})" in fix_of(found)


def test_a_number_that_is_used_elsewhere_is_not_told_to_be_deleted() -> None:
    kept = TRIED.replace("first =", "self.first =")
    shown = (
        "    def timer_callback",
        "    def again(self):\n        return self.first\n\n    def timer_callback",
    )
    found = found_in("run.wrong_start", changed((START, kept), shown, *ITERATOR))
    assert found is None or found.kind != "node.number_taken"


def test_the_line_that_takes_a_number_is_one_of_those_that_make_it() -> None:
    text = changed((START, TRIED), *ITERATOR)
    assert "first = next(self.numbers)" in str(lines_that_make(node_in(text), None))


def test_the_call_that_gives_a_parameter_its_value_is_one_of_them() -> None:
    helper = "    def show(self, n=0):\n        self.get_logger().info(f'Hello time: {n}')\n\n"
    text = changed(
        ("    def timer_callback", f"{helper}    def timer_callback"), (LOG, "self.show()")
    )
    made = str(lines_that_make(node_in(text), None))
    assert "self.show()" in made
    assert "def show(self, n=0):" in made
    assert fix_of(found_in("run.constant_counter", text)).endswith(
        "write self.show(self.counter_) instead of self.show()."
    )


@pytest.mark.parametrize("made", ["namedtuple('S', ['n'])", "namedtuple('S', 'n')"])
def test_a_named_tuple_does_not_change(made: str) -> None:
    text = changed(
        (IMPORT, POINT),
        (CLASS, f"S = {made}\n\n\n{CLASS}"),
        (START, "        self.s = S(n=0)\n"),
        (TEXT, "'Hello time: ' + str(self.s.n)"),
        (STEP, "        self.s._replace(n=self.s.n + 1)\n"),
    )
    assert fix_of(found_in("run.constant_counter", text)) == (
        "Write self.s = self.s._replace(n=self.s.n + 1) instead of self.s._replace(n=self.s.n + 1)."
    )


def test_a_result_of_replace_is_kept_where_the_lines_are_not_known() -> None:
    text = changed(
        (START, "        self.s = read_state()\n"),
        (TEXT, "'Hello time: ' + str(self.s.n)"),
        (STEP, "        self.s._replace(n=self.s.n + 1)\n"),
    )
    found = look("run.constant_counter", text)
    assert found is not None
    assert found.kind == "node.result_dropped"


@pytest.mark.parametrize(
    ("text", "fix"),
    [
        (
            "' '.join(['Hello', 'time', ':', str(self.counter_)])",
            "Write 'time:' instead of 'time', ':'.",
        ),
        (
            "''.join(('Hello time:', str(self.counter_)))",
            "Write 'Hello time: ' instead of 'Hello time:'.",
        ),
        (
            "':'.join(map(str, ['Hello time', self.counter_]))",
            "Write ': ' instead of ':'.",
        ),
        (
            "'Hello' 'time: ' + str(self.counter_)",
            "Write 'Hello time: ' instead of 'Hello' 'time: '.",
        ),
    ],
)
def test_the_parts_of_a_text_are_put_together(text: str, fix: str) -> None:
    assert fix_of(found_in("run.wrong_text", changed((TEXT, text)))) == fix


def test_a_default_begins_anew_in_each_call() -> None:
    text = changed(
        (CLASS, f"def counted(n=0):\n    now = n\n    n = n + 1\n    return now\n\n\n{CLASS}"),
        (START, ""),
        (TEXT, "'Hello time: %s' % counted()"),
        (STEP, ""),
    )
    found = found_in("run.constant_counter", text)
    assert found is not None
    assert found.kind == "node.default_counts"
    for part in ("self.counter = 0", "self.counter instead of counted()", "self.counter += 1"):
        assert part in fix_of(found)


def test_a_list_as_default_is_made_only_once() -> None:
    text = changed(
        (CLASS, f"def counted(n=[0]):\n    n[0] += 1\n    return n[0] - 1\n\n\n{CLASS}"),
        (TEXT, "'Hello time: %s' % counted()"),
        (STEP, ""),
    )
    assert logged(text) == ["Hello time: 0", "Hello time: 1", "Hello time: 2"]


def test_what_counts_is_shown_and_not_the_period() -> None:
    text = changed(
        (START, f"{START}        self.period = 1.0\n"), (TEXT, "f'Hello time: {self.period}'")
    )
    found = found_in("run.wrong_text", text)
    assert fix_of(found) == "Write self.counter_ instead of self.period."


def test_a_name_that_does_not_count_is_not_told_to_count() -> None:
    text = changed(
        (START, f"{START}        self.count = 0\n"), (TEXT, "f'Hello time: {self.count}'")
    )
    assert fix_of(found_in("run.constant_counter", text)) == (
        "Write self.counter_ instead of self.count."
    )


def test_both_keys_are_one() -> None:
    text = changed(
        (START, "        self.d = {}\n"),
        (LOG, "n = self.d.get('n', 0)\n        self.get_logger().info(f'Hello time: {n}')"),
        (STEP, "        self.d['N'] = n + 1\n"),
    )
    assert fix_of(found_in("run.constant_counter", text)) == "Write 'n' instead of 'N'."


@pytest.mark.parametrize("part", ["[0]", "[-1]", "[:1]"])
def test_a_number_has_more_than_one_digit(part: str) -> None:
    found = found_in("run.wrong_step", changed(("str(self.counter_)", f"str(self.counter_){part}")))
    assert fix_of(found) == f"Write str(self.counter_) instead of str(self.counter_){part}."


GENERATOR = "    def numbers(self):\n        n = 0\n        while True:\n"
COUNT_FIRST = f"{GENERATOR}            n += 1\n            yield n\n\n"
COUNT_LAST = f"{GENERATOR}            yield n\n            n += 1\n\n"


def of_generator(generator: str, start: str, text: str) -> str:
    callback = "    def timer_callback"
    return changed((callback, generator + callback), (START, start), (TEXT, text), (STEP, ""))


def test_a_generator_yields_before_it_counts() -> None:
    text = of_generator(
        COUNT_FIRST, "        self.n = self.numbers()\n", "f'Hello time: {next(self.n)}'"
    )
    found = found_in("run.wrong_start", text)
    assert found is not None
    assert found.variant == "yields"
    assert f"below line {line_of(text, 'yield n')}" in fix_of(found)


def test_a_generator_is_made_once() -> None:
    found = found_in(
        "run.constant_counter",
        of_generator(COUNT_LAST, "", "f'Hello time: {next(self.numbers())}'"),
    )
    assert found is not None
    assert found.kind == "node.made_anew"
    assert "self.numbers_ = self.numbers()" in fix_of(found)


def test_sum_adds_no_texts() -> None:
    text = changed((TEXT, "sum(['Hello time: ', str(self.counter_)])"))
    error = "TypeError: unsupported operand type(s) for +: 'int' and 'str'"
    found = raised(error, text, line_of(text, "sum("))
    assert found is not None
    assert found.variant == "summed"
    assert "str(sum" not in fix_of(found)


@pytest.mark.parametrize(
    ("text", "value", "variant"),
    [
        ("FORM % {'count': self.counter_}", "'Hello time: %(n)d'", "one_key"),
        ("FORM % vars(self)", "'Hello time: %(n)d'", "mapping"),
        ("FORM.format_map(vars(self))", "'Hello time: {n}'", "mapping"),
    ],
)
def test_the_values_of_a_text_lack_the_name(text: str, value: str, variant: str) -> None:
    text = changed((CLASS, f"FORM = {value}\n\n\n{CLASS}"), (TEXT, text))
    found = raised("KeyError: 'n'", text, line_of(text, "get_logger()"))
    assert found is not None
    assert found.kind == "node.format_value_missing"
    assert found.variant == variant


def test_a_second_value_of_next_is_no_error() -> None:
    text = changed(
        (START, "        self.n = iter([0, 1, 2])\n"),
        (TEXT, "f'Hello time: {next(self.n, None)}'"),
        (STEP, ""),
    )
    assert look("run.ended_early", text) is None
    suspect = Suspect(node_in(text), ASSIGNMENT, "Hello time: None")
    found = behind_symptom("run.wrong_text", suspect)
    assert found is not None
    assert found.variant == "default"


def test_the_logger_is_no_function() -> None:
    text = changed((LOG, f"self.get_logger()({TEXT})"))
    found = raised(
        "TypeError: 'RcutilsLogger' object is not callable", text, line_of(text, "get_logger")
    )
    assert fix_of(found) == "Write self.get_logger().info(…) instead of self.get_logger()(…)."


def test_each_string_needs_its_own_f() -> None:
    text = changed(
        (
            LOG,
            "text = (f'Hello '\n                'time: {self.counter_}')\n        self.get_logger().info(text)",
        )
    )
    suspect = Suspect(node_in(text), ASSIGNMENT, "Hello time: {self.counter_}")
    found = behind_symptom("run.wrong_text", suspect)
    assert found is not None
    assert found.where is not None
    assert found.where.line == line_of(text, "'time: {")
    assert fix_of(found) == "Write f'time: {self.counter_}' instead of 'time: {self.counter_}'."


def test_a_counter_that_is_kept_as_text_is_made_a_number() -> None:
    text = changed(
        (START, "        self.counter_ = '0'\n"),
        (STEP, "        self.counter_ = str(self.counter_ + 1)\n"),
    )
    error = 'TypeError: can only concatenate str (not "int") to str'
    assert fix_of(raised(error, text, line_of(text, "str(self.counter_ + 1)"))).startswith(
        "Write int(self.counter_) + 1 instead of self.counter_ + 1:"
    )


def test_a_variable_that_a_method_declares_is_not_its_own() -> None:
    reset = "global counter\n        counter = 0\n        "
    text = changed(
        (CLASS, f"counter = 0\n\n\n{CLASS}"),
        (LOG, f"{reset}self.get_logger().info(f'Hello time: {{counter}}')"),
        (STEP, "        counter += 1\n"),
    )
    found = look("run.constant_counter", text)
    assert found is not None
    assert found.variant == "file_there"
    assert fix_of(found).startswith("Delete this line: line ")


def test_the_result_of_info_is_no_function() -> None:
    text = changed(
        (START, f"{START}        self.log_ = self.get_logger().info('start')\n"),
        (LOG, f"self.log_({TEXT})"),
    )
    found = raised(
        "TypeError: 'bool' object is not callable", text, line_of(text, "self.log_('Hello")
    )
    assert fix_of(found) == (
        "Write self.get_logger().info instead of self.get_logger().info('start')."
    )


@pytest.mark.parametrize(
    ("symptom", "text"),
    [
        ("run.wrong_text", "f'Hello time: {self.counter_} {self.counter_ + 1}'"),
        ("run.wrong_text", "f'Hello time: {self.counter_ / 1:.0f}s'"),
    ],
)
def test_a_line_of_other_parts_is_written_anew(symptom: str, text: str) -> None:
    fix = fix_of(found_in(symptom, changed((TEXT, text))))
    assert fix == f"Write f'Hello time: {{self.counter_}}' instead of {text}."


@pytest.mark.parametrize(
    ("start", "shown", "step", "fix"),
    [
        (
            "self.d = dict(n=1)",
            "'Hello time: {n}'.format(**self.d)",
            "self.d['n'] += 1",
            "self.d = dict(n=0)",
        ),
        (
            "self.declare_parameter('start', 1)\n        self.n = self.get_parameter('start').value",
            "'Hello time: ' + str(self.n)",
            "self.n += 1",
            "self.declare_parameter('start', 0)",
        ),
    ],
)
def test_a_first_value_is_found_where_it_is_written(
    start: str, shown: str, step: str, fix: str
) -> None:
    text = changed((START, f"        {start}\n"), (TEXT, shown), (STEP, f"        {step}\n"))
    assert fix_of(found_in("run.wrong_start", text)).startswith(f"Write {fix} instead of")


def test_the_item_of_a_default_is_returned_before_it_grows() -> None:
    text = changed(
        (CLASS, f"def counted(n=[0]):\n    n[0] += 1\n    return n[0]\n\n\n{CLASS}"),
        (TEXT, "'Hello time: %s' % counted()"),
        (STEP, ""),
    )
    assert "number = n[0]; n[0] += 1; return number" in fix_of(found_in("run.wrong_start", text))


def test_a_field_of_a_named_tuple_is_not_set() -> None:
    text = changed(
        (IMPORT, POINT),
        (CLASS, f"S = namedtuple('S', 'n')\n\n\n{CLASS}"),
        (START, "        self.s = S(0)\n"),
        (TEXT, "'Hello time: ' + str(self.s.n)"),
        (STEP, "        self.s.n += 1\n"),
    )
    found = raised("AttributeError: can't set attribute", text, line_of(text, "self.s.n += 1"))
    assert (
        fix_of(found) == "Write self.s = self.s._replace(n=self.s.n + 1) instead of self.s.n += 1."
    )


def test_a_first_value_that_a_helper_returns_is_found() -> None:
    helper = "    def first(self):\n        return 1\n\n    def timer_callback"
    text = changed((START, START.replace("0", "self.first()")), ("    def timer_callback", helper))
    assert fix_of(found_in("run.wrong_start", text)) == "Write return 0 instead of return 1."
