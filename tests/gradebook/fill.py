"""Read and fill in an instructor's file in one step."""

from __future__ import annotations

from functools import partial

from grader.batch.model import ClassResult
from grader.batch.sheet import Filled
from grader.batch.systems.canvas.write import read_gradebook
from grader.batch.systems.moodle.worksheet import read_worksheet
from grader.publish.feedback import short_html

comment = partial(short_html, show_hidden=False)


def fill_worksheet(
    content: bytes, result: ClassResult, *, grade_column: str = "", feedback_column: str = ""
) -> Filled:
    sheet = read_worksheet(content, grade_column=grade_column, feedback_column=feedback_column)
    return sheet.filled(result, comment)


def fill_gradebook(content: bytes, result: ClassResult, *, column: str = "") -> Filled:
    names = (result.title, result.assignment)
    return read_gradebook(content, column=column, names=names).filled(result, comment)
