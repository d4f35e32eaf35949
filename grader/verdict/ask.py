"""Asks the checks in order, and puts what each one found into a result in the reader's language."""

from __future__ import annotations

import time
import traceback
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass

from grader.base.errors import GraderError
from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from grader.course.assignment import Assignment
from grader.report.model import CheckResult, CheckStatus, Mistake, Visibility, Where
from grader.verdict.checks.all import CHECKS
from grader.verdict.diagnose import diagnose
from grader.verdict.evidence import Evidence
from grader.verdict.outcome import Blocked, Inconclusive, Passed
from grader.verdict.registry import Check


@dataclass(frozen=True)
class Question:
    """A check that an assignment uses; `depends` names those of its dependencies that it uses too."""

    check: Check
    points: float
    visibility: Visibility
    depends: tuple[str, ...]


Announce = Callable[[Question], None]


def questions(assignment: Assignment) -> list[Question]:
    """Return what an assignment asks, a cause before what it causes."""
    uses = {use.id: use for use in assignment.checks}
    return [
        Question(
            check,
            uses[check.id].points,
            uses[check.id].visibility,
            tuple(dependency for dependency in check.depends if dependency in uses),
        )
        for check in CHECKS.values()
        if check.id in uses
    ]


def ask_in_order(
    evidence: Evidence,
    translate: Translator,
    *,
    only: Collection[str] | None = None,
    announce: Announce | None = None,
) -> Iterator[CheckResult]:
    """Ask the assignment's checks (those in `only`) and yield each result once it is in the evidence.

    `announce` hears of each check before it is asked. The build and the run happen in the first
    check that needs them. Raises GraderError; any other fault of ours is a result of the
    status `error`.
    """
    for question in questions(evidence.assignment):
        if only is not None and question.check.id not in only:
            continue
        if announce is not None:
            announce(question)
        result = _ask(question, evidence, translate)
        evidence.results[result.id] = result
        yield result


@dataclass(frozen=True, kw_only=True)
class _Found:
    """What a check found, before its texts are in the reader's language."""

    status: CheckStatus
    score: float = 0
    rationale: str = ""
    expected: str = ""
    actual: str = ""
    fix: str = ""
    advice: Sequence[str] = ()
    mistakes: Sequence[Mistake] = ()
    where: Where | None = None
    consequence_of: str = ""
    blocked_by: str = ""


def _ask(question: Question, evidence: Evidence, translate: Translator) -> CheckResult:
    begin = time.monotonic()
    try:
        found = _found(question, evidence)
    except GraderError:
        raise
    except Exception:  # a fault of ours in one check must not lose the verdict on the others
        found = _Found(status="error", actual=traceback.format_exc(limit=-4))
    return CheckResult(
        id=question.check.id,
        title=translate(question.check.title),
        status=found.status,
        score=found.score,
        max_score=question.points,
        visibility=question.visibility,
        rationale=translate(found.rationale),
        expected=translate(found.expected),
        actual=translate(found.actual),
        fix=translate(found.fix),
        advice=[translate(text) for text in found.advice],
        mistakes=list(found.mistakes),
        where=found.where,
        depends=list(question.depends),
        consequence_of=found.consequence_of,
        blocked_by=found.blocked_by,
        seconds=0 if found.status == "skipped" else round(time.monotonic() - begin, 3),
    )


def _found(question: Question, evidence: Evidence) -> _Found:
    blocker = _blocker(question, evidence)
    outcome = Blocked(by=blocker) if blocker else question.check.ask(evidence)
    if isinstance(outcome, Passed):
        return _Found(
            status="passed", score=question.points, actual=outcome.actual, advice=outcome.advice
        )
    if isinstance(outcome, Inconclusive):
        return _Found(status="inconclusive", actual=outcome.reason)
    if isinstance(outcome, Blocked):
        return _skipped(question, outcome.by, evidence)
    diagnosis = diagnose(outcome, evidence)
    return _Found(
        status="failed",
        rationale=diagnosis.rationale,
        expected=diagnosis.expected,
        actual=diagnosis.actual,
        fix=diagnosis.fix,
        advice=diagnosis.advice,
        mistakes=diagnosis.mistakes,
        where=diagnosis.where,
        consequence_of=diagnosis.consequence_of,
    )


def _blocker(question: Question, evidence: Evidence) -> str:
    for dependency in question.check.depends:
        result = evidence.results.get(dependency)
        if result is not None and result.status != "passed":
            return result.blocked_by or dependency
    return ""


def _skipped(question: Question, by: str, evidence: Evidence) -> _Found:
    cause = evidence.results.get(by)
    root = (cause.blocked_by if cause is not None else "") or by
    title = CHECKS[root].title if root in CHECKS else root
    if evidence.is_hidden(root) and question.visibility == "visible":
        title = say("a hidden check")
    actual = say("not asked, because of: {title}", title=title)
    return _Found(status="skipped", blocked_by=root, actual=actual)
