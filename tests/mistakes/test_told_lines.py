"""The advice names the line to change and the code to write there, in other forms of a mistake."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.recognise import behind_error, behind_symptom
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.mistakes.tutorial import PUBLISHER
from grader.package.source.counter import wrapped_at
from grader.package.source.node import NodeSource, read_node
from grader.report.model import Where
from tests.corpus.broken import BROKEN
from tests.corpus.build import SOLUTION, write
from tests.marking import ASSIGNMENT
from tests.mistakes.other_forms import LOG, START, STEP, changed
from tests.recorded import mark
from tests.static_bench import NODE

RIGHT = (SOLUTION / NODE).read_text(encoding="utf-8")
BY_NAME = {package.name: package for package in BROKEN}
LOOP = f"""\
        rate = self.create_rate(1)
        while rclpy.ok():
            {LOG}
    {STEP}            rate.sleep()
"""


def source_of(text: str) -> NodeSource:
    source = read_node({NODE: text.encode()}.get, NODE, "main")
    assert source is not None
    return source


def behind(symptom: str, text: str) -> RecognisedMistake | None:
    return behind_symptom(symptom, Suspect(source_of(text), ASSIGNMENT, place=Where(file=NODE)))


def told(found: RecognisedMistake | None, text: str) -> tuple[str, str, str]:
    """Return the mistake's id, the line that is named, and the fix."""
    assert found is not None
    assert found.where is not None
    assert found.where.line is not None
    values = {**found.params, **found.words}
    fix = CATALOGUE[found.kind].fix_text(values, found.variant)
    return found.kind, text.split("\n")[found.where.line - 1].strip(), fix


@pytest.mark.parametrize(
    ("edits", "line"),
    [
        ([(START, f"{START}        self.log = self.get_logger\n"),
          ("self.get_logger().info", "self.log.info")], "self.log = self.get_logger"),
        ([(LOG, f"out = self.get_logger\n        {LOG.replace('self.get_logger()', 'out')}")],
         "out = self.get_logger"),
        ([(START, f"{START}        self.out: object = self.get_logger\n"),
          ("self.get_logger().info", "self.out.info")], "self.out: object = self.get_logger"),
    ],
    ids=["attribute", "variable", "with a type"],
)  # fmt: skip
def test_a_logger_that_is_kept_without_brackets(edits: list[tuple[str, str]], line: str) -> None:
    text = changed(RIGHT, *edits)
    used = next(n for n, row in enumerate(text.split("\n"), 1) if ".info(" in row)
    error = "AttributeError: 'function' object has no attribute 'info'"
    found = behind_error(Raised(error, Where(file=NODE, line=used), source_of(text), ASSIGNMENT))
    written = "Write self.get_logger() instead of self.get_logger."
    assert told(found, text) == ("node.not_called", line, written)


def test_a_rate_in_the_callback_of_a_timer_is_only_removed() -> None:
    text = changed(RIGHT, (f"        {LOG}\n{STEP}", LOOP))
    _, _, fix = told(behind("run.stops", text), text)
    assert fix.endswith("The timer already calls timer_callback in each period.")


@pytest.mark.parametrize(
    ("edits", "counter", "counts"),
    [
        ([(START, ""), (STEP, ""), (LOG, "now = time.ctime()\n        "
          "self.get_logger().info('Hello time: ' + now)")], "self.counter", False),
        ([(STEP, ""), (LOG, "now = time.ctime()\n        "
          "self.get_logger().info(f'Hello time: {now}')")], "self.counter_", False),
        ([("str(self.counter_)", "time.ctime()")], "self.counter_", True),
        ([(START, "        self.counter = time.time()\n"), (STEP, ""),
          (LOG, "now = time.time() - self.counter\n        "
           "self.get_logger().info('Hello time: ' + str(now))")], "self.counter_", False),
    ],
    ids=["no counter", "a counter that stays", "a counter that counts", "the name is taken"],
)  # fmt: skip
def test_the_whole_line_is_told_if_a_time_is_logged(
    edits: list[tuple[str, str]], counter: str, *, counts: bool
) -> None:
    text = changed(RIGHT, *edits)
    kind, _, fix = told(behind("run.wrong_text", text), text)
    row = next(n for n, row in enumerate(text.split("\n"), 1) if ".info(" in row)
    assert kind == "node.time_for_count"
    written = f"self.get_logger().info('Hello time: ' + str({counter}))"
    assert f"rite {written} in the place of the call that logs (line {row})" in fix
    assert (f"Write {counter} = 0 in __init__" not in fix) == counts
    assert (f"{counter} += 1" not in fix) == counts


@pytest.mark.parametrize("old", ["Hello World", "Publishing: ", "create_publisher"])
def test_a_tutorial_that_was_changed_to_the_exercise_is_not_called_one(old: str) -> None:
    new = {"Hello World": "Hello time", "Publishing: ": "Hi ", "create_publisher": "make"}[old]
    found = behind("run.wrong_text", PUBLISHER.replace(old, new))
    assert found is None or found.kind != "node.of_tutorial"


@pytest.mark.parametrize(
    ("name", "line", "fix"),
    [
        ("period_half_with_name", "timer_period = 0.5", "Write timer_period = 1.0."),
        ("period_two_with_constant", "PERIOD = 2.0", "Write PERIOD = 1.0."),
        ("period_half", "self.create_timer(0.5, self.timer_callback)",
         "Write 1.0 instead of 0.5 in this call of create_timer."),
    ],
)  # fmt: skip
def test_a_wrong_period_is_where_its_value_is_written(
    name: str, line: str, fix: str, tmp_path: Path
) -> None:
    root = write(BY_NAME[name], tmp_path)
    found = mark(root).check("run.period")
    assert found.where is not None
    rows = (root / NODE).read_text(encoding="utf-8").split("\n")
    assert rows[(found.where.line or 0) - 1].strip() == line
    assert found.fix == fix


HELPER = "self.make_text()"
INIT = "    rclpy.init(args=args)\n"


@pytest.mark.parametrize(
    ("log", "body", "wanted"),
    [
        (f"self.get_logger().info({HELPER})", "return 'Hello time: ' + str(self.counter_)\n",
         ("node.counter_not_increased", f"self.get_logger().info({HELPER})",
          "Add to the callback, after the log line: self.counter_ += 1")),
    ],
)  # fmt: skip
def test_the_step_of_a_method_that_makes_the_text(
    log: str, body: str, wanted: tuple[str, str, str]
) -> None:
    method = "    def make_text(self):\n        " + body.format(step=STEP.strip("\n"))
    text = changed(RIGHT, (STEP, ""), (LOG, log), ("\n\ndef main(", f"\n{method}\n\n\ndef main("))
    text = text.replace("            self.counter_ += 1", "        self.counter_ += 1")
    kind, line, fix = told(behind("run.constant_counter", text), text)
    assert (kind, line) == wanted[:2]
    assert fix.startswith(wanted[2])


@pytest.mark.parametrize(
    ("init", "fix"),
    [
        (INIT, "Move this line into main, below rclpy.init(args=args) (line "),
        ("", "Move this line into main, and write rclpy.init(args=args) above it."),
    ],
    ids=["init in main", "no init"],
)
def test_a_node_that_is_created_on_import(init: str, fix: str) -> None:
    made = "node = MyFirstNode()\n\n\ndef main("
    text = changed(RIGHT, ("    node = MyFirstNode()\n", ""), (INIT, init), ("def main(", made))
    error = "rclpy.exceptions.NotInitializedException: rclpy.init() has not been called."
    found = behind_error(Raised(error, Where(file=NODE, line=9), source_of(text), ASSIGNMENT))
    kind, line, said = told(found, text)
    assert (kind, line) == ("node.made_on_import", "node = MyFirstNode()")
    assert fix in said


@pytest.mark.parametrize(
    ("step", "number"),
    [
        ("self.counter_ = (self.counter_ + 1) % 60", 60),
        ("self.counter_ += 1\n        self.counter_ %= 100", 100),
        ("self.counter_ += 1", None),
        ("self.counter_ += 7 % 2", None),
    ],
)
def test_a_count_that_begins_again(step: str, number: int | None) -> None:
    found = wrapped_at(source_of(changed(RIGHT, ("self.counter_ += 1", step))))
    assert (found[1] if found is not None else None) == number
