"""Evaluates the checks in order; the texts of the results are in the reader's language."""

from __future__ import annotations

import time
import traceback
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from grader.base.errors import GraderError
from grader.base.i18n.message import Message, say
from grader.base.i18n.translator import Translator
from grader.course.assignment import Assignment, CheckUse
from grader.report.model import CheckResult, CheckStatus, Mistake, Visibility, Where
from grader.verdict.causes import UNDECIDED, cause_of, says_why
from grader.verdict.checks.all import CHECKS
from grader.verdict.checks.declare import Check
from grader.verdict.evidence import Evidence
from grader.verdict.explained import explained_by, says_of_world
from grader.verdict.of_node import NodeEvidence, because_of_another, views
from grader.verdict.outcome import Blocked, Failed, Inconclusive, Passed
from grader.verdict.own_checks import checks_of
from grader.verdict.together import together

if TYPE_CHECKING:
    from grader.mistakes.recognised import RecognisedMistake
    from grader.verdict.diagnose import Diagnosis


@dataclass(frozen=True)
class AssignedCheck:
    """A check of an assignment; `depends` has those of its dependencies that are assigned too."""

    check: Check
    use: CheckUse
    depends: tuple[str, ...]

    @property
    def points(self) -> float:
        """The points that it is worth."""
        return self.use.points

    @property
    def visibility(self) -> Visibility:
        """Who sees its result."""
        return self.use.visibility

    @property
    def title(self) -> Message:
        """Its title, with the values of its parameters."""
        return self.check.title_of(self.use)


Announce = Callable[[AssignedCheck], None]


def assigned_checks(assignment: Assignment) -> list[AssignedCheck]:
    """Return an assignment's checks, each after those that it depends on.

    Those of a kind are in the order in which the runs start their nodes: what one sends, the next
    one works on. What a world itself says comes last: it follows from all that the nodes do.
    """
    uses: dict[str, list[CheckUse]] = {}
    for use in assignment.checks:
        uses.setdefault(use.kind, []).append(use)
    order = [begin.node for plan in assignment.runs for begin in plan.start]

    def started(use: CheckUse) -> int:
        return order.index(use.of) if use.of in order else 0

    found = [
        AssignedCheck(
            check,
            use,
            tuple(found.id for needed in check.depends for found in uses.get(needed, ())),
        )
        for check in checks_of(assignment).values()
        for use in sorted(uses.get(check.id, ()), key=started)
    ]
    if not assignment.runs:
        return found
    return sorted(found, key=lambda one: says_of_world(one.use, assignment.plan(one.use.run)))


def evaluate_checks(
    evidence: Evidence,
    translate: Translator,
    *,
    only: Collection[str] | None = None,
    announce: Announce | None = None,
) -> Iterator[CheckResult]:
    """Evaluate the assignment's checks (those whose id or kind is in `only`); yield the results.

    Each result is added to `evidence` first. `announce` is called with each check before it is
    evaluated. The first check that needs the build or the run makes it. Raises GraderError;
    any other exception that is not an outcome becomes a result with the status `error`, which
    blocks no other check: what depends on it is decided by what it finds itself.
    """
    for assigned in assigned_checks(evidence.assignment):
        if only is not None and not {assigned.use.id, assigned.check.id} & set(only):
            continue
        if announce is not None:
            announce(assigned)
        result = _evaluate(assigned, evidence, translate)
        evidence.results[result.id] = result
        yield result


def evaluate_again(
    check_id: str,
    evidence: Evidence,
    translate: Translator,
    *,
    without: Collection[str] = (),
    found: RecognisedMistake | None = None,
) -> CheckResult:
    """Return a check's result with a diagnosis of none of the kinds `without`, or as `found`."""
    assigned = {one.use.id: one for one in assigned_checks(evidence.assignment)}
    before = evidence.results
    # (its own failure is no earlier one, because of which it would be skipped)
    evidence.results = {one: result for one, result in before.items() if one != check_id}
    try:
        return _evaluate(assigned[check_id], evidence, translate, without, found)
    finally:
        evidence.results = before


@dataclass(frozen=True, kw_only=True)
class _Result:
    """The result of a check before translation."""

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
    fault: str = ""


def _evaluate(
    assigned: AssignedCheck,
    evidence: Evidence,
    translate: Translator,
    without: Collection[str] = (),
    cause: RecognisedMistake | None = None,
) -> CheckResult:
    """Return the result of a check, which is evaluated for each node that it is about."""
    about: Sequence[Evidence] = views(evidence, assigned.check, assigned.use)
    parts = [_part(assigned, one, translate, without, cause) for one in about or [evidence]]
    if about and assigned.check.covers:
        evidence.parts[assigned.use.id] = parts
    return parts[0] if len(parts) == 1 else together(parts, translate)


def _part(
    assigned: AssignedCheck,
    evidence: Evidence,
    translate: Translator,
    without: Collection[str],
    cause: RecognisedMistake | None,
) -> CheckResult:
    begin = time.monotonic()
    try:
        found = _found(assigned, evidence, without, cause)
    except GraderError:
        raise
    except (Exception, SystemExit):  # a bug in one check must not lose the results of the others
        found = _Result(
            status="error",
            actual=say("this check of the grader has a bug; the report has the details"),
            fault=traceback.format_exc(limit=-4),
        )
    result = CheckResult(
        id=assigned.use.id,
        title=translate(assigned.title),
        status=found.status,
        score=found.score,
        max_score=assigned.points,
        visibility=assigned.visibility,
        rationale=translate(found.rationale),
        expected=translate(found.expected),
        actual=translate(found.actual),
        fix=translate(found.fix),
        advice=[translate(text) for text in found.advice],
        mistakes=list(found.mistakes),
        where=found.where,
        depends=list(assigned.depends),
        consequence_of=found.consequence_of,
        blocked_by=found.blocked_by,
        fault=found.fault,
        seconds=0 if found.status == "skipped" else round(time.monotonic() - begin, 3),
    )
    if not isinstance(evidence, NodeEvidence):
        return result
    here = {"where": evidence.place(found.where), "node": evidence.node, "run": evidence.run_name}
    return result.model_copy(update=here)


def _found(
    assigned: AssignedCheck,
    evidence: Evidence,
    without: Collection[str],
    cause: RecognisedMistake | None,
) -> _Result:
    lacking = evidence.lacking if isinstance(evidence, NodeEvidence) else ""
    blocker = lacking or _blocker(assigned, evidence)
    outcome = Blocked(by=blocker) if blocker else assigned.check.evaluate(evidence, assigned.use)
    if isinstance(outcome, Blocked):
        reason = _unasked(outcome.by, evidence)
        outcome = outcome if reason is None or isinstance(reason, Passed) else reason
    if isinstance(outcome, Failed) and isinstance(evidence, NodeEvidence):
        other = because_of_another(evidence, assigned.check, assigned.use)
        other = other or explained_by(evidence, assigned.check, assigned.use, outcome)
        outcome = Blocked(by=other) if other else outcome
    if isinstance(outcome, Passed):
        return _Result(
            status="passed", score=assigned.points, actual=outcome.actual, advice=outcome.advice
        )
    if isinstance(outcome, Inconclusive):
        return _Result(status="inconclusive", actual=outcome.reason)
    if isinstance(outcome, Blocked):
        return _skipped(assigned, outcome.by, evidence)
    if not outcome.blocks:
        evidence.not_blocking.add(assigned.use.id)
    diagnosis, fault = _diagnosis(outcome, evidence, without, cause)
    if diagnosis.follows_a_fact:
        return _skipped(assigned, diagnosis.consequence_of, evidence)
    return _Result(
        status="failed",
        fault=fault,
        rationale=diagnosis.rationale,
        expected=diagnosis.expected,
        actual=diagnosis.actual,
        fix=diagnosis.fix,
        advice=diagnosis.advice,
        mistakes=diagnosis.mistakes,
        where=diagnosis.where,
        consequence_of=diagnosis.consequence_of,
    )


def _diagnosis(
    failed: Failed,
    evidence: Evidence,
    without: Collection[str],
    cause: RecognisedMistake | None,
) -> tuple[Diagnosis, str]:
    """Return the diagnosis of a failed check, and the traceback of a fault of ours in it.

    A check that has failed stays so: without a cause behind it, its own diagnosis is kept.
    """
    from grader.verdict.diagnose import Diagnosis, diagnose  # noqa: PLC0415 - it imports all mistakes

    try:
        return diagnose(failed, evidence, without, cause), ""
    except GraderError:
        raise
    except Exception:
        return Diagnosis.of(failed), traceback.format_exc(limit=-4)


def _blocker(assigned: AssignedCheck, evidence: Evidence) -> str:
    for dependency in assigned.depends:
        result = evidence.results.get(dependency)
        if dependency in evidence.not_blocking:
            continue
        if result is not None and result.status not in ("passed", "error"):
            return result.blocked_by or dependency
    return ""


def _skipped(assigned: AssignedCheck, by: str, evidence: Evidence) -> _Result:
    """Return the result of a check that another one prevents, given by its id or its kind."""
    uses = {use.id: use for use in evidence.assignment.checks}
    ids = [by] if by in uses else [use.id for use in uses.values() if use.kind == by]
    ends = [cause_of(check_id, evidence.results) for check_id in ids]
    cause = next((end for end in ends if says_why(end)), None)
    root = cause.id if cause is not None else next(iter(ids), by)
    titles = {one.use.id: one.title for one in assigned_checks(evidence.assignment)}
    plain = CHECKS[root].title if root in CHECKS and not CHECKS[root].parameters else root
    title = titles.get(root) or Message(plain)
    if evidence.is_hidden(root) and assigned.visibility == "visible":
        title = say("a hidden check")
    if cause is not None and cause.status in UNDECIDED:
        unknown = say("not known, because another check could not be decided: {title}", title=title)
        return _Result(status="inconclusive", blocked_by=root, actual=unknown)
    actual = say("skipped because of: {title}", title=title)
    return _Result(status="skipped", blocked_by=root, actual=actual)


def _unasked(by: str, evidence: Evidence) -> Passed | Failed | Blocked | Inconclusive | None:
    """Return the outcome of a check that nobody asked for here; None if a result says why.

    What it finds is the reason for which a check that names it fails: the assignment may not have it,
    or for other nodes or another run only.
    """
    known = [use.id for use in evidence.assignment.checks if by in (use.id, use.kind)]
    results = evidence.results
    told = any(one not in results or says_why(cause_of(one, results)) for one in known)
    asked = CHECKS.get(by)
    if told or asked is None or asked.parameters is not None:
        return None
    return asked.evaluate(evidence, CheckUse(id=by, points=0))
