"""The checks, as far as a package's files alone answer them: nothing is built or run."""

from __future__ import annotations

from typing import NoReturn

from grader.base.i18n.translator import SOURCE
from grader.base.i18n.translator import Speaker
from grader.course.assignment import Assignment
from grader.course.assignment import CheckUse
from grader.mistakes.fixes.case import Finding
from grader.mistakes.fixes.case import finding_of
from grader.package.edit.files import Files
from grader.package.submission import Submission
from grader.report.model import CheckResult
from grader.verdict.ask import spoken
from grader.verdict.ask import told
from grader.verdict.checks.all import CHECKS
from grader.verdict.evidence import Evidence
from grader.verdict.registry import Check
from grader.verdict.registry import Failed
from grader.verdict.registry import Inconclusive
from grader.verdict.registry import Passed


def _not_here() -> NoReturn:
    raise Inconclusive("a build or a run is wanted")


def ask(
    submission: Submission, assignment: Assignment, only: str = "", *, lang: str = SOURCE
) -> dict[str, CheckResult]:
    """Return the results of the checks that need neither build nor run, in their order.

    With `only` it is that check, and those that it depends on. Their texts are in the language.
    """
    speak = Speaker(lang)
    evidence = Evidence(assignment, submission, build=_not_here, run=_not_here)
    uses = {use.id: use for use in assignment.checks}
    wanted = _with_causes(only) if only else set(uses)
    for check_id, check in CHECKS.items():
        asked = [d for d in check.depends if d in uses]
        if check_id in wanted & set(uses) and all(_passed(evidence.results.get(d)) for d in asked):
            result = _decide(check, uses[check_id], evidence, speak)
            if result is not None:
                evidence.results[check_id] = result
    return evidence.results


def _with_causes(check_id: str) -> set[str]:
    found: set[str] = set()
    waiting = [check_id]
    while waiting:
        now = waiting.pop()
        if now in CHECKS and now not in found:
            found.add(now)
            waiting += CHECKS[now].depends
    return found


def _passed(result: CheckResult | None) -> bool:
    return result is not None and result.status == "passed"


def _decide(check: Check, use: CheckUse, evidence: Evidence, speak: Speaker) -> CheckResult | None:
    said = check.ask(evidence)
    if not isinstance(said, (Passed, Failed)):
        return None
    common = {"id": check.id, "title": check.title, "max_score": use.points}
    return spoken({**common, **told(said)}, speak)


def findings(
    files: Files,
    submission: Submission,
    assignment: Assignment,
    only: str = "",
    *,
    lang: str = SOURCE,
) -> list[Finding]:
    """Return what the files alone show to be wrong (for one check), in the order of the checks."""
    results = ask(files.put_into(submission), assignment, only, lang=lang).values()
    found = [f for f in map(finding_of, results) if f is not None]
    return [f for f in found if not only or f.check == only]
