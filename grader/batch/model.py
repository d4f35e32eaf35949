"""The data classes that the steps of a class run share: students, submissions, results.

Instants are aware datetimes (UTC). A `key` identifies one student within one class and never
changes: it is the system's own number (Moodle's participant id, Canvas' user id), or else the name
of the folder or archive.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Literal, overload

from grader.report.detail import Detail
from grader.report.feedback import with_feedback
from grader.report.model import Report

if TYPE_CHECKING:
    from grader.batch.systems.system import System

EntryStatus = Literal["graded", "ungradable", "error", "missing", "elsewhere", "unclear", "pending"]


@dataclass(frozen=True)
class Student:
    """A person (or team) in the class; what the learning management system does not say is ""."""

    key: str
    name: str
    email: str = ""
    username: str = ""
    id_number: str = ""
    section: str = ""


@dataclass(frozen=True)
class HandedIn:
    """One attempt of a student: `path` is a folder or an archive on this machine.

    `problem` says why it cannot be marked (a corrupt archive, for example); `unclear` why it is not
    known whose it is (nobody gets its grade); `notes` are for the instructor.

    `submitted` is the system's own time stamp, `late` and `late_seconds` its own statements (0: not
    late), `extension` the later due date that it granted; each is None if the system does not say.
    `modes_kept` is False if loose files lost their exec bits on the way (uploaded one by one, for
    example); `take_in` needs to know.
    """

    student: Student
    path: Path
    attempt: int = 1
    submitted: datetime | None = None
    late: bool | None = None
    late_seconds: float | None = None
    extension: datetime | None = None
    notes: tuple[str, ...] = ()
    problem: str = ""
    modes_kept: bool = True
    unclear: str = ""
    files: tuple[str, ...] = ()
    """The names of its files as they were downloaded, if the system wants them back."""

    @property
    def has_times(self) -> bool:
        """Whether it is known when it was handed in, or how late that was."""
        return (self.submitted, self.late_seconds, self.extension) != (None, None, None)


@dataclass(frozen=True)
class Elsewhere:
    """Why a student without a submission here is known to have handed in elsewhere.

    `final` are the points that the student already has, None if they are not known. `is_unclear`:
    a submission is here that may be this student's.
    """

    reason: str
    final: float | None = None
    is_unclear: bool = False


@dataclass(frozen=True)
class Grant:
    """What an instructor granted a student: a later due date (UTC), and slip days.

    A slip day is a day late without a penalty.
    """

    until: datetime | None = None
    slip_days: int = 0


@dataclass(frozen=True)
class OnRoster:
    """How well a class fits its roster: `strangers` are the names that are not on it."""

    roster: str
    submissions: int
    strangers: tuple[str, ...]
    lines: int


@dataclass(frozen=True)
class ClassFolder:
    """A class as it was downloaded: every attempt, and the roster's students without one.

    `elsewhere` are the missing students, by key, who are known to have handed in elsewhere.
    `unclear` says for each group of submissions and students why they were not joined.
    `on_list` has the word that identifies each student on the roster, by key; `left_out` are the
    files that the instructor leaves out, and `grants` what students were granted, by key.
    """

    system: System
    path: Path
    handed_in: tuple[HandedIn, ...]
    missing: tuple[Student, ...] = ()
    elsewhere: Mapping[str, Elsewhere] = field(default_factory=dict)
    on_roster: OnRoster | None = None
    notes: tuple[str, ...] = ()
    unclear: tuple[str, ...] = ()
    on_list: Mapping[str, str] = field(default_factory=dict)
    left_out: tuple[str, ...] = ()
    grants: Mapping[str, Grant] = field(default_factory=dict)


UNKNOWN = -1  # the verdict of a correction in the ledger of an earlier grader, if it is not certain


@dataclass(frozen=True)
class Override:
    """An instructor's correction of one verdict; `check` "" is the total.

    `verdict` is the id in the ledger, 0 if the student had no verdict, or UNKNOWN; `submission` the
    hash of what that verdict is about, "" if there is none.
    """

    student: str
    check: str
    points: float
    because: str
    by: str = ""
    at: datetime | None = None
    verdict: int = 0
    submission: str = ""


@dataclass(frozen=True)
class LapsedOverride:
    """A correction of another verdict than the one that counts now.

    `attempt` is the number of the attempt that it belongs to, 0 if there is no such attempt.
    """

    override: Override
    attempt: int = 0


@dataclass(frozen=True)
class Remark:
    """What an instructor wrote to a student about the submission with this hash ("": about none)."""

    student: str
    text: str
    by: str = ""
    at: datetime | None = None
    submission: str = ""


class LazyReport:
    """A field that holds a report, or a function that loads it on each access.

    The reports of thousands of students do not fit into memory.
    """

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = f"_{name}"

    @overload
    def __get__(self, entry: None, owner: type) -> None: ...
    @overload
    def __get__(self, entry: object, owner: type) -> Report | None: ...
    def __get__(self, entry: object | None, owner: type) -> Report | None:
        """Return the report, None if there is none (and on the class: the field's default)."""
        if entry is None:
            return None
        held: Report | Callable[[], Report] | None = entry.__dict__[self._name]
        return held() if callable(held) else held

    def __set__(self, entry: object, value: Report | Callable[[], Report] | None) -> None:
        entry.__dict__[self._name] = value


@dataclass(frozen=True)
class GradebookEntry:
    """What one student gets: the report that counts, and the points after policy and corrections.

    `score` is the report's score with overrides (None without a report); `penalty` the points taken
    for lateness, `late_seconds` is None if it is not known how late it is; `due` the student's own
    due date; `final` the grade for the gradebook, or None. None means: an ungradable submission
    waits for the instructor, one with `error` for the grader's next run. A missing submission
    follows the assignment's policy; a student who handed in elsewhere keeps the existing grade, and
    so does one whose submission may be here but is `unclear`, as that submission itself is.
    The student reads `problem`, only the instructor reads `notes`.
    """

    student: Student
    status: EntryStatus
    report: LazyReport = LazyReport()
    score: float | None = None
    penalty: float = 0
    final: float | None = None
    max_score: float = 100
    attempt: int = 1
    attempts: int = 1
    submitted: datetime | None = None
    late_seconds: float | None = 0
    due: datetime | None = None
    is_extended: bool = False
    """Whether `due` is later than that of the assignment."""
    slip_days: int = 0
    slip_days_used: int = 0
    problem: str = ""
    notes: tuple[str, ...] = ()
    overrides: tuple[Override, ...] = ()
    lapsed: tuple[LapsedOverride, ...] = ()
    """Corrections for the instructor to repeat or to remove: they count no longer."""
    remark: Remark | None = None
    """What the instructor wrote to the student about the submission that counts."""
    unmarked_later: tuple[str, ...] = ()
    """Why later attempts than the one that counts could not be marked."""
    same_as: tuple[str, ...] = ()
    """Keys of students with the same content, not all of them: see `ClassResult.identical`."""
    verdict: int | None = None
    """The id of the report's verdict in the ledger."""
    files: tuple[str, ...] = ()
    """The names of the submission's files as they were downloaded; see `HandedIn.files`."""
    lang: str = "en"
    """The language of the student's texts: the report's, if there is one."""
    detail: Detail | None = None
    """What the student gets to know of a failed check, if not the same as the class."""

    @property
    def by_hand(self) -> tuple[str, ...]:
        """Why the instructor must look at the submission by hand; () if that is not needed."""
        own = (self.problem,) if self.status == "ungradable" else ()
        return (*own, *self.unmarked_later)

    @property
    def is_lateness_open(self) -> bool:
        """Whether there is a due date, and it is not known how late the submission is."""
        return self.late_seconds is None and self.due is not None

    @property
    def keeps_grade(self) -> bool:
        """Whether no grade is written for the student, and one that exists elsewhere stays."""
        corrected = any(override.check == "" for override in self.overrides)
        return self.status in ("elsewhere", "unclear") and not corrected

    def for_student(self, detail: Detail, *, show_hidden: bool = False) -> GradebookEntry:
        """Return the entry with a report that a student may read (see `with_feedback`).

        `detail` is that of the class.
        """
        held = vars(self)["_report"]
        level = detail if self.detail is None else self.detail
        if held is None:
            return self

        def seen() -> Report:
            report: Report = held() if callable(held) else held
            return with_feedback(report, level, show_hidden=show_hidden)

        return replace(self, report=seen)


@dataclass(frozen=True)
class ClassResult:
    """The whole class in roster order; every output is a pure function of it."""

    title: str
    assignment: str
    system: System
    entries: tuple[GradebookEntry, ...]
    max_score: float
    distros: tuple[str, ...] = ()
    started: datetime | None = None
    seconds: float = 0
    notes: tuple[str, ...] = ()
    identical: tuple[tuple[str, ...], ...] = field(default=())
    """Groups of keys whose submissions are the same apart from white space and comments."""
    unclear: tuple[str, ...] = ()
    """Why submissions were not joined with students: one reason for each group of them."""
    detail: Detail = Detail.LINE
    """What students get to know of a failed check."""
    lang: str = "en"
    """The language of the class' pages."""

    def entry(self, key: str) -> GradebookEntry:
        """Return one student's entry; KeyError if there is no such student."""
        for entry in self.entries:
            if entry.student.key == key:
                return entry
        raise KeyError(key)


Comment = Callable[[GradebookEntry], str]
"""Writes the short feedback for one cell of a gradebook."""
