"""The advice names the line to change and the code to write there, in other forms of a mistake."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.recognise import behind_error, behind_symptom
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
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


@pytest.mark.parametrize(
    ("name", "line", "fix"),
    [
        ("period_two_with_constant", "PERIOD = 2.0", "Write 1.0 instead of 2.0."),
        ("period_half", "self.create_timer(0.5, self.timer_callback)",
         "Write 1.0 instead of 0.5."),
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
