"""Moodle: its download, its worksheet and its gradebook import."""

# the modules are imported when needed: --help must not pay for them
# ruff: noqa: PLC0415

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING

from grader.batch.systems.system import (
    Columns,
    NewGradebook,
    OpenSheet,
    Reader,
    RosterForm,
    RosterKey,
    SheetForm,
    System,
)

if TYPE_CHECKING:
    from grader.batch.model import ClassResult, Comment
    from grader.batch.sheet import Filled, Sheet
    from grader.course.assignment import Assignment


def _reader() -> Reader:
    from grader.batch.systems.moodle import read

    return read


def _roster_key(sheet: Sheet, header: Sequence[str]) -> RosterKey | None:
    from grader.batch.systems.moodle.roster import identifier_column

    column = identifier_column(sheet, header)
    return None if column is None else RosterKey(column)


def _number(cell: str) -> str:
    from grader.batch.systems.moodle.roster import participant

    return participant(cell)


def _fields() -> Mapping[str, Collection[str]]:
    from grader.batch.systems.moodle.roster import FIELDS

    return FIELDS


def _is_header(name: str) -> bool:
    from grader.batch.systems.moodle.roster import is_header

    return is_header(name)


def _evidence(cells: Mapping[str, str]) -> str:
    from grader.batch.systems.moodle.roster import evidence

    return evidence(cells)


def _worksheet(content: bytes, columns: Columns, assignment: Assignment) -> OpenSheet:
    from grader.batch.systems.moodle.worksheet import read_worksheet

    return read_worksheet(
        content,
        grade_column=columns["grade_column"],
        feedback_column=columns["feedback_column"],
        max_score=assignment.max_score,
    )


def _import_file(result: ClassResult, comment: Comment, _columns: Columns) -> Filled:
    from grader.batch.systems.moodle.gradebook_import import moodle_import

    return moodle_import(result, comment)


SYSTEM = System(
    name="moodle",
    title="Moodle",
    priority=3,
    download="Moodle's download of all submissions",
    reader=_reader,
    numbered=True,
    group_folders=True,
    roster=RosterForm(
        key=_roster_key,
        number=_number,
        fields=_fields,
        is_header=_is_header,
        evidence=_evidence,
    ),
    sheet=SheetForm(
        option="worksheet",
        help="Moodle's grading worksheet; writes a filled copy.",
        columns={
            "grade_column": "The worksheet's column for grades.",
            "feedback_column": "The worksheet's column for feedback.",
        },
        output="moodle-worksheet.csv",
        is_detailed=True,
        read=_worksheet,
    ),
    gradebook=NewGradebook(output="moodle-gradebook.csv", write=_import_file),
)
