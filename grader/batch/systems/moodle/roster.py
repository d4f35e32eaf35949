"""Moodle's worksheet as a list of students: its identifiers, and what Moodle knows of each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from grader.base.i18n.message import say
from grader.base.plain_text import one_line
from grader.batch.roster_guess import PARTICIPANT, PEEKED
from grader.batch.sheet import Sheet, folded_header
from grader.batch.systems.moodle.words import (
    FEEDBACK,
    GRADE,
    IDENTIFIER,
    MAXIMUM,
    STATUS,
    SUBMITTED_ON,
    says_submitted,
)
from grader.batch.words import has_grade

FIELDS: Mapping[str, frozenset[str]] = {
    "status": STATUS,
    "submitted on": SUBMITTED_ON,
    "grade": GRADE,
}
IDENTIFIERS = frozenset(map(folded_header, IDENTIFIER))
HEADERS = frozenset(
    folded_header(name)
    for names in (GRADE, FEEDBACK, IDENTIFIER, STATUS, SUBMITTED_ON)
    for name in names
)


def is_header(name: str) -> bool:
    """Whether a folded header is one of Moodle's."""
    return name in HEADERS or MAXIMUM.search(name) is not None


def identifier_column(sheet: Sheet, header: Sequence[str]) -> int | None:
    """Return the column of `Participant 123`; None if the sheet is not Moodle's."""
    for index, name in enumerate(header):
        values = [value for value in sheet.column(index)[:PEEKED] if value]
        if name in IDENTIFIERS and values and all(PARTICIPANT.fullmatch(v) for v in values):
            # (`student 1`, `student 2` below another header are somebody's own numbers)
            return index
    return None


def participant(text: str) -> str:
    """Return the number in `Participant 123`, "" if there is none."""
    match = PARTICIPANT.fullmatch(text)
    return match[2] if match else ""


def evidence(cells: Mapping[str, str]) -> str:
    """Return which submission or grade of a student Moodle knows, in words; "" if none."""
    grade = cells["grade"]
    if grade not in ("", "-"):
        return has_grade("Moodle", grade)
    status = cells["status"]
    if not says_submitted(status, cells["submitted on"]):
        return ""
    said = one_line(status, most=80) or "submitted"
    return say("Moodle's worksheet says '{status}'", status=said)
