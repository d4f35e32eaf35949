"""Brightspace: its download, and its grades export."""

from __future__ import annotations

from collections.abc import Sequence

from grader.base.i18n.message import say
from grader.batch.sheet import Sheet
from grader.batch.systems.brightspace import read
from grader.batch.systems.system import (
    Columns,
    Download,
    OpenSheet,
    RosterForm,
    RosterKey,
    SheetForm,
    System,
)
from grader.course.assignment import Assignment


def _roster_key(_sheet: Sheet, header: Sequence[str]) -> RosterKey | None:
    return RosterKey(None) if "orgdefinedid" in header else None


def _grades(content: bytes, columns: Columns, assignment: Assignment) -> OpenSheet:
    # imports the roster, which imports all systems
    from grader.batch.systems.brightspace.grades import read_grades  # noqa: PLC0415

    names = (assignment.title, assignment.id)
    return read_grades(content, column=columns["brightspace_column"], names=names)


SYSTEM = System(
    name="brightspace",
    title="Brightspace",
    priority=4,
    download=Download(say("Brightspace's download of all submissions"), read),
    roster=RosterForm(
        key=_roster_key,
        fields={"id number": ("orgdefinedid",)},
        is_header=frozenset({"orgdefinedid", "end-of-line indicator"}).__contains__,
    ),
    sheet=SheetForm(
        option="brightspace",
        help="Brightspace's grades export; writes a filled copy.",
        columns={"brightspace_column": "The item of Brightspace's export to fill."},
        output="brightspace-grades.csv",
        read=_grades,
    ),
)
