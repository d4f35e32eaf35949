"""What goes to whoever marks, and what comes back: text, so that any machine may do it.

The submission goes as it was taken in, with its contents: what is marked is what was hashed, also
where the folder has changed meanwhile.
"""

from __future__ import annotations

import json
import time
import traceback
from collections.abc import Callable, Generator, Iterable
from dataclasses import asdict, dataclass
from typing import Protocol

from grader.base.errors import GraderError
from grader.base.i18n.message import joined
from grader.base.i18n.translator import Translator
from grader.base.unheard import unheard
from grader.batch.submission_text import from_text, to_text
from grader.course.assignment import Assignment
from grader.package.submission import Submission
from grader.report.model import Report
from grader.ros.distro import find_distro
from grader.sandbox.limits import Limits
from grader.verdict.mark import mark
from grader.verdict.order import Order

TRIES = 3  # how often a submission is marked where our own side fails
MARGIN_SECONDS = 60.0  # beyond a verdict's ceiling, before its worker counts as hung


@dataclass(frozen=True)
class Job:
    """What is the same for a whole class."""

    assignment: Assignment
    distro: str
    sandbox: str
    limits: Limits
    lang: str = "en"

    @property
    def seconds(self) -> float:
        """Wall time in which one submission is done, whatever it does, or its worker hangs."""
        return self.limits.verdict_seconds + MARGIN_SECONDS

    def to_text(self) -> str:
        """Return it as JSON on one line."""
        assignment = self.assignment.model_dump(mode="json", by_alias=True)
        rest = {"distro": self.distro, "sandbox": self.sandbox, "limits": asdict(self.limits)}
        return json.dumps({"assignment": assignment, **rest, "lang": self.lang})

    @classmethod
    def from_text(cls, text: str) -> Job:
        """Return what `to_text` wrote."""
        found = json.loads(text)
        assignment = Assignment.model_validate(found["assignment"])
        limits = Limits(**found["limits"])
        return cls(assignment, found["distro"], found["sandbox"], limits, found["lang"])


@dataclass(frozen=True)
class Task:
    """One submission to mark: whose it is, and the key that its verdict will have."""

    student: str
    name: str
    student_id: str
    key: str
    submission: Submission

    def to_text(self) -> str:
        """Return it as JSON on one line."""
        who = {"student": self.student, "name": self.name, "student_id": self.student_id}
        return json.dumps({**who, "key": self.key, "submission": to_text(self.submission)})

    @classmethod
    def from_text(cls, text: str) -> Task:
        """Return what `to_text` wrote."""
        found = json.loads(text)
        return cls(**{**found, "submission": from_text(found["submission"])})


@dataclass(frozen=True)
class Answer:
    """A report, or the reason why our own side failed to make one; `seconds` is what it took."""

    report: Report | None = None
    fault: str = ""
    seconds: float = 0

    def to_text(self) -> str:
        """Return it as JSON on one line."""
        report = self.report.model_dump_json(by_alias=True) if self.report else None
        return json.dumps({"report": report, "fault": self.fault, "seconds": self.seconds})

    @classmethod
    def from_text(cls, text: str) -> Answer:
        """Return what `to_text` wrote. Raises ValueError for anything else."""
        found = json.loads(text)
        try:
            report, fault, seconds = found["report"], str(found["fault"]), float(found["seconds"])
        except (KeyError, TypeError) as error:
            raise ValueError("this is no answer") from error
        return cls(Report.model_validate_json(report) if report else None, fault, seconds)

    @property
    def doubtful(self) -> bool:
        """Whether another try may know more: our side failed, or kept points from being known.

        What met a limit of its own meets it again: that was the submission, and not our side.
        """
        if self.report is None:
            return True
        return self.report.inconclusive > 0 and not self.report.met_a_limit

    def better(self, other: Answer | None) -> Answer:
        """Return which of two tries knows more: this one unless the other does."""
        if other is None or other.report is None:
            return self
        if self.report is None or other.report.inconclusive < self.report.inconclusive:
            return other
        return self


@dataclass(frozen=True)
class Done:
    """A task with its answer, after so many tries."""

    task: Task
    answer: Answer
    tries: int = 1


class Pool(Protocol):
    """Whoever marks many submissions at once."""

    def run(
        self, tasks: Iterable[Task], *, started: Callable[[Task], None]
    ) -> Generator[Done, None, None]:
        """Mark them and yield each when it is done; tasks are taken as they can be begun.

        Closing the generator ends everything that was started.
        """
        ...

    def prove(self) -> None:
        """Raise SurroundingsError if it is our side that fails, and not the submissions."""
        ...


def answer(job: Job, task: Task) -> Answer:
    """Mark one submission here; whatever goes wrong on our side is in the answer."""
    submission = task.submission
    begin = time.monotonic()
    order = Order(
        path=submission.path,
        assignment=job.assignment,
        distro=find_distro(job.distro),
        sandbox=job.sandbox,
        name=task.name,
        limits=job.limits,
        student_id=task.student_id,
        lang=job.lang,
    )
    report, fault = None, ""
    try:
        # the steps of one verdict are not reported: many run at once
        report = mark(submission, order, unheard)
    except GraderError as error:
        fault = Translator(job.lang)(joined(error.message, error.remedy, by="\n"))
    except Exception:  # a fault of ours must cost nobody but this one submission
        fault = traceback.format_exc(limit=-6)
    return Answer(report, fault, time.monotonic() - begin)
