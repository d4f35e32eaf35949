"""A line with == where one = was meant is named, and one = makes the node right."""

from __future__ import annotations

import pytest

from grader.mistakes.catalogue import CATALOGUE, fixes_for
from grader.mistakes.fixes.case import Case, Finding
from grader.mistakes.recognise import behind_error
from grader.mistakes.recognised import Raised
from grader.package.edit.files import Files
from grader.package.source.node import read_node
from grader.report.model import Where
from tests.fixing import first_fix
from tests.marking import ASSIGNMENT
from tests.mistakes.other_forms import RIGHT, changed
from tests.mistakes.test_other_forms import submitted
from tests.static_bench import NODE

OWN = "AttributeError: 'MyFirstNode' object has no attribute '{}'"
NO_NAME = "NameError: name '{}' is not defined"
UNBOUND = (
    "UnboundLocalError: cannot access local variable '{}' where it is not associated with a value"
)
START = "        self.counter_ = 0\n"
TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
PERIOD = TIMER.replace("1.0", "period")
LOG = "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"


def line_of(text: str, part: str) -> int:
    """Return the only line with a part."""
    (line,) = [n for n, row in enumerate(text.splitlines(), 1) if part in row]
    return line


def told(error: str, text: str, part: str) -> tuple[str, str, str]:
    """Return the mistake behind an error raised in the line of a part, its fix, and the new text."""
    line = line_of(text, part)
    source = read_node({NODE: text.encode()}.get, NODE, "main")
    assert source is not None
    found = behind_error(Raised(error, Where(file=NODE, line=line), source, ASSIGNMENT))
    if found is None:
        return "", "", text
    fix = str(CATALOGUE[found.kind].fix_text({**found.params, **found.words}, found.variant))
    params = dict(found.params)
    at = found.where.line if found.where else None
    finding = Finding("run.starts", found.kind, params, NODE, at)
    new = first_fix(
        Case(Files.of(submitted({NODE: text})), finding, ASSIGNMENT), fixes_for(finding)
    )
    after = new.data(NODE) if new is not None else None
    return found.kind, fix, after.decode() if after is not None else text


@pytest.mark.parametrize(
    ("error", "old", "new", "right", "fix"),
    [
        (OWN.format("counter_"), START, "        self.counter_ == 0\n", START,
         "Write one = in line {line}: self.counter_ = 0"),
        (OWN.format("t"), TIMER, f"        self.t == {TIMER.lstrip()}",
         f"        self.t = {TIMER.lstrip()}",
         "Write one = in line {line}: self.t = self.create_timer(1.0, self.timer_callback)"),
        (NO_NAME.format("period"), TIMER, f"        period==1.0\n{PERIOD}",
         f"        period=1.0\n{PERIOD}", "Write one = in line {line}: period = 1.0"),
        (UNBOUND.format("period"), TIMER, f"        period == 1.0\n{PERIOD}        period = 2.0\n",
         f"        period = 1.0\n{PERIOD}        period = 2.0\n",
         "Write one = in line {line}: period = 1.0"),
        (NO_NAME.format("node"), "node = MyFirstNode()", "node == MyFirstNode()",
         "node = MyFirstNode()", "Write one = in line {line}: node = MyFirstNode()"),
        (OWN.format("last"), LOG, f"{LOG}        self.last == self.counter_\n",
         f"{LOG}        self.last = self.counter_\n",
         "Write one = in line {line}: self.last = self.counter_"),
    ],
)  # fmt: skip
def test_one_equals_sign_is_written(error: str, old: str, new: str, right: str, fix: str) -> None:
    text = changed(RIGHT, (old, new))
    part = next(row for row in new.splitlines() if "==" in row)
    kind, said, after = told(error, text, part)
    assert (kind, said) == ("node.compared_not_assigned", fix.format(line=line_of(text, part)))
    assert after == changed(RIGHT, (old, right))


@pytest.mark.parametrize(
    ("start", "line"),
    [
        # one = would set the counter back in each callback, or read what has no value
        ("", "        self.counter_ == 0\n"),
        ("", "        self.counter_ == self.counter_ + 1\n"),
        # another line reads it first
        ("        print(self.counter_)\n        self.counter_ == 0\n", ""),
    ],
)
def test_one_equals_sign_that_would_not_do_is_not_asked_for(start: str, line: str) -> None:
    text = changed(RIGHT, (START, start), (LOG, f"{line}{LOG}"))
    part = "print(self" if start else line.strip()
    kind, _, _ = told(OWN.format("counter_"), text, part)
    assert kind == "node.attribute_not_set"
