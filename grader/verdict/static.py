"""Evaluates the checks with a package's files alone: nothing is built or run."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import NoReturn

from grader.base.i18n.translator import SOURCE, Translator
from grader.course.assignment import Assignment
from grader.mistakes.fixes.case import Finding, finding_of
from grader.package.edit.files import Files
from grader.package.submission import Submission
from grader.report.model import CheckResult
from grader.verdict.checks.all import CHECKS
from grader.verdict.evaluate import evaluate_checks
from grader.verdict.evidence import Evidence
from grader.verdict.outcome import Inconclusive


def evaluate_static(
    submission: Submission,
    assignment: Assignment,
    *,
    only: Collection[str] | None = None,
    lang: str = SOURCE,
) -> Iterator[CheckResult]:
    """Evaluate the checks (those in `only`); one that needs a build or a run is inconclusive."""
    evidence = Evidence(assignment, submission, build=_undecided, run=_undecided)
    return evaluate_checks(evidence, Translator(lang), only=only)


def static_results(
    submission: Submission, assignment: Assignment, only: str = "", *, lang: str = SOURCE
) -> dict[str, CheckResult]:
    """Return the results of the checks that the files decide, with texts in `lang`.

    With `only`, these are that check and the checks that it depends on.
    """
    wanted = _with_dependencies(only) if only else None
    results = evaluate_static(submission, assignment, only=wanted, lang=lang)
    return {result.id: result for result in results if result.status in ("passed", "failed")}


def static_findings(
    files: Files,
    submission: Submission,
    assignment: Assignment,
    only: str = "",
    *,
    lang: str = SOURCE,
) -> list[Finding]:
    """Return the findings of the files alone (of the check `only`, if given), in check order."""
    results = static_results(files.put_into(submission), assignment, only, lang=lang).values()
    found = [f for f in map(finding_of, results) if f is not None]
    return [f for f in found if not only or f.check == only]


def _undecided() -> NoReturn:
    raise Inconclusive("the files alone do not decide")


def _with_dependencies(check_id: str) -> set[str]:
    found: set[str] = set()
    waiting = [check_id]
    while waiting:
        now = waiting.pop()
        if now in CHECKS and now not in found:
            found.add(now)
            waiting += CHECKS[now].depends
    return found
