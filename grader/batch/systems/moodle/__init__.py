"""Moodle: its download, its worksheet and its gradebook import."""

from __future__ import annotations

from collections.abc import Sequence

from grader.base.i18n.message import say
from grader.batch.model import ClassResult, Comment
from grader.batch.sheet import Filled, Sheet
from grader.batch.systems.moodle import feedback, read, roster, times
from grader.batch.systems.moodle.gradebook_import import moodle_import
from grader.batch.systems.system import (
    Columns,
    Download,
    FeedbackForm,
    NewGradebook,
    OpenSheet,
    RosterForm,
    RosterKey,
    SheetForm,
    System,
)
from grader.course.assignment import Assignment


def _roster_key(sheet: Sheet, header: Sequence[str]) -> RosterKey | None:
    column = roster.identifier_column(sheet, header)
    return None if column is None else RosterKey(column)


def _worksheet(content: bytes, columns: Columns, assignment: Assignment) -> OpenSheet:
    # imports the roster, which imports all systems
    from grader.batch.systems.moodle.worksheet import read_worksheet  # noqa: PLC0415

    return read_worksheet(
        content,
        grade_column=columns["grade_column"],
        feedback_column=columns["feedback_column"],
        max_score=assignment.max_score,
    )


def _import_file(result: ClassResult, comment: Comment, _columns: Columns) -> Filled:
    return moodle_import(result, comment)


SYSTEM = System(
    name="moodle",
    title="Moodle",
    priority=3,
    download=Download(say("Moodle's download of all submissions"), read),
    numbered=True,
    group_folders=True,
    roster=RosterForm(
        key=_roster_key,
        number=roster.participant,
        numbers_groups=True,
        fields=roster.FIELDS,
        is_header=roster.is_header,
        evidence=roster.evidence,
        times=times.times,
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
    feedback=FeedbackForm(output=feedback.OUTPUT, write=feedback.write),
)
