"""The messages between a class run and its workers: jobs, tasks and answers, as lines of JSON.

A task carries the submission with its contents, so that a worker marks what was hashed, even if the
folder has changed in the meantime.
"""

from __future__ import annotations

import contextlib
import json
import time
import traceback
from collections.abc import Callable, Generator, Iterable
from dataclasses import asdict, dataclass, replace
from typing import TYPE_CHECKING, Protocol

from grader.base.errors import GraderError
from grader.base.i18n.message import joined
from grader.base.i18n.translator import Translator
from grader.base.unheard import unheard
from grader.course.assignment import Assignment
from grader.package.submission import Submission
from grader.package.submission_json import submission_from_json, submission_json
from grader.report.model import Report
from grader.ros.distro import find_distro
from grader.sandbox.limits import Limits
from grader.verdict.order import Order

if TYPE_CHECKING:  # (slow to import, and an unchanged class needs none of it)
    from grader.verdict.evidence_file import Judged
    from grader.verdict.recording import Recording

TRIES = 3  # at most, if the grader itself fails on a submission
ALONE_TRIES = (
    2  # of what is undecided: the last one at the end of the class, with nothing beside it
)
MARGIN_SECONDS = 60.0  # on top of a verdict's time limit, before its worker counts as hung


@dataclass(frozen=True)
class Job:
    """What is the same for all submissions of a class."""

    assignment: Assignment
    distro: str
    sandbox: str
    limits: Limits
    lang: str = "en"
    tries_fixes: bool = True

    @property
    def seconds(self) -> float:
        """The time (of a run's clock) after which the worker that marks a submission counts as hung."""
        return self.limits.verdict_seconds + MARGIN_SECONDS

    def to_text(self) -> str:
        """Return it as JSON on one line."""
        assignment = self.assignment.model_dump(mode="json", by_alias=True)
        rest = {"distro": self.distro, "sandbox": self.sandbox, "limits": asdict(self.limits)}
        own = self.assignment.own_checks
        how = {"lang": self.lang, "tries_fixes": self.tries_fixes}
        return json.dumps({"assignment": assignment, "own": own, **rest, **how})

    @classmethod
    def from_text(cls, text: str) -> Job:
        """Return what `to_text` wrote."""
        found = json.loads(text)
        assignment = Assignment.model_validate(found["assignment"])
        assignment = assignment.model_copy(update={"own_checks": found["own"]})
        limits = Limits(**found["limits"])
        tries_fixes = bool(found["tries_fixes"])
        return cls(
            assignment, found["distro"], found["sandbox"], limits, found["lang"], tries_fixes
        )


@dataclass(frozen=True)
class Task:
    """One submission to mark: its student, and the key that its verdict will have."""

    student: str
    name: str
    student_id: str
    key: str
    submission: Submission

    def to_text(self) -> str:
        """Return it as JSON on one line."""
        who = {"student": self.student, "name": self.name, "student_id": self.student_id}
        return json.dumps({**who, "key": self.key, "submission": submission_json(self.submission)})

    @classmethod
    def from_text(cls, text: str) -> Task:
        """Return what `to_text` wrote."""
        found = json.loads(text)
        return cls(**{**found, "submission": submission_from_json(found["submission"])})


@dataclass(frozen=True)
class Answer:
    """A report and its evidence, or why the grader failed; `seconds` is the time that it took."""

    report: Report | None = None
    fault: str = ""
    seconds: float = 0
    recording: Recording | None = None

    def to_text(self) -> str:
        """Return it as JSON on one line."""
        report = self.report.model_dump_json(by_alias=True) if self.report else None
        recording = _recording_text(self.recording)
        rest = {"fault": self.fault, "seconds": self.seconds, "recording": recording}
        return json.dumps({"report": report, **rest})

    @classmethod
    def from_text(cls, text: str) -> Answer:
        """Return what `to_text` wrote. Raises ValueError for anything else."""
        found = json.loads(text)
        try:
            report, fault, seconds = found["report"], str(found["fault"]), float(found["seconds"])
            recording = found["recording"]
        except (KeyError, TypeError) as error:
            raise ValueError("not an answer") from error
        return cls(
            Report.model_validate_json(report) if report else None,
            fault,
            seconds,
            _recording(recording),
        )

    @property
    def worth_retrying(self) -> bool:
        """Whether another try may yield more: the grader failed, or left checks inconclusive.

        A submission that ran into one of its limits would do so again: it is not retried.
        """
        if self.report is None:
            return True
        return self.report.inconclusive > 0 and not self.report.met_a_limit

    def better(self, other: Answer | None) -> Answer:
        """Return the answer that knows more, this one if both know the same."""
        if other is None or other.report is None:
            return self
        if self.report is None or other.report.inconclusive < self.report.inconclusive:
            return other
        return self


def _recording_text(recording: Recording | None) -> str | None:
    with contextlib.suppress(ValueError):  # evidence that cannot be written loses no verdict
        return recording.to_bytes().decode() if recording is not None else None
    return None


def _recording(text: str | None) -> Recording | None:
    from grader.verdict.recording import Recording, RecordingError  # noqa: PLC0415 - slow

    with contextlib.suppress(RecordingError):  # nor does evidence that cannot be read
        return Recording.from_bytes(text.encode()) if text else None
    return None


@dataclass(frozen=True)
class Done:
    """A finished task with its answer, and how many tries it took."""

    task: Task
    answer: Answer
    tries: int = 1


@dataclass(eq=False)
class Trial:
    """A task with its tries so far and the best answer.

    What the grader itself failed on is retried; what it left undecided too, alone. `most` is the time
    limit of one try in seconds: once failed tries together have taken longer, there is no further one.
    """

    task: Task
    most: float
    tries: int = 0
    spent: float = 0
    best: Answer | None = None

    @property
    def undecided(self) -> bool:
        """Whether it was marked and left checks undecided, as the machine's load can cause."""
        return self.best is not None and self.best.report is not None

    def add(self, answer: Answer) -> Done | None:
        """Count an answer; return the finished task, or None if it is to be tried again."""
        self.best = answer.better(self.best)
        self.spent += answer.seconds
        more = self.tries < ALONE_TRIES if self.undecided else self.spent <= self.most
        if self.best.worth_retrying and self.tries < TRIES and more:
            return None
        return Done(self.task, self._with_attempts(self.best), self.tries)

    def _with_attempts(self, best: Answer) -> Answer:
        """Return the answer with the number of tries in its report."""
        if best.report is None:
            return best
        return replace(best, report=best.report.model_copy(update={"attempts": self.tries}))


class Pool(Protocol):
    """Marks many submissions at once."""

    def run(
        self, tasks: Iterable[Task], *, started: Callable[[Task], None]
    ) -> Generator[Done, None, None]:
        """Mark the tasks and yield each when it is done; a task is taken once it can start.

        Closing the generator ends everything that was started.
        """
        ...

    def prove(self) -> None:
        """Raise SurroundingsError if the sandbox fails without any submission."""
        ...


def mark_task(job: Job, task: Task) -> Answer:
    """Mark one submission in this process; a failure of the grader is part of the answer."""
    from grader.verdict import mark  # noqa: PLC0415 - slow, for workers only

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
        tries_fixes=job.tries_fixes,
    )
    report, fault = None, ""
    kept: list[Judged] = []
    try:
        # no progress of single verdicts: many run at once
        report = mark.mark(submission, order, unheard, keep=kept.append)
    except GraderError as error:
        fault = Translator(job.lang)(joined(error.message, error.remedy, by="\n"))
    except Exception:  # a failure of the grader must not stop the other submissions
        fault = traceback.format_exc(limit=-6)
    recording = kept[0].recording if kept else None
    return Answer(report, fault, time.monotonic() - begin, recording)
