"""The policy: lateness, penalty, which attempt counts, and corrections.

Everything is a pure function of the time stamps, the verdicts and the assignment's policy; nothing
here reads a clock.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timedelta

from grader.base.i18n.message import joined, say
from grader.batch.model import (
    Elsewhere,
    EntryStatus,
    GradebookEntry,
    Grant,
    LapsedOverride,
    Override,
    Student,
)
from grader.batch.points import marks, rounded
from grader.batch.words import local_instant
from grader.course.policy import Policy, amount
from grader.report.model import Report

DAY, HOUR = 86_400.0, 3_600.0
UNKNOWN_TIME = say("the time of submission is not known: no points were taken for lateness")
OUR_FAULT = say(
    "Not marked: the grader failed on this submission. This is not your fault, and your "
    "instructor knows about it."
)
FOUND = "package.found"
NO_PACKAGE = say("no package was found in it")
CALLED_LATE = say("the learning management system calls it late")


@dataclass(frozen=True)
class Attempt:
    """One attempt of a student, with its report if it has been marked.

    `problem` says why the attempt cannot be marked, `fault` how the grader failed on it; without
    either it is still to be marked. `late`, `late_seconds` and `extension` are what the learning
    management system says. `overrides` are the corrections of its verdict.
    """

    number: int
    submitted: datetime | None
    late: bool | None
    report: Report | None
    problem: str = ""
    notes: tuple[str, ...] = ()
    fault: str = ""
    late_seconds: float | None = None
    extension: datetime | None = None
    overrides: tuple[Override, ...] = ()


def due_date(policy: Policy, extension: datetime | None = None) -> datetime | None:
    """Return a student's due date: the policy's, or the later one that the student was granted."""
    dates = [at for at in (policy.deadline, extension) if at is not None]
    return max(dates, default=None)


def lateness(
    submitted: datetime | None,
    policy: Policy,
    *,
    stated: float | None = None,
    extension: datetime | None = None,
) -> float | None:
    """Return the seconds since the due date, 0 until the grace time ends; None if not known.

    `stated` is what the learning management system says: it counts, because the system knows each
    student's due date. It is cut off to its smallest unit, so the exact time counts if it agrees.
    """
    due = due_date(policy, extension)
    exact = (submitted - due).total_seconds() if submitted and due else None
    late = exact
    if stated is not None:
        agrees = exact is not None and stated <= exact < stated + _precision(stated)
        late = exact if agrees and stated else stated
    elif due is None and submitted is not None:
        late = 0
    if late is None:
        return None
    return late if late > policy.grace_seconds else 0


def _precision(stated: float) -> float:
    """Return the unit to which a system cuts off a time of two units: 2 days 3 hours."""
    return HOUR if stated >= DAY else 60 if stated >= HOUR else 1


def penalty(
    score: float,
    max_score: float,
    submitted: datetime | None,
    policy: Policy,
    *,
    stated: float | None = None,
    extension: datetime | None = None,
    slip_days: int = 0,
) -> float:
    """Return the points that lateness takes from a score; each begun day (hour) counts as a whole.

    At most the score and the policy's `most`; the whole score from the policy's `until` on (or an
    extension that ends later). Nothing if it is not known how late the submission is, and for the
    `slip_days` that are used.
    """
    late = lateness(submitted, policy, stated=stated, extension=extension)
    due = due_date(policy, extension)
    if not late:
        return 0
    at = submitted if submitted is not None or due is None else due + timedelta(seconds=late)
    if policy.end is not None and at is not None and at >= max(policy.end, due or policy.end):
        return score
    late = max(0.0, late - slip_days * DAY)
    rules = policy.late
    each, unit = (rules.per_day, DAY) if rules.per_day else (rules.per_hour, HOUR)
    taken = (amount(each, max_score) or 0) * math.ceil(late / unit)
    most = amount(rules.most, max_score)
    return rounded(max(0, min(taken, max_score if most is None else most, score)))


def extended(grant: Grant, extension: datetime | None = None) -> datetime | None:
    """Return the later due date of a student, of the system's and the instructor's; None: neither."""
    return max((at for at in (extension, grant.until) if at is not None), default=None)


def slip_days_used(late: float | None, grant: Grant) -> int:
    """Return how many slip days a submission uses that is so many seconds late."""
    return min(grant.slip_days, math.ceil((late or 0) / DAY))


def _stated(attempt: Attempt, policy: Policy, grant: Grant) -> float | None:
    """Return by how many seconds a submission is late in the system's words, after the grant.

    The system does not know the grant: the exact time counts if it is known.
    """
    stated, due = attempt.late_seconds, due_date(policy, attempt.extension)
    if not stated or grant.until is None or due is None:
        return stated
    if attempt.submitted is not None:
        return None
    return max(0.0, stated - max(0.0, (grant.until - due).total_seconds()))


def standing(
    student: Student,
    attempts: Sequence[Attempt],
    overrides: Sequence[Override],
    policy: Policy,
    max_score: float,
    *,
    elsewhere: Elsewhere | None = None,
    grant: Grant = Grant(),  # noqa: B008 - it is immutable
) -> GradebookEntry:
    """Return what a student gets; `attempts` are in the order of submission.

    `overrides` are corrections of no verdict on these attempts. A corrected check counts before the
    penalty for lateness; a corrected total is final. A student who handed in `elsewhere` keeps the
    existing grade, whatever the policy says about missing submissions.
    """
    if not attempts:
        entry = _without_attempt(student, policy, max_score, elsewhere)
        entry = _with_grant(entry, policy, grant, None)
        own = tuple(override for override in overrides if override.verdict == 0)
        others = [LapsedOverride(override) for override in overrides if override.verdict != 0]
        return _with_lapsed(_corrected(replace(entry, overrides=own)), others)
    rated = [_rate(student, attempt, policy, max_score, grant) for attempt in attempts]
    chosen = _chosen(rated, policy)
    entry = replace(rated[chosen], attempts=len(rated))
    others = [LapsedOverride(override) for override in overrides]
    others += [
        LapsedOverride(override, other.attempt)
        for other in (*rated[:chosen], *rated[chosen + 1 :])
        for override in other.overrides
    ]
    later = rated[chosen + 1 :] if policy.attempts == "best" else ()
    unmarked = tuple(
        say(
            "attempt {number}, later than the one that counts: {problem}",
            number=one.attempt,
            problem=one.problem,
        )
        for one in later
        if one.status == "ungradable"
    )
    return replace(_with_lapsed(entry, others), unmarked_later=unmarked)


def _with_lapsed(entry: GradebookEntry, others: Sequence[LapsedOverride]) -> GradebookEntry:
    """Return the entry with the corrections of other verdicts that are not made for this one."""
    own = {override.check for override in entry.overrides}
    lapsed = () if "" in own else tuple(one for one in others if one.override.check not in own)
    return replace(entry, lapsed=lapsed)


def _without_attempt(
    student: Student, policy: Policy, max_score: float, elsewhere: Elsewhere | None
) -> GradebookEntry:
    if elsewhere is not None:
        return GradebookEntry(
            student,
            "unclear" if elsewhere.is_unclear else "elsewhere",
            final=elsewhere.final,
            max_score=max_score,
            notes=(elsewhere.reason,),
        )
    nothing = 0.0 if policy.missing == "zero" else None
    return GradebookEntry(student, "missing", final=nothing, max_score=max_score)


def _with_grant(
    entry: GradebookEntry, policy: Policy, grant: Grant, extension: datetime | None
) -> GradebookEntry:
    """Return the entry with the student's due date and slip days, and what the instructor reads."""
    until = extended(grant, extension)
    due = due_date(policy, until)
    later = until is not None and until == due and until != policy.deadline
    notes = [*entry.notes]
    if later:
        at = local_instant(until, policy.zone)
        notes.append(say("the due date was extended until {time}", time=at))
    used = slip_days_used(entry.late_seconds, grant)
    if grant.slip_days:
        most = grant.slip_days
        notes.append(say("{used} of {most} slip days used", used=used, most=most))
    return replace(
        entry,
        due=due,
        is_extended=later,
        slip_days=grant.slip_days,
        slip_days_used=used,
        notes=tuple(notes),
    )


def _rate(
    student: Student, attempt: Attempt, policy: Policy, max_score: float, grant: Grant
) -> GradebookEntry:
    """Return what a student gets for this attempt."""
    stated = _stated(attempt, policy, grant)
    extension = extended(grant, attempt.extension)
    late = lateness(attempt.submitted, policy, stated=stated, extension=extension)
    due = due_date(policy, extension)
    notes = list(attempt.notes)
    if attempt.fault and attempt.report is None:
        notes.insert(0, say("the grader failed on it: {fault}", fault=attempt.fault))
    if late is None and (due is not None or attempt.late):
        notes.append(joined(UNKNOWN_TIME, CALLED_LATE if attempt.late else "", by="; "))
    entry = GradebookEntry(
        student,
        "ungradable" if attempt.problem else "pending",
        report=attempt.report,
        max_score=max_score,
        attempt=attempt.number,
        submitted=attempt.submitted,
        late_seconds=late,
        problem=attempt.problem,
        notes=tuple(notes),
        overrides=attempt.overrides,
    )
    entry = _with_grant(entry, policy, grant, attempt.extension)
    return _corrected(_with_points(entry, attempt, policy, stated, extension))


def _with_points(
    entry: GradebookEntry,
    attempt: Attempt,
    policy: Policy,
    stated: float | None,
    extension: datetime | None,
) -> GradebookEntry:
    """Return the entry with the points of its report, without a correction of the total."""
    if attempt.fault and attempt.report is None:
        return replace(entry, status="error", problem=OUR_FAULT)
    if attempt.report is None:
        return entry
    if attempt.report.status == "error":
        problem = attempt.problem or attempt.report.message or OUR_FAULT
        return replace(entry, status="error", problem=problem)
    if attempt.report.submission.package is None:
        return replace(entry, status="ungradable", problem=_nothing_marked(attempt.report))
    score = rounded(sum(mark.points or 0 for mark in marks(entry)))
    taken = penalty(
        score,
        entry.max_score,
        attempt.submitted,
        policy,
        stated=stated,
        extension=extension,
        slip_days=entry.slip_days_used,
    )
    final = rounded(score - taken)
    return replace(entry, status="graded", score=score, penalty=taken, final=final)


def _nothing_marked(report: Report) -> str:
    """Return why no package was found in a submission, in the report's language."""
    found = (check.actual for check in report.checks if check.id == FOUND and check.actual)
    return next(found, NO_PACKAGE)


def _chosen(rated: Sequence[GradebookEntry], policy: Policy) -> int:
    """Return the index of the attempt that counts; the earlier one of two equally good ones."""
    if policy.attempts == "last":
        return len(rated) - 1
    if policy.attempts == "first":
        return 0
    worth = [-1.0 if entry.final is None else entry.final for entry in rated]
    best = worth.index(max(worth))
    # if none has a verdict, the instructor is shown the last one
    return best if rated[best].final is not None else len(rated) - 1


def _corrected(entry: GradebookEntry) -> GradebookEntry:
    """Return the entry with its total corrected, if there is a correction."""
    whole = {override.check: override.points for override in entry.overrides}.get("")
    if whole is None:
        return entry
    status: EntryStatus = "graded" if entry.status == "ungradable" else entry.status
    return replace(entry, status=status, score=rounded(whole), penalty=0, final=rounded(whole))
