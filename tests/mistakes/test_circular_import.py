"""A circle of imports: both lines are named, and what to move."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.verdict.circular import UNFINISHED
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.recorded import mark

BY_NAME = {package.name: package for package in BROKEN}
NODE, HELPER = "my_robot_controller/my_first_node.py", "my_robot_controller/text_helper.py"


@pytest.mark.parametrize(
    ("name", "fix"),
    [
        ("files_import_each_other", f"Move PREFIX from {NODE} to {HELPER}"),
        ("helper_imports_the_node", f"Delete this import of {NODE}"),
    ],
)
def test_both_lines_are_named(name: str, fix: str, tmp_path: Path) -> None:
    failed = mark(write(BY_NAME[name], tmp_path)).check("run.starts")
    assert failed.where is not None
    assert failed.where.file == HELPER
    assert failed.rationale.startswith("Line ")
    assert f" of {NODE} imports {HELPER}" in failed.rationale
    assert failed.fix.startswith(fix)


@pytest.mark.parametrize(
    "file",
    [
        pytest.param("", id="to 3.12"),
        pytest.param(
            " from '/home/student/ros2_ws/build/my_package/my_node.py'", id="from 3.13 on"
        ),
    ],
)
def test_the_message_of_every_python_is_known(file: str) -> None:
    message = (
        f"partially initialized module 'my_package.my_node'{file} has no attribute 'HELLO' "
        "(most likely due to a circular import)"
    )
    match = UNFINISHED.search(message)
    assert match is not None
    assert (match["of"], match["attribute"]) == ("my_package.my_node", "HELLO")
