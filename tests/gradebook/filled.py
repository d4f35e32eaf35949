"""A teacher's file read and filled in, in one step."""

from __future__ import annotations

from grader.batch.model import ClassResult
from grader.batch.sheet import Filled
from grader.batch.systems.canvas.write import read_gradebook
from grader.batch.systems.moodle.worksheet import read_worksheet


def fill_worksheet(
    content: bytes, result: ClassResult, *, grade_column: str = "", feedback_column: str = ""
) -> Filled:
    sheet = read_worksheet(content, grade_column=grade_column, feedback_column=feedback_column)
    return sheet.filled(result)


def fill_gradebook(content: bytes, result: ClassResult, *, column: str = "") -> Filled:
    names = (result.title, result.assignment)
    return read_gradebook(content, column=column, names=names).filled(result)
