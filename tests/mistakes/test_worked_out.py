"""The one change that gives the required lines is named with its line, and the fix makes it."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.source.counter import wrapped_at
from grader.package.source.one_change import SORTS, changes, logged_lines, wanted_lines
from tests.marking import ASSIGNMENT
from tests.mistakes.test_from_source import OTHERWISE, RIGHT, line_of, node_in
from tests.mistakes.test_named_exactly import LOG, STEP, changed, fix_of, patched

START = "        self.counter_ = 0\n"
TEXT = "'Hello time: ' + str(self.counter_)"
CALLBACK = "    def timer_callback"
PROPERTY = """\
    @property
    def text(self) -> str:
        return f'Hello time: {self.counter_}'

"""
BASE = """\
class Talking(Node):
    def say(self, *words):
        self.get_logger().info(' '.join(str(word) for word in words))


class MyFirstNode(Talking)"""
SAY = "        self.say('Hello', 'time:', self.counter_)\n"
LINE = f"        {LOG}\n"
SAYS = (("class MyFirstNode(Node)", BASE), (LINE, SAY))
SHOWN = ((CALLBACK, PROPERTY + CALLBACK), (TEXT, "self.text"))
HELPER = """\
    def siguiente(self):
        self.counter_ += 1
        return self.counter_

"""
ITERATED = (
    (
        "        self.create_timer(1.0, self.timer_callback)\n",
        "        numbers = count()\n"
        "        log = self.get_logger()\n"
        "        self.create_timer(1.0, lambda: log.info(f'Hello time: {next(numbers)}'))\n",
    ),
    (START, ""),
    (LOG, "pass"),
    (STEP, ""),
    ("import rclpy\n", "from itertools import count\n\nimport rclpy\n"),
)
JOINED = "    def make(self, n):\n        return ' '.join(['Hello time: ', str(n)])\n\n"


def other(text: str, *edits: tuple[str, str]) -> str:
    for old, new in edits:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


def found_in(symptom: str, text: str) -> RecognisedMistake | None:
    source = node_in(text)
    lines = tuple(logged_lines(source) or ())
    return behind_symptom(
        symptom, Suspect(source, ASSIGNMENT, lines[0] if lines else "", None, lines)
    )


CASES = [
    ("run.wrong_start", changed(*SHOWN, ("        return f'H", f"{STEP}        return f'H")),
     "node.adds_twice", "self.counter_ += 1", "Delete line"),
    ("run.wrong_step", changed(*SHOWN, (STEP, STEP * 2)),
     "node.adds_twice", "self.counter_ += 1", "Delete line"),
    ("run.wrong_start", changed(*SHOWN, (STEP, "")).replace(
        "        self.get_logger().info(self.text)\n",
        f"{STEP}        self.get_logger().info(self.text)\n"),
     "node.adds_before_log", "self.counter_ += 1", "Move this line (self.counter_ += 1) below"),
    ("run.wrong_start", other(changed(*SAYS), (f"{SAY}{STEP}", f"{STEP}{SAY}")),
     "node.adds_before_log", "self.counter_ += 1", "Move this line (self.counter_ += 1) below"),
    ("run.twice", other(changed(*SAYS), (SAY, SAY * 2)),
     "node.logs_twice", SAY.strip(), "Delete line"),
    ("run.wrong_start", changed((STEP, ""), (CALLBACK, HELPER + CALLBACK),
                                (TEXT, "f'Hello time: {self.siguiente()}'")),
     "node.adds_before_log", "self.counter_ += 1",
     "number = self.counter_; self.counter_ += 1; return number"),
    ("run.wrong_step", changed((STEP, "        self.counter_ = (self.counter_ + 1) % 5\n")),
     "node.counter_reset", "% 5",
     "Write self.counter_ + 1 instead of (self.counter_ + 1) % 5."),
    ("run.wrong_step", changed((STEP, f"{STEP}        self.counter_ %= 5\n")),
     "node.counter_reset", "%= 5", "Delete this line"),
    ("run.constant_counter", changed((STEP, "        self.counter_ += 0\n")),
     "node.other_step", "+= 0", "Write self.counter_ += 1 instead of self.counter_ += 0."),
    ("run.wrong_start", changed((START, START.replace("0", "-1"))),
     "node.starts_elsewhere", "= -1", "self.counter_ = 0"),
    ("run.wrong_start", changed((START, START.replace(" = 0", ": int = 1")), *SHOWN),
     "node.starts_elsewhere", ": int = 1", "Write self.counter_: int = 0"),
    ("run.wrong_start", other(RIGHT, (START, "        self.state = {'n': 1}\n"),
                              ("str(self.counter_)", "str(self.state['n'])"),
                              ("self.counter_ += 1", "self.state['n'] += 1")),
     "node.starts_elsewhere", "{'n': 1}", "Write self.state = {'n': 0}"),
    ("run.wrong_start", other(changed(*ITERATED), ("= count()", "= count(1)")),
     "node.starts_elsewhere", "count(1)", "Write count(0) instead of count(1)."),
    ("run.wrong_step", other(changed(*ITERATED), ("= count()", "= count(step=2)")),
     "node.other_step", "count(step=2)", "Write count(step=1) instead of count(step=2)."),
    ("run.wrong_start", changed((TEXT, "f'Hello time: {self.counter_ + 1}'")),
     "node.number_changed", "{self.counter_ + 1}", "Write self.counter_ instead of"),
    ("run.wrong_text", changed(("str(self.counter_)", "repr(str(self.counter_))")),
     "node.as_code", "repr(", "Write str(self.counter_) instead of repr(str(self.counter_))."),
    ("run.wrong_text", changed((TEXT, "f'Hello time: {str(self.counter_)!r}'")),
     "node.as_code", "!r", "Write {str(self.counter_)} instead of"),
    ("run.wrong_text", changed((TEXT, "f'Hello time: {self.counter_=}'")),
     "node.as_code", "=}", "Write {self.counter_} instead of {self.counter_=}."),
    ("run.wrong_text", changed((CALLBACK, JOINED + CALLBACK), (TEXT, "self.make(self.counter_)")),
     "node.text_elsewhere", "' '.join", "Write 'Hello time:' instead of 'Hello time: '."),
    ("run.wrong_text", changed((TEXT, "'Hello Time: %i' % self.counter_")),
     "node.text_elsewhere", "Hello Time", "Write 'Hello time: %i' instead of"),
    ("run.wrong_text", changed((TEXT, "f'Hello time: {self.counter_}\\n'")),
     "node.line_end_in_text", "\\n'", "Write f'Hello time: {self.counter_}' instead of"),
    ("run.wrong_text", changed((TEXT, f"({TEXT}).upper()")),
     "node.text_changed", ".upper()", f"Write ({TEXT}) instead of"),
    ("run.wrong_step", changed((LINE, f"        if self.counter_ % 2 == 0:\n    {LINE}")),
     "node.log_if", "% 2", "Remove this if"),
]  # fmt: skip


@pytest.mark.parametrize(("symptom", "text", "kind", "line", "fix"), CASES)
def test_the_piece_to_change_is_named_and_changed(
    symptom: str, text: str, kind: str, line: str, fix: str, tmp_path: Path
) -> None:
    found = found_in(symptom, text)
    assert found is not None
    assert found.kind == kind
    assert found.where is not None
    assert line in text.splitlines()[(found.where.line or 0) - 1]
    assert fix in fix_of(found)
    new = patched(found, text, tmp_path)
    assert logged_lines(node_in(new)) == [f"Hello time: {n}" for n in range(12)]


@pytest.mark.parametrize(
    "text", [RIGHT, OTHERWISE, changed(*SHOWN), changed(*SAYS), changed(*ITERATED)]
)
def test_a_right_node_has_nothing_to_change(text: str) -> None:
    output = ASSIGNMENT.output
    wanted = wanted_lines(output.line, output.start, output.step)
    assert logged_lines(node_in(text)) == wanted.lines
    assert changes(node_in(text), wanted, *SORTS) == []


def test_nothing_is_worked_out_of_lines_that_came_otherwise() -> None:
    text = changed(*SHOWN, (STEP, STEP * 2))
    suspect = Suspect(node_in(text), ASSIGNMENT, "", None, ("Hello time: 0", "Hello time: 3"))
    assert behind_symptom("run.wrong_step", suspect) is None


@pytest.mark.parametrize(
    "body",
    [
        "self.timer_callback()",
        "while True:\n            pass",
        "self.counter_ = 10 ** 10 ** 10",
        "self.counter_ = [0] * 10 ** 9",
        "self.counter_ = f'{self.counter_:999999999}'",
        "self.counter_ = '%999999999d' % 1",
        "self.counter_ = '{:>{}}'.format(1, 999999999)",
        "self.counter_ = 'x'.ljust(999999999)",
        "self.counter_ = [self.counter_, self.counter_]",
        "import os",
    ],
)
def test_code_that_cannot_be_worked_out_takes_no_time(body: str) -> None:
    lines = logged_lines(node_in(changed((STEP, f"        {body}\n"))))
    assert lines is None or len(lines) <= 12


@pytest.mark.parametrize(
    ("text", "line", "number"),
    [
        (changed(("str(self.counter_)", "str(self.counter_ % 60)")), "% 60", 60),
        (
            changed(
                (STEP, f"{STEP}        if self.counter_ >= 100:\n            self.counter_ = 0\n")
            ),
            "    self.counter_ = 0",
            100,
        ),
    ],
)
def test_what_begins_again_later_is_found(text: str, line: str, number: int) -> None:
    found = wrapped_at(node_in(text))
    assert found is not None
    assert line in text.splitlines()[found[0].lineno - 1]
    assert found[1] == number


@pytest.mark.parametrize(
    ("symptom", "old", "new", "kind", "fix"),
    [
        ("run.no_lines", "log.info", "log.debug", "node.debug_level", "Write log.info instead of"),
        ("run.wrong_text", "info(f'", "info('", "node.f_prefix", "f'Hello time: {next(numbers)}'"),
        ("run.print_not_logger", "log.info(", "print(", "node.print_used",
         "Write log.info(f'Hello time: {next(numbers)}') instead of"),
    ],
)  # fmt: skip
def test_a_call_in_a_lambda_is_known(
    symptom: str, old: str, new: str, kind: str, fix: str, tmp_path: Path
) -> None:
    text = other(changed(*ITERATED), (old, new))
    found = found_in(symptom, text)
    assert found is not None
    assert found.kind == kind
    assert fix in fix_of(found)
    assert patched(found, text, tmp_path) == changed(*ITERATED)


@pytest.mark.parametrize(
    ("symptom", "written", "kind", "new"),
    [
        ("run.print_not_logger", "print('Hello time:', self.counter_, flush=True)",
         "node.print_used", "self.get_logger().info(f'Hello time: {self.counter_}')"),
        ("run.print_not_logger", f"sys.stdout.write({TEXT} + '\\n')",
         "node.written_without_logger", f"self.get_logger().info({TEXT})"),
        ("run.faked_log", "print(f'[INFO] [{now()}] [my_first_node]: Hello time: {self.counter_}')",
         "node.written_without_logger", "self.get_logger().info(f'Hello time: {self.counter_}')"),
    ],
)  # fmt: skip
def test_a_printed_line_is_written_as_a_call_of_the_logger(
    symptom: str, written: str, kind: str, new: str, tmp_path: Path
) -> None:
    text = changed((LOG, written))
    found = found_in(symptom, text)
    assert found is not None
    assert found.kind == kind
    assert line_of(text, written) == (found.where.line if found.where else None)
    assert f"Write {new} instead of" in fix_of(found)
    assert patched(found, text, tmp_path) == changed((LOG, new))


def test_a_walrus_is_no_form_of_a_number() -> None:
    text = changed((TEXT, "f'Hello time: {(n := self.counter_ + 1)}'"))
    found = found_in("run.wrong_start", text)
    assert found is None or found.kind != "node.number_format"
