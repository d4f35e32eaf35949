"""The fix in a report, applied with git, makes the failed check pass."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.report import events
from grader.verdict import try_fixes
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.fix.corpus_fixes import TOOLS, with_tool
from tests.recorded import mark

BY_NAME = {package.name: package for package in BROKEN}


@pytest.mark.parametrize(
    "name",
    ["period_half", "comma_missing", "printed"],
)
def test_the_fix_in_a_report_makes_the_failed_check_pass(name: str, tmp_path: Path) -> None:
    handed_in = write(BY_NAME[name], tmp_path)
    report = mark(handed_in)
    first = next(check for check in report.checks if check.status == "failed")
    fixed = mark(with_tool(TOOLS[0], first.patch.encode(), handed_in))
    now = {check.id: check.status for check in fixed.checks}
    assert now[first.id] == "passed"
    assert first.patch not in [check.patch for check in fixed.checks]


def test_a_passed_check_has_no_fix(tmp_path: Path) -> None:
    report = mark(write(BY_NAME["printed"], tmp_path))
    assert {check.patch for check in report.checks if check.status != "failed"} == {""}


def test_a_failing_fix_costs_no_verdict_and_is_reported(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def faulty(*_: object) -> str:
        raise KeyError("our fault")

    handed_in = write(BY_NAME["comma_missing"], tmp_path)
    right = mark(handed_in)
    monkeypatch.setattr(try_fixes, "fixes_of", faulty)
    messages: list[events.Event] = []
    report = mark(handed_in, listener=messages.append)
    assert {check.id: check.status for check in report.checks} == {
        check.id: check.status for check in right.checks
    }
    assert {check.patch for check in report.checks} == {""}
    assert any(isinstance(event, events.Note) and "our fault" in event.text for event in messages)
