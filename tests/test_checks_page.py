"""docs/checks.md is what the code declares."""

from __future__ import annotations

import re
from pathlib import Path

from grader.cli.update_checks_page import PAGE, page
from grader.course.load import load_assignment
from grader.verdict.checks.all import CHECKS
from tests.processes import ROOT


def test_the_page_of_checks_is_that_of_the_code() -> None:
    assert PAGE.read_text(encoding="utf-8") == page(), "run python -m grader.cli.update_checks_page"


def test_the_page_has_every_check_and_parameter() -> None:
    text = PAGE.read_text(encoding="utf-8")
    for check in CHECKS.values():
        assert f"`{check.id}`" in text
        for name in check.parameters.model_fields if check.parameters else ():
            assert f"| `{name}` |" in text.split(f"### `{check.id}`")[1].split("### ")[0]


def test_the_example_of_the_guide_is_an_assignment(tmp_path: Path) -> None:
    text = (ROOT / "docs" / "assignments.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```yaml\n(.*?)```", text, re.DOTALL)
    example = next(block for block in blocks if block.startswith("schema: 2"))
    file = tmp_path / "assignment.yaml"
    file.write_text(example, encoding="utf-8")
    found = load_assignment(file, known_checks=CHECKS)
    assert found.max_score == 30
    assert found.runs[0].topics["/doubled"] == "std_msgs/msg/Int32"
