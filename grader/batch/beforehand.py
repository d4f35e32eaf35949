"""What is known before anything is marked: the teacher's files, the gradebook, and the class.

Whatever can be found wrong with them is told here, while it costs nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from pathlib import Path

from grader.base.plain_text import one_line
from grader.batch.accept import counted, refuse_poor_join
from grader.batch.discover import discover
from grader.batch.gradebook_before import Before, read_before
from grader.batch.model import ClassFolder
from grader.batch.sheets import OpenSheets, Sheets, open_sheets
from grader.course.assignment import Assignment

UNPACKED = "unpacked"
GRADEBOOK = "gradebook.csv"


@dataclass(frozen=True)
class Beforehand:
    """The class with its files; `before` is the gradebook of an earlier run."""

    folder: ClassFolder
    sheets: OpenSheets
    before: Before


def look_beforehand(
    path: Path,
    assignment: Assignment,
    sheets: Sheets,
    out: Path,
    *,
    system: str,
    roster: Path | None,
    accepts: Collection[str],
    notify: Callable[[str], None],
) -> Beforehand:
    """Read everything; UsageError for what cannot be used, and for a class that hardly fits.

    If no roster was named, the worksheet is the roster, else Canvas' gradebook.
    """
    opened = open_sheets(sheets, assignment)
    before = read_before(out / GRADEBOOK)
    for note in opened.notes:
        notify(f"  {one_line(note)}")
    rosters = [roster] if roster else opened.rosters
    found = discover(
        path,
        system=system,
        roster=rosters[0] if rosters else None,
        unpack=out / UNPACKED,
    )
    _say_found(found, notify)
    folder = _with_elsewhere(found, opened, before)
    students = {one.student.key: one.student for one in folder.handed_in}
    covered = list(opened.covered(list(students.values()), folder.system))
    refuse_poor_join(folder, covered, assignment.policy, accepts)
    return Beforehand(folder, opened, before)


def _with_elsewhere(folder: ClassFolder, opened: OpenSheets, before: Before) -> ClassFolder:
    """Return the class with what the files and the gradebook know of those who are missing."""
    elsewhere = {**opened.elsewhere(folder.missing, folder.system), **folder.elsewhere}
    for student in folder.missing:
        had = before.elsewhere(student)
        if had is not None:
            elsewhere[student.key] = replace(elsewhere.get(student.key, had), final=had.final)
    return replace(folder, elsewhere=elsewhere)


def _say_found(folder: ClassFolder, notify: Callable[[str], None]) -> None:
    students = {attempt.student.key for attempt in folder.handed_in}
    attempts = len(folder.handed_in)
    more = f" in {attempts} attempts" if attempts != len(students) else ""
    missing = f", {len(folder.missing)} without a submission" if folder.missing else ""
    notify(f"found {counted(len(students))}{more}{missing} ({folder.system})")
    for note in folder.notes:
        notify(f"  {one_line(note)}")
