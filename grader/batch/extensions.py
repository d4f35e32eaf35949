"""`extensions.csv`: a later due date or slip days for students or sections."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timedelta, timezone

from grader.base.errors import UsageError
from grader.base.plain_text import one_line
from grader.batch.dates import instant_in
from grader.batch.find_student import StudentIndex
from grader.batch.given_files import GivenFile
from grader.batch.instructor_csv import did_you_mean
from grader.batch.model import Grant, Student
from grader.batch.student_csv import StudentCsv, sections
from grader.batch.words import local_instant
from grader.course.policy import Policy

WHAT = "the list of extensions"
OWN = {
    "due": (
        *("due", "due date", "new due", "new due date", "extended until", "extension until"),
        *("until", "마감", "마감일", "새 마감", "새 마감일", "연장 마감", "연장 마감일"),
    ),
    "days": (
        *("days", "extra days", "extension days", "extension (days)", "days of extension"),
        *("연장 일수", "일수", "연장일"),
    ),
    "slip days": ("slip days", "slip", "late days", "slip day", "유예 일수", "지각 허용 일수"),
    "assignment": ("assignment", "assignment id", "lesson", "과제"),
}
DAYS = re.compile(r"(\d+(?:[.,]\d+)?)\s*(?:d|days?|일)?", re.IGNORECASE)
HOURS = re.compile(r"(\d+(?:[.,]\d+)?)\s*(?:h|hours?|시간)", re.IGNORECASE)
MOST_DAYS = 366.0


@dataclass(frozen=True)
class Extensions:
    """What each student was granted, by key, and notes for the instructor."""

    grants: dict[str, Grant]
    notes: tuple[str, ...] = ()


def read_extensions(
    given: GivenFile,
    students: Sequence[Student],
    policy: Policy,
    assignment: str,
    *,
    on_roster: bool,
) -> Extensions:
    """Read the list for a class; a student's own row counts before that of the section.

    Rows of other assignments are not read. Raises UsageError with the lines that name an unknown
    student or section, or grant nothing that can be read. Without a roster (`on_roster`), a student
    who is not known may not have handed in yet: that is only noted.
    """
    table = StudentCsv(given, WHAT, OWN, StudentIndex(students))
    table.require("due", "days", "slip days")
    of_section = sections(students)
    known: dict[int, Grant] = {}
    common: dict[int, Grant] = {}
    lines: dict[object, int] = {}
    for row in table.rows():
        other = table.cell(row, "assignment")
        if other and other.casefold() != assignment.casefold():
            continue
        try:
            grant = _grant(table, row, policy)
            if table.names_student(row):
                found, who = known, [_student(table, row, on_roster=on_roster)]
            else:
                found, who = common, _section(table.cell(row, "section"), of_section)
            same = tuple(who)
            if None in who:
                continue
            if same in lines:
                other_line = table.file.line(lines[same])
                raise UsageError(f"line {other_line} is about the same students")
            lines[same] = row
            found.update({place: grant for place in who if place is not None})
        except UsageError as error:
            table.error(row, error)
    table.raise_errors()
    grants = {students[place].key: grant for place, grant in {**common, **known}.items()}
    return Extensions(grants, tuple(table.notes))


def _student(table: StudentCsv, row: int, *, on_roster: bool) -> int | None:
    try:
        return table.student(row)
    except UsageError as error:
        if on_roster or not error.message.startswith("there is no student"):
            raise
        table.notes.append(f"{table.file.place(row)}: {error.message} with a submission")
        return None


def _section(name: str, known: dict[str, list[int]]) -> list[int | None]:
    if not name:
        raise UsageError("it names neither a student nor a section")
    if name.casefold() not in known:
        words = ", ".join(known) or "none"
        near = did_you_mean(name.casefold(), known) or f" (known: {one_line(words, most=200)})"
        raise UsageError(f"there is no section '{one_line(name, most=60)}' on the roster{near}")
    return [*known[name.casefold()]]


def _grant(table: StudentCsv, row: int, policy: Policy) -> Grant:
    due, days = table.cell(row, "due"), table.cell(row, "days")
    slip = table.cell(row, "slip days")
    if policy.deadline is None:
        raise UsageError("the assignment has no due date (policy: due), so nothing can be extended")
    if due and days:
        raise UsageError("it has a due date and a number of days: keep one")
    if not (due or days or slip):
        raise UsageError("it grants nothing: give a new due date, a number of days, or slip days")
    grant = Grant(slip_days=_whole(slip) if slip else 0)
    if due:
        until = instant_in(due, policy.zone, end_of_day=True)
    elif days:
        until = _later(policy.deadline, _days(days), policy)
    else:
        return grant
    if until < policy.deadline:
        raise UsageError(
            f"'{due}' is before the due date, {local_instant(policy.deadline, policy.zone)}"
        )
    return replace(grant, until=until)


def _later(deadline: datetime, days: float, policy: Policy) -> datetime:
    """Return the due date so many days later, at the same time of day if they are whole days."""
    local = deadline if policy.zone is None else deadline.astimezone(policy.zone)
    whole, rest = math.floor(days), days - math.floor(days)
    return (local + timedelta(days=whole)).astimezone(timezone.utc) + timedelta(days=rest)


def _days(text: str) -> float:
    for form, each in ((DAYS, 1.0), (HOURS, 24.0)):
        match = form.fullmatch(text)
        if match is not None and float(match[1].replace(",", ".")) / each <= MOST_DAYS:
            return float(match[1].replace(",", ".")) / each
    raise UsageError(f"'{one_line(text, most=40)}' is not a number of days from 0 to 366")


def _whole(text: str) -> int:
    match = DAYS.fullmatch(text)
    number = float(match[1].replace(",", ".")) if match else -1
    if not 0 <= number <= MOST_DAYS or number != int(number):
        raise UsageError(f"'{one_line(text, most=40)}' is not a whole number of slip days")
    return int(number)
