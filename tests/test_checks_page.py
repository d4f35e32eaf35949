"""docs/checks.md is what the code declares."""

from __future__ import annotations

from grader.cli.update_checks_page import PAGE, page
from grader.verdict.checks.all import CHECKS


def test_the_page_of_checks_is_that_of_the_code() -> None:
    assert PAGE.read_text(encoding="utf-8") == page(), "run python -m grader.cli.update_checks_page"


def test_the_page_has_every_check_and_parameter() -> None:
    text = PAGE.read_text(encoding="utf-8")
    for check in CHECKS.values():
        assert f"`{check.id}`" in text
        for name in check.parameters.model_fields if check.parameters else ():
            assert f"| `{name}` |" in text.split(f"### `{check.id}`")[1].split("### ")[0]
