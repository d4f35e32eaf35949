"""Small assignments marked for real: each failure is told once, by the check nearest to its cause."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.report.model import CheckResult
from grader.verdict.causes import cause_of
from tests.small_lessons import HEAD, LESSONS, Broken, Lesson
from tests.test_scenarios import marked

pytestmark = [pytest.mark.prefix, pytest.mark.full]
IN_CI = ("parameters_right", "parameters_other_node", "lifecycle_no_super_on_activate")
CASES = [(lesson, form) for lesson in LESSONS for form in (None, *lesson.broken)]


def name_of(lesson: Lesson, form: Broken | None) -> str:
    return f"{lesson.name}_{form.name if form is not None else 'right'}"


def place_of(check: CheckResult) -> str:
    return f"{check.where.file}:{check.where.line}" if check.where is not None else ""


@pytest.mark.parametrize(
    ("lesson", "form"),
    [
        pytest.param(
            lesson,
            form,
            id=name_of(lesson, form),
            marks=[] if name_of(lesson, form) in IN_CI else pytest.mark.long,
        )
        for lesson, form in CASES
    ],
)
def test_a_failure_is_told_once_where_its_cause_is(
    lesson: Lesson, form: Broken | None, tmp_path: Path
) -> None:
    file = tmp_path / "lesson" / "assignment.yaml"
    file.parent.mkdir()
    file.write_text(HEAD + lesson.assignment, encoding="utf-8")
    report = marked(lesson.write(tmp_path, form), file, [])
    failed = {check.id: check for check in report.checks if check.status == "failed"}
    if form is None:
        assert {c.id: c.actual for c in report.checks if c.status != "passed"} == {}
        return
    assert {name: check.mistakes[0].id for name, check in failed.items()} == dict(form.fails)
    first = failed[next(iter(form.fails))]
    assert not form.where or place_of(first) == form.where
    told = "\n".join(f"{c.rationale}\n{c.fix}" for c in report.checks)
    assert [text for text in form.says if text not in told] == []
    assert [text for text in form.never if text in told] == []
    by_id = {check.id: check for check in report.checks}
    for check in report.checks:
        cause = cause_of(check.id, by_id)
        assert cause is not None and cause.status in ("passed", "failed"), check.id
