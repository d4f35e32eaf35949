"""A fix names the student's own line and words, and its patch is exactly that change."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.catalogue import CATALOGUE, fixes_for
from grader.mistakes.fixes.case import Case, Finding
from grader.mistakes.recognised import RecognisedMistake
from grader.package.edit.files import Files
from tests.fixing import first_fix
from tests.marking import ASSIGNMENT, taken_in
from tests.mistakes.test_diagnose import RIGHT
from tests.mistakes.test_from_source import line_of, raised
from tests.static_bench import NODE, Bench

LOG = "self.get_logger().info('Hello time: ' + str(self.counter_))"
STEP = "        self.counter_ += 1\n"
UNBOUND = "UnboundLocalError: cannot access local variable '{}' where it is not associated"
NO_INIT = "rclpy.exceptions.NotInitializedException: rclpy.init() has not been called"
MISSING = "TypeError: MyFirstNode.__init__() missing 1 required positional argument: '{}'"


def changed(*edits: tuple[str, str]) -> str:
    text = RIGHT
    for old, new in edits:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


def fix_of(found: RecognisedMistake | None) -> str:
    assert found is not None
    return str(CATALOGUE[found.kind].fix_text({**found.params, **found.words}, found.variant))


def why_of(found: RecognisedMistake | None) -> str:
    assert found is not None
    return str(CATALOGUE[found.kind].rationale({**found.params, **found.words}, found.variant))


def patched(found: RecognisedMistake | None, text: str, folder: Path) -> str:
    """Return the node's file after the fix of a mistake; "" if no fix is certain."""
    assert found is not None
    assert found.where is not None
    bench = Bench(folder / "my_robot_controller")
    bench.write(NODE, text)
    finding = Finding(
        "run.output", found.kind, dict(found.params), found.where.file, found.where.line
    )
    case = Case(Files.of(taken_in(bench.root)), finding, ASSIGNMENT)
    new = first_fix(case, fixes_for(finding))
    data = new.data(NODE) if new is not None else b""
    return (data or b"").decode()


@pytest.mark.parametrize(
    ("old", "new", "fix"),
    [
        ("    rclpy.init(args=args)\n", "", "Write rclpy.init() as the first line of main."),
    ],
)  # fmt: skip
def test_no_args_are_named_in_a_function_without_them(old: str, new: str, fix: str) -> None:
    text = changed((old, new), ("def main(args=None):", "def main():"))
    assert fix_of(raised(NO_INIT, text, line_of(text, "super()"))) == fix


def test_a_parameter_of_unknown_use_is_not_removed(tmp_path: Path) -> None:
    text = changed(
        ("__init__(self)", "__init__(self, prefix)"),
        ("self.counter_ = 0", "self.counter_ = 0\n        self.prefix = prefix"),
    )
    found = raised(MISSING.format("prefix"), text, line_of(text, "node = MyFirstNode()"))
    assert (
        fix_of(found)
        == "Write a value for prefix in the () of MyFirstNode.__init__, where it is called."
    )
    assert patched(found, text, tmp_path) == ""
