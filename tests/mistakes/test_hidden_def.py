"""A method whose def is in a comment or in a text: it is named there, and made code."""

from __future__ import annotations

from pathlib import Path

from grader.mistakes.fixes.case import Case, Finding
from grader.mistakes.fixes.first_line import shebang
from grader.package.edit.files import Files
from tests.marking import ASSIGNMENT, taken_in
from tests.mistakes.test_named_exactly import LOG, STEP, changed
from tests.static_bench import NODE, Bench

ERROR = "AttributeError: 'MyFirstNode' object has no attribute 'timer_callback'"
DEF = "    def timer_callback(self):\n"
DOC = '        """Say hello once; the timer calls this for as long as the node spins."""\n'
METHOD = f"{DEF}{DOC}        {LOG}\n{STEP}"
PLAIN = f"{DEF}        {LOG}\n{STEP}"


def test_line_numbers_above_the_shebang_are_no_code(tmp_path: Path) -> None:
    bench = Bench(tmp_path / "my_robot_controller")
    text = changed()
    bench.write(NODE, "1\n2\n3\n4\n" + text)
    case = Case(
        Files.of(taken_in(bench.root)), Finding("source.shebang", "source.pasted"), ASSIGNMENT
    )
    new = shebang(case)
    assert new is not None
    assert new.data(NODE) == text.encode()
