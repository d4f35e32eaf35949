"""A method whose def is in a comment or in a text: it is named there, and made code."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.fixes.case import Case, Finding
from grader.mistakes.fixes.first_line import shebang
from grader.package.edit.files import Files
from tests.marking import ASSIGNMENT, taken_in
from tests.mistakes.test_from_source import line_of, raised
from tests.mistakes.test_named_exactly import LOG, STEP, changed, fix_of, patched, why_of
from tests.static_bench import NODE, Bench

ERROR = "AttributeError: 'MyFirstNode' object has no attribute 'timer_callback'"
DEF = "    def timer_callback(self):\n"
DOC = '        """Say hello once; the timer calls this for as long as the node spins."""\n'
METHOD = f"{DEF}{DOC}        {LOG}\n{STEP}"
PLAIN = f"{DEF}        {LOG}\n{STEP}"


@pytest.mark.parametrize(
    ("hidden", "right"),
    [
        (f"    # ---- the timer ---- def timer_callback(self):\n{PLAIN[len(DEF) :]}",
         f"    # ---- the timer ----\n{PLAIN}"),
        (f"    # def timer_callback(self):\n{PLAIN[len(DEF) :]}", PLAIN),
        (f'    """\n{PLAIN}    """\n', PLAIN),
        (f"    '''old one\n{PLAIN}    '''\n", ""),
        (f"    # def timer_callback(self):\n    #     {LOG}\n", ""),
    ],
)  # fmt: skip
def test_a_hidden_def_is_named_where_it_is(hidden: str, right: str, tmp_path: Path) -> None:
    text = changed((METHOD, hidden))
    found = raised(ERROR, text, line_of(text, "self.create_timer("))
    assert found is not None
    assert found.kind == "node.commented_out"
    assert found.where is not None
    assert found.where.line == line_of(text, "def timer_callback")
    assert patched(found, text, tmp_path) == (changed((METHOD, right)) if right else "")
    if "'''" in hidden or '"""' in hidden:
        assert "three quotes" in why_of(found)
        assert f"in line {line_of(text, 'def timer_callback') - 1} and in line" in fix_of(found)
    else:
        assert "Write def timer_callback(self): on a line of its own" in fix_of(found)


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
