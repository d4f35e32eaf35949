"""What the rooms of a class run hand to each other: students, what they handed in, their results.

Instants are aware datetimes (UTC). A `key` names one student within one class and never changes:
the number that the course's system uses (Moodle's participant id, Canvas' user id), else the name
of the folder or archive.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from typing import Literal, overload

from grader.report.model import Report

System = Literal["folders", "archives", "moodle", "canvas", "gradescope", "github_classroom"]
EntryStatus = Literal["graded", "ungradable", "error", "missing", "elsewhere", "pending"]


@dataclass(frozen=True)
class Student:
    """One person (or team) of the class; what the course's system does not say is ""."""

    key: str
    name: str
    email: str = ""
    username: str = ""
    id_number: str = ""
    section: str = ""


@dataclass(frozen=True)
class HandedIn:
    """One attempt: `path` is a folder or an archive on this machine.

    `problem` says why there is nothing that could be marked (a corrupt archive, say); `notes` what
    the instructor should know. `submitted` is the course system's own time stamp, None if it does
    not tell; `late` is its own word on it. `modes_kept` is False where the way here lost the exec
    bits of loose files (an upload of file by file, say): `take_in` wants to know.
    """

    student: Student
    path: Path
    attempt: int = 1
    submitted: datetime | None = None
    late: bool | None = None
    notes: tuple[str, ...] = ()
    problem: str = ""
    modes_kept: bool = True


@dataclass(frozen=True)
class Elsewhere:
    """Why a student without a submission here is known to have handed in, in words.

    `final` are the points that he or she has already, None if that is not known.
    """

    reason: str
    final: float | None = None


@dataclass(frozen=True)
class OnRoster:
    """How well a class fits its roster: `strangers` are the names that are on no line of it."""

    roster: str
    submissions: int
    strangers: tuple[str, ...]
    lines: int


@dataclass(frozen=True)
class ClassFolder:
    """A class as it was downloaded: every attempt, and the roster's students without any.

    `elsewhere` are those of the missing, by key, who are known to have handed in all the same.
    """

    system: System
    path: Path
    handed_in: tuple[HandedIn, ...]
    missing: tuple[Student, ...] = ()
    elsewhere: Mapping[str, Elsewhere] = field(default_factory=dict)
    on_roster: OnRoster | None = None
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Override:
    """An instructor's correction: `check` "" corrects the total. It outlives reruns and regrades."""

    student: str
    check: str
    points: float
    because: str
    by: str = ""
    at: datetime | None = None


class Held:
    """A report, or what fetches it each time that it is asked for: those of thousands of students
    are too much to be kept in memory.
    """

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = f"_{name}"

    @overload
    def __get__(self, entry: None, owner: type) -> None: ...
    @overload
    def __get__(self, entry: object, owner: type) -> Report | None: ...
    def __get__(self, entry: object | None, owner: type) -> Report | None:
        """Return the report, None if there is none (and for the class, as the field's default)."""
        if entry is None:
            return None
        held: Report | Callable[[], Report] | None = entry.__dict__[self._name]
        return held() if callable(held) else held

    def __set__(self, entry: object, value: Report | Callable[[], Report] | None) -> None:
        entry.__dict__[self._name] = value


@dataclass(frozen=True)
class Entry:
    """What one student gets: the report that counts, and what was made of its score.

    `score` is the report's with overrides (None where there is none); `penalty` the points taken
    for lateness; `final` what goes into the gradebook, None if nothing does (an ungradable
    submission waits for the instructor, one with `error` for another try of the grader; a missing
    one follows the assignment's policy; a student whose submission is elsewhere, where the grader
    has not looked, keeps the grade that is there). `problem` is for the student, `notes` are not.
    """

    student: Student
    status: EntryStatus
    report: Held = Held()
    score: float | None = None
    penalty: float = 0
    final: float | None = None
    max_score: float = 100
    attempt: int = 1
    attempts: int = 1
    submitted: datetime | None = None
    late_seconds: float = 0
    problem: str = ""
    notes: tuple[str, ...] = ()
    overrides: tuple[Override, ...] = ()
    same_as: tuple[str, ...] = ()
    """Some of those with the same content; all are in the class' `identical`."""
    verdict: int | None = None
    """The number of the report's verdict in the ledger."""
    lang: str = "en"
    """The language of what the student reads: the report's, if there is one."""


@dataclass(frozen=True)
class ClassResult:
    """The whole class, in the order of the roster: what every output is a pure function of."""

    title: str
    assignment: str
    system: System
    entries: tuple[Entry, ...]
    max_score: float
    distros: tuple[str, ...] = ()
    started: datetime | None = None
    seconds: float = 0
    notes: tuple[str, ...] = ()
    identical: tuple[tuple[str, ...], ...] = field(default=())
    """Groups of keys whose submissions are the same once white space and comments are gone."""

    def entry(self, key: str) -> Entry:
        """Return one student's entry; KeyError if there is no such student."""
        for entry in self.entries:
            if entry.student.key == key:
                return entry
        raise KeyError(key)


Comment = Callable[[Entry], str]
"""Makes the short feedback that goes into one cell of a system's sheet."""
