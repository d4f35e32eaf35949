"""What a class handed in, taken in: each attempt's hash, and the key of its verdict."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from grader.base.errors import UsageError
from grader.base.i18n.message import joined
from grader.batch.keys import verdict_key
from grader.batch.model import HandedIn
from grader.batch.work import Task
from grader.course.assignment import Assignment
from grader.package.submission import Submission, take_in


@dataclass(frozen=True)
class Item:
    """One attempt: `submission` is its hash and `key` its verdict's, "" if it cannot be taken in.

    `problem` says why it cannot, `fault` how our own side failed to.
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
) -> Iterator[Item]:
    """Take in every attempt, one in memory at a time; `seen` is shown each."""
    for attempt in handed_in:
        if attempt.problem:
            yield Item(attempt, problem=attempt.problem)
            continue
        try:
            submission = _take_in(attempt, assignment)
            seen(submission)
        except UsageError as error:  # one that cannot be read stops nobody else
            problem = joined(error.message, error.remedy, by="\n")
            yield Item(attempt, problem=problem)
            continue
        except Exception:  # nor does one on which we fail ourselves
            yield Item(attempt, fault=traceback.format_exc(limit=-6))
            continue
        yield Item(attempt, submission.sha256, verdict_key(submission.sha256, surroundings))


def tasks(items: Iterable[Item], assignment: Assignment, surroundings: str) -> Iterator[Task]:
    """Yield what is to be marked, taken in at the moment at which somebody is free for it.

    What has changed meanwhile is marked as it is now, under the key that it has now; what has gone
    meanwhile is left out.
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
            key=verdict_key(submission.sha256, surroundings),
            submission=submission,
        )


def _take_in(attempt: HandedIn, assignment: Assignment) -> Submission:
    return take_in(
        attempt.path,
        package=assignment.package,
        node_file=assignment.node_file,
        name=attempt.student.name or attempt.student.key,
        modes_kept=attempt.modes_kept,
    )
