"""Reads the instructor's worksheet and gradebook before the marking, and finds their columns."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from grader.base.errors import UsageError
from grader.batch.model import ClassResult, Elsewhere, OnRoster, Student, System
from grader.course.assignment import Assignment

if TYPE_CHECKING:
    from grader.batch.lowered import Lowered
    from grader.batch.roster import Roster
    from grader.batch.systems.canvas.write import CanvasGradebook
    from grader.batch.systems.moodle.worksheet import Worksheet

MOST_INPUT = 50_000_000  # bytes of one file


@dataclass(frozen=True)
class SheetOptions:
    """The instructor's files that are filled in, and the names of their columns."""

    worksheet: Path | None = None
    canvas: Path | None = None
    canvas_column: str = ""
    grade_column: str = ""
    feedback_column: str = ""
    show_hidden: bool = False


@dataclass(frozen=True)
class OpenSheets:
    """The files as read before the marking; `digest` is the hash of their contents."""

    worksheet: Worksheet | None = None
    canvas: CanvasGradebook | None = None
    digest: str = ""

    @property
    def rosters(self) -> list[Roster]:
        """The rosters in the files, the more detailed one first."""
        return [sheet.roster for sheet in self._sheets]

    @property
    def notes(self) -> list[str]:
        """Notes about the files for the instructor."""
        return [note for sheet in self._sheets for note in sheet.notes]

    def elsewhere(self, students: Sequence[Student], system: System) -> dict[str, Elsewhere]:
        """Return the students whose submission or grade is in a file, by key."""
        found: dict[str, Elsewhere] = {}
        for sheet in self._sheets:
            found |= sheet.elsewhere(students, system)
        return found

    def lowered(self, result: ClassResult) -> list[Lowered]:
        """Return the grades in the files that would go down."""
        return [one for sheet in self._sheets for one in sheet.lowered(result)]

    def covered(self, students: Sequence[Student], system: System) -> Iterator[OnRoster]:
        """Yield for each file how many of the students have a row in it."""
        for sheet in self._sheets:
            rows = sheet.match(students, system).rows
            strangers = tuple(one.name for one in students if one.key not in rows)
            roster = sheet.roster
            yield OnRoster(roster.name, len(students), strangers, len(roster.lines))

    @property
    def _sheets(self) -> list[Worksheet | CanvasGradebook]:
        return [sheet for sheet in (self.worksheet, self.canvas) if sheet is not None]


def open_sheets(sheets: SheetOptions, assignment: Assignment) -> OpenSheets:
    """Read the files and find their columns; raise UsageError if one cannot be filled in."""
    # slow to import, and not needed by a class without these files
    from grader.batch.systems.canvas.write import read_gradebook  # noqa: PLC0415
    from grader.batch.systems.moodle.worksheet import read_worksheet  # noqa: PLC0415

    contents = [
        b"" if path is None else _content(path) for path in (sheets.worksheet, sheets.canvas)
    ]
    worksheet = canvas = None
    if sheets.worksheet is not None:
        worksheet = read_worksheet(
            contents[0],
            grade_column=sheets.grade_column,
            feedback_column=sheets.feedback_column,
            max_score=assignment.max_score,
        )
    if sheets.canvas is not None:
        names = (assignment.title, assignment.id)
        canvas = read_gradebook(contents[1], column=sheets.canvas_column, names=names)
    digest = hashlib.sha256(b"\0".join(hashlib.sha256(c).digest() for c in contents))
    return OpenSheets(worksheet, canvas, digest.hexdigest())


def _content(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            content = file.read(MOST_INPUT + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise UsageError(f"{path} cannot be read: {reason}") from None
    if len(content) > MOST_INPUT:
        raise UsageError(
            f"{path} is too large for a gradebook: more than {MOST_INPUT // 1_000_000} MB"
        )
    return content
