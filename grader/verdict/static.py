"""What a package's files alone answer: nothing is built or run."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import NoReturn

from grader.base.i18n.translator import SOURCE, Translator
from grader.course.assignment import Assignment
from grader.mistakes.fixes.case import Finding, finding_of
from grader.package.edit.files import Files
from grader.package.submission import Submission
from grader.report.model import CheckResult
from grader.verdict.ask import ask_in_order
from grader.verdict.checks.all import CHECKS
from grader.verdict.evidence import Evidence
from grader.verdict.outcome import Inconclusive


def ask_files(
    submission: Submission,
    assignment: Assignment,
    *,
    only: Collection[str] | None = None,
    lang: str = SOURCE,
) -> Iterator[CheckResult]:
    """Ask in order; a check (of those in `only`) that needs a build or a run is inconclusive."""
    evidence = Evidence(assignment, submission, build=_not_here, run=_not_here)
    return ask_in_order(evidence, Translator(lang), only=only)


def decided(
    submission: Submission, assignment: Assignment, only: str = "", *, lang: str = SOURCE
) -> dict[str, CheckResult]:
    """Return the results of the checks that the files decide.

    With `only` it is that check, and those that it depends on. Their texts are in the language.
    """
    wanted = _with_causes(only) if only else None
    results = ask_files(submission, assignment, only=wanted, lang=lang)
    return {result.id: result for result in results if result.status in ("passed", "failed")}


def findings(
    files: Files,
    submission: Submission,
    assignment: Assignment,
    only: str = "",
    *,
    lang: str = SOURCE,
) -> list[Finding]:
    """Return what the files alone show to be wrong (for one check), in the order of the checks."""
    results = decided(files.put_into(submission), assignment, only, lang=lang).values()
    found = [f for f in map(finding_of, results) if f is not None]
    return [f for f in found if not only or f.check == only]


def _not_here() -> NoReturn:
    raise Inconclusive("the files alone do not decide")


def _with_causes(check_id: str) -> set[str]:
    found: set[str] = set()
    waiting = [check_id]
    while waiting:
        now = waiting.pop()
        if now in CHECKS and now not in found:
            found.add(now)
            waiting += CHECKS[now].depends
    return found
