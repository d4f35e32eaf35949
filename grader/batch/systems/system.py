"""What a learning management system is: the record `SYSTEM` of each folder beside this module."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from grader.batch.match import Match
    from grader.batch.model import ClassResult, Comment, Elsewhere, GradebookEntry, Student
    from grader.batch.roster import Roster
    from grader.batch.sheet import Filled, Sheet
    from grader.batch.systems.feedback_zip import PageOf
    from grader.batch.systems.layout import Layout, Read, Reading
    from grader.batch.times import Times
    from grader.course.assignment import Assignment
    from grader.report.model import Report

ReportForm = Callable[["Report", bool], str]
"""Returns a report in a system's form; the second argument: name the hidden checks."""
Columns = Mapping[str, str]
"""The names of columns that the instructor gave, by option (`grade_column`); "" if not given."""


class Reader(Protocol):
    """The module `read` of a system: reads its download of all submissions."""

    def recognise(self, layout: Layout) -> bool:
        """Whether a folder looks like a download of this system."""

    def read(self, layout: Layout, reading: Reading) -> Read:
        """Return the submissions, and the items that do not look like this system's."""


class OpenSheet(Protocol):
    """A file of the instructor's that was read: it gets the grades of a class."""

    @property
    def roster(self) -> Roster:
        """The students in the file."""

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes about the file for the instructor."""

    def match(self, students: Sequence[Student], system: System) -> Match:
        """Return the roster line of each student, by key."""

    def elsewhere(self, students: Sequence[Student], system: System) -> dict[str, Elsewhere]:
        """Return the students whose submission or grade is in the file, by key."""

    def existing(self, result: ClassResult) -> list[tuple[GradebookEntry, str]]:
        """Return the entries that are filled in, each with the cell of its grade as it is."""

    def filled(self, result: ClassResult, comment: Comment) -> Filled:
        """Return a copy of the file with the grades filled in."""


@dataclass(frozen=True, kw_only=True)
class SheetForm:
    """A file that a system exports and imports again: `grade-all --<option> FILE` fills in a copy.

    `columns` are further options, each the name of a column, with their help. `output` is the name
    of the filled copy. `is_detailed`: its roster shows who submitted.
    """

    option: str
    help: str
    columns: Mapping[str, str] = field(default_factory=dict)
    output: str
    is_detailed: bool = False
    read: Callable[[bytes, Columns, Assignment], OpenSheet]


@dataclass(frozen=True, kw_only=True)
class NewGradebook:
    """A file that is written for a class of the system without a file of the instructor's."""

    output: str
    write: Callable[[ClassResult, Comment, Columns], Filled]


@dataclass(frozen=True, kw_only=True)
class FeedbackForm:
    """A zip of feedback files that the system gives to its students."""

    output: str
    write: Callable[[ClassResult, PageOf], Filled]


@dataclass(frozen=True)
class RosterKey:
    """The column of a system's own identifier in a roster that it exported; None: it has none."""

    column: int | None


def _none(_cells: Mapping[str, str]) -> str:
    return ""


@dataclass(frozen=True, kw_only=True)
class RosterForm:
    """How a list of students that a system exported is recognised and read.

    `key` returns the key's column if a sheet with this folded header is the system's. `number`
    returns the identifier in a key's cell; `is_identity`: that is an email address or an id number.
    `numbers_groups`: the list names the system's groups, which have numbers as participants have.
    `fields` are further columns by their headers, from which `evidence` says which submission or
    grade of a student the system has ("" if none), and `times` when it was handed in. `is_header`: whether a folded header is one of
    the system's.
    """

    key: Callable[[Sheet, Sequence[str]], RosterKey | None]
    number: Callable[[str], str] = str
    is_identity: bool = False
    numbers_groups: bool = False
    fields: Mapping[str, Collection[str]] = field(default_factory=dict)
    is_header: Callable[[str], bool] = frozenset[str]().__contains__
    evidence: Callable[[Mapping[str, str]], str] = _none
    times: Callable[[Mapping[str, str]], Times] | None = None


@dataclass(frozen=True)
class Download:
    """What `grade-all` reads from a system: `title` describes it, `reader` reads it."""

    title: str
    reader: Reader


@dataclass(frozen=True, kw_only=True)
class System:
    """A learning management system; its folder has the same name as it.

    `title` names it on pages. `download` is what `grade-all` reads from it (None: nothing). Of
    several systems that recognise a folder or a roster, the one with the highest `priority` is
    taken. `numbered`: the download and the roster have the same
    number for a student. `group_folders`: the download has one folder for each group. `usernames`:
    its folders end with the username. `keeps_modes`: exec bits survive. `sheet` and `gradebook` are
    the files for grades, `feedback` a zip for the students, `reports` the forms of one report by the word for `grader convert`.
    """

    name: str
    title: str
    priority: int = 0
    download: Download | None = None
    numbered: bool = False
    group_folders: bool = False
    usernames: bool = False
    keeps_modes: bool = False
    roster: RosterForm | None = None
    sheet: SheetForm | None = None
    gradebook: NewGradebook | None = None
    feedback: FeedbackForm | None = None
    reports: Mapping[str, ReportForm] = field(default_factory=dict)
