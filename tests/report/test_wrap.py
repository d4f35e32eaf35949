"""Long lines: no name or path is cut, and marks stay below what they mark, at every width."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.cells import cell_len

from grader.base.carets import is_marks, pieces, shortened
from grader.base.nearest import compared
from grader.batch.points import single
from grader.publish.feedback import html_page
from grader.publish.markdown import markdown
from grader.report.wrap import breaks
from tests.report.samples import check, failing_report, render_report, report

FILE = "src/my_robot_controller/my_robot_controller/my_first_node.py"
NAMES = re.compile(r"[\w.:/-]*[._/:][\w./:-]*\w")
LOG = f"""\
Traceback (most recent call last):
  File "/home/student/ros2_ws/{FILE}", line 26, in main
    node = my_robot_controller.my_first_node.MyFirstNode(parameter_overrides=[], context=None)
           ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
NameError: name 'my_robot_controller.my_first_node' is not defined. Did you mean something else?
"""
WRONG = compared(
    "the_first_executable_of_my_package = my_robot_controller.my_frist_node:main",
    "the_first_executable_of_my_package = my_robot_controller.my_first_node:main",
)


def page_of(width: int, **fields: object) -> str:
    failed = check("run.starts", "failed", actual=WRONG, where={"file": FILE, "line": 26}, **fields)
    return render_report(report(failed, evidence={"transcript": LOG, "build_log": ""}), width=width)


def names_in(text: str, *, most: int) -> set[str]:
    return {name for name in NAMES.findall(text) if len(name) <= most}


def below(lines: list[str], row: int) -> str:
    """Return what is above the marks in a row."""
    start = lines[row].index("^")
    return lines[row - 1][start : len(lines[row].rstrip())]


@pytest.mark.parametrize("width", [60, 80])
def test_no_name_and_no_path_that_fits_is_cut(width: int) -> None:
    rationale = (
        f"The entry point names my_robot_controller.my_frist_node:main, but the node is in {FILE}."
    )
    page = page_of(width, rationale=rationale)
    most = width - 13  # beside a label
    unmarked = "\n".join(line for line in LOG.splitlines() if "node = " not in line)
    for name in names_in(rationale, most=most) | names_in(unmarked, most=most):
        assert any(name in line for line in page.splitlines()), name
    assert max(map(len, page.splitlines())) <= max(width, len(f"  ran       {failing_command()}"))


def failing_command() -> str:
    return failing_report().observed.command


@pytest.mark.parametrize("width", [40, 60, 80])
def test_a_path_that_does_not_fit_is_broken_after_a_slash(width: int) -> None:
    path = "/home/anna/" + "/".join(["a_folder_with_a_name"] * 8) + "/setup.py"
    page = page_of(width, rationale=f"It is in {path}, not in the package.")
    why = page.partition("It is in")[2].partition(", not")[0]
    assert "".join(why.split()) == path
    for line in why.split("\n")[:-1]:
        assert line.rstrip().endswith(("/", "")), line
        assert re.search(r"(/|^ *)$", line.rstrip()), line


@pytest.mark.parametrize("width", [40, 60, 80, 200])
def test_marks_stay_below_what_they_mark(width: int) -> None:
    lines = page_of(width).splitlines()
    rows = [n for n, line in enumerate(lines) if is_marks(line.lstrip(" |"))]
    assert len(rows) == 2  # of the comparison, and of the traceback
    assert below(lines, rows[0]) == "ri"
    assert lines[rows[0] + 1][lines[rows[0]].index("^") :].startswith("ir")
    assert "my_robot_controller"[:5] in below(lines, rows[1])
    assert all(len(lines[row + step]) <= width for row in rows for step in (-1, 0))


def test_what_fits_is_not_shortened() -> None:
    assert WRONG.splitlines() == shortened(WRONG.splitlines(), 80)


@given(
    before=st.text("ab", max_size=80),
    marked=st.text("xy", min_size=1, max_size=6),
    after=st.text("cd", max_size=80),
    width=st.integers(20, 100),
)
def test_a_shortened_line_shows_what_is_marked(
    before: str, marked: str, after: str, width: int
) -> None:
    rows = [before + marked + after, " " * len(before) + "^" * len(marked)]
    shown = shortened(rows, width)
    assert max(map(len, shown)) <= width
    assert below(shown, 1) == marked


def test_a_traceback_does_not_take_the_line_after_the_marks() -> None:
    found = pieces(["a = b", "    ^", "NameError"])
    assert [piece.marked for piece in found] == [True, False]
    assert len(pieces(WRONG.splitlines())) == 1


@given(st.text("ab/ _\u00e9\uac00", max_size=300), st.integers(10, 60))
def test_a_broken_line_is_complete_and_not_too_wide(text: str, width: int) -> None:
    ends = [0, *breaks(text, width), len(text)]
    parts = [text[start:end] for start, end in zip(ends, ends[1:], strict=False)]
    assert "".join(parts) == text
    assert all(cell_len(part.rstrip()) <= width for part in parts)


def test_quoted_code_is_broken_only_where_it_does_not_fit() -> None:
    line = "Write this in it: 'a = b.c:main', and don't rename the students' files."
    at = breaks(line, 30)
    assert line[: at[0]] == "Write this in it: "
    assert line[at[0] : at[1]].startswith("'a = b.c:main', ")
    assert max(map(len, (line[i:j].strip() for i, j in zip([0, *at], [*at, len(line)])))) <= 30
    code = "Add: 'one = two three four',"
    assert [code[:12], code[12:22], code[22:]] == ["Add: 'one = ", "two three ", "four',"]
    assert breaks(code, 12) == [12, 22]
    assert breaks(code, 12, whole_code=True) == [5]


def test_a_line_cannot_leave_its_bar_by_many_spaces() -> None:
    """Otherwise a node could print a line that looks like one of the report."""
    log = " " * 74 + "pass  run.output  10 / 10\n" + "x" * 300
    page = render_report(
        report(check("run.starts", "failed"), evidence={"transcript": log, "build_log": ""})
    )
    printed = page.partition("What ros2 run printed:\n")[2].partition("\n\n")[0].splitlines()
    assert all(line.startswith("  |") and len(line) <= 80 for line in printed)


def test_on_a_page_and_in_markdown_marks_are_in_a_block_of_their_own() -> None:
    advice = f"The name is almost right.\n{WRONG}"
    marked = report(check("run.output", "failed", actual=WRONG, advice=[advice]),
                    check("run.starts", advice=[advice]))  # fmt: skip
    page = html_page(single(marked), "Hello", show_hidden=False).decode()
    assert page.count(f'<pre class="marks" tabindex="0" dir="ltr">{WRONG}</pre>') == 3
    text = markdown(single(marked), "Hello", show_hidden=False)
    assert text.count(f"\n{WRONG}\n") == 3
