"""Intake of a class: each attempt's hash, and the key of its verdict."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from grader.base.errors import UsageError
from grader.base.i18n.message import joined
from grader.batch.model import HandedIn
from grader.batch.verdict_key import verdict_key
from grader.batch.work import Task
from grader.course.assignment import Assignment
from grader.package.submission import Submission
from grader.verdict.take_in import take_in_for


@dataclass(frozen=True)
class IntakeItem:
    """One attempt: `submission` is its hash, `key` its verdict's; "" if intake failed.

    `problem` says why the attempt cannot be read, `fault` how the grader itself failed.
    """

    handed_in: HandedIn
    submission: str = ""
    key: str = ""
    problem: str = ""
    fault: str = ""

    @property
    def student(self) -> str:
        """The student's key in the class."""
        return self.handed_in.student.key


def take_in_class(
    handed_in: Iterable[HandedIn],
    assignment: Assignment,
    surroundings: str,
    *,
    seen: Callable[[Submission], None],
) -> Iterator[IntakeItem]:
    """Take in every attempt, one in memory at a time; `seen` is called with each."""
    for attempt in handed_in:
        if attempt.problem:
            yield IntakeItem(attempt, problem=attempt.problem)
            continue
        try:
            submission = _take_in(attempt, assignment)
            seen(submission)
        except UsageError as error:  # an unreadable attempt must not stop the others
            problem = joined(error.message, error.remedy, by="\n")
            yield IntakeItem(attempt, problem=problem)
            continue
        except Exception:  # nor must a failure of the grader
            yield IntakeItem(attempt, fault=traceback.format_exc(limit=-6))
            continue
        yield IntakeItem(attempt, submission.sha256, _key(submission, surroundings))


def tasks(items: Iterable[IntakeItem], assignment: Assignment, surroundings: str) -> Iterator[Task]:
    """Yield the tasks, each read from the disk when a worker is free for it.

    A submission that has changed since is marked as it is now, under its new key; one that is gone
    is left out.
    """
    for item in items:
        student = item.handed_in.student
        try:
            submission = _take_in(item.handed_in, assignment)
        except UsageError:
            continue
        yield Task(
            student=student.key,
            name=student.name,
            student_id=student.id_number or student.key,
            key=_key(submission, surroundings),
            submission=submission,
        )


def _key(submission: Submission, surroundings: str) -> str:
    """Return the key of a submission's verdict, which says too what to hand in next time."""
    return verdict_key(" ".join((submission.sha256, *submission.hints)), surroundings)


def _take_in(attempt: HandedIn, assignment: Assignment) -> Submission:
    return take_in_for(
        assignment,
        attempt.path,
        name=attempt.student.name or attempt.student.key,
        modes_kept=attempt.modes_kept,
    )
