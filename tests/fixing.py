"""The first fix of a finding, and the diff of a failed check, without a build or a run."""

from __future__ import annotations

from collections.abc import Iterable

from grader.course.assignment import Assignment
from grader.mistakes.fixes.case import Case, Fix
from grader.package.edit.files import Files
from grader.package.submission import Submission
from grader.report.model import CheckResult
from grader.verdict.fix import certain_fixes, fixes_of, patch_text


def first_fix(case: Case, fixes: Iterable[Fix]) -> Files | None:
    """Return the files after the first fix that is certain; None if none is."""
    return next(certain_fixes(case, fixes), None)


def patch_for(result: CheckResult, submission: Submission, assignment: Assignment) -> str:
    """Return the diff with which a failed check passes; empty if no fix is certain."""
    new = next(fixes_of(result, submission, assignment), None)
    return "" if new is None else patch_text(Files.of(submission), new)
