"""Canvas: its download and its gradebook."""

from __future__ import annotations

from collections.abc import Sequence

from grader.base.i18n.message import say
from grader.batch.model import ClassResult, Comment
from grader.batch.sheet import Filled, Sheet
from grader.batch.systems.canvas import feedback, read
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

OUTPUT = "canvas-gradebook.csv"


def _roster_key(_sheet: Sheet, header: Sequence[str]) -> RosterKey | None:
    split = header[:2] == ["lastname", "firstname"]
    if (header[:1] == ["student"] or split) and "id" in header and "section" in header:
        return RosterKey(header.index("id"))
    return None


def _gradebook(content: bytes, columns: Columns, assignment: Assignment) -> OpenSheet:
    # imports the roster, which imports all systems
    from grader.batch.systems.canvas.write import read_gradebook  # noqa: PLC0415

    names = (assignment.title, assignment.id)
    return read_gradebook(content, column=columns["canvas_column"], names=names)


def _new_gradebook(result: ClassResult, _comment: Comment, columns: Columns) -> Filled:
    from grader.batch.systems.canvas.write import new_gradebook  # noqa: PLC0415

    return Filled(new_gradebook(result, title=columns["canvas_column"]))


SYSTEM = System(
    name="canvas",
    title="Canvas",
    priority=2,
    download=Download(say("Canvas' download of all submissions"), read),
    numbered=True,
    roster=RosterForm(key=_roster_key),
    sheet=SheetForm(
        option="canvas",
        help="Canvas' gradebook CSV; writes a filled copy.",
        columns={"canvas_column": "The column of Canvas' gradebook to fill."},
        output=OUTPUT,
        read=_gradebook,
    ),
    gradebook=NewGradebook(output=OUTPUT, write=_new_gradebook),
    feedback=FeedbackForm(output=feedback.OUTPUT, write=feedback.write),
)
