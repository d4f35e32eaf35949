"""What a student's attempts come to: lateness, penalty, which attempt counts, corrections.

All of it is a pure function of the submission's own time stamps, of the verdicts and of the
assignment's policy; nothing here reads a clock.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime

from grader.base.i18n.message import joined, say
from grader.batch.model import Elsewhere, Entry, Override, Student
from grader.batch.points import marks, rounded
from grader.course.policy import Policy, amount
from grader.report.model import Report

DAY, HOUR = 86_400.0, 3_600.0
UNKNOWN_TIME = say("it is not known when it was handed in: nothing was taken for lateness")
OUR_FAULT = say(
    "Not marked: the grader failed on this submission. That is no fault of yours, and your "
    "instructor knows of it."
)
CALLED_LATE = say("the course's system calls it late")


@dataclass(frozen=True)
class Attempt:
    """One thing that a student handed in, and the verdict on it if there is one.

    `problem` says why there is none and never will be as it is, `fault` how our own side failed;
    without any of them it waits for its turn. `late` is the course system's own word.
    """

    number: int
    submitted: datetime | None
    late: bool | None
    report: Report | None
    problem: str = ""
    notes: tuple[str, ...] = ()
    fault: str = ""


def lateness(submitted: datetime | None, policy: Policy) -> float | None:
    """Return how many seconds late it is: 0 up to the end of the grace time, then since the due
    date. None where there is a due date and nobody knows when it was handed in.
    """
    due = policy.deadline
    if due is None:
        return 0
    if submitted is None:
        return None
    late = (submitted - due).total_seconds()
    return late if late > policy.grace_seconds else 0


def penalty(score: float, max_score: float, submitted: datetime | None, policy: Policy) -> float:
    """Return the points that lateness takes from a score: each begun day (hour) counts whole.

    Never more than the score, nor than the policy's `most`; all of it from `until` on.
    """
    late = lateness(submitted, policy)
    if not late or submitted is None:
        return 0
    if policy.end is not None and submitted >= policy.end:
        return score
    rules = policy.late
    each, unit = (rules.per_day, DAY) if rules.per_day else (rules.per_hour, HOUR)
    taken = (amount(each, max_score) or 0) * math.ceil(late / unit)
    most = amount(rules.most, max_score)
    return rounded(max(0, min(taken, max_score if most is None else most, score)))


def standing(
    student: Student,
    attempts: Sequence[Attempt],
    overrides: Sequence[Override],
    policy: Policy,
    max_score: float,
    *,
    elsewhere: Elsewhere | None = None,
) -> Entry:
    """Return what a student gets. `attempts` are in the order in which they were handed in.

    A correction of a check counts before lateness takes its share; one of the total is the last
    word. Who is known to have handed in `elsewhere` keeps what he or she has, whatever the policy
    says about those who handed in nothing.
    """
    if not attempts:
        entry = _without_attempt(student, policy, max_score, elsewhere)
        return _corrected(replace(entry, overrides=tuple(overrides)))
    rated = [_rate(student, attempt, overrides, policy, max_score) for attempt in attempts]
    entry = rated[_chosen(rated, policy)]
    return _corrected(replace(entry, attempts=len(rated)))


def _without_attempt(
    student: Student, policy: Policy, max_score: float, elsewhere: Elsewhere | None
) -> Entry:
    if elsewhere is not None:
        return Entry(
            student,
            "elsewhere",
            final=elsewhere.final,
            max_score=max_score,
            notes=(elsewhere.reason,),
        )
    nothing = 0.0 if policy.missing == "zero" else None
    return Entry(student, "missing", final=nothing, max_score=max_score)


def _rate(
    student: Student,
    attempt: Attempt,
    overrides: Sequence[Override],
    policy: Policy,
    max_score: float,
) -> Entry:
    """Return what a student would get for this attempt, but for a correction of the total."""
    late = lateness(attempt.submitted, policy)
    notes = list(attempt.notes)
    if attempt.fault and attempt.report is None:
        notes.insert(0, f"the grader failed on it: {attempt.fault}")
    if late is None:
        notes.append(joined(UNKNOWN_TIME, CALLED_LATE if attempt.late else "", by="; "))
    entry = Entry(
        student,
        "ungradable" if attempt.problem else "pending",
        report=attempt.report,
        max_score=max_score,
        attempt=attempt.number,
        submitted=attempt.submitted,
        late_seconds=late or 0,
        problem=attempt.problem,
        notes=tuple(notes),
        overrides=tuple(overrides),
    )
    if attempt.fault and attempt.report is None:
        return replace(entry, status="error", problem=OUR_FAULT)
    if attempt.report is None:
        return entry
    if attempt.report.status == "error":
        problem = attempt.problem or attempt.report.message or OUR_FAULT
        return replace(entry, status="error", problem=problem)
    score = rounded(sum(mark.points or 0 for mark in marks(entry)))
    taken = penalty(score, max_score, attempt.submitted, policy)
    final = rounded(score - taken)
    return replace(entry, status="graded", score=score, penalty=taken, final=final)


def _chosen(rated: Sequence[Entry], policy: Policy) -> int:
    """Return which attempt counts; of two that are equally good it is the earlier one."""
    if policy.attempts == "last":
        return len(rated) - 1
    if policy.attempts == "first":
        return 0
    worth = [-1.0 if entry.final is None else entry.final for entry in rated]
    best = worth.index(max(worth))
    # where none has a verdict, the last one is what the instructor is shown
    return best if rated[best].final is not None else len(rated) - 1


def _corrected(entry: Entry) -> Entry:
    """Return the entry with the correction of its total, if there is one."""
    whole = {override.check: override.points for override in entry.overrides}.get("")
    if whole is None:
        return entry
    return replace(entry, score=rounded(whole), penalty=0, final=rounded(whole))
