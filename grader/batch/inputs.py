"""Reads the instructor's files, the earlier gradebook and the class before anything is marked.

Every error in them is reported here, before time is spent on marking.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from pathlib import Path

from grader.base.plain_text import one_line
from grader.batch.accept import counted, refuse_poor_join
from grader.batch.dated import with_times
from grader.batch.discover import discover
from grader.batch.earlier_gradebook import EarlierGradebook, read_earlier_gradebook
from grader.batch.model import ClassFolder
from grader.batch.sheets import OpenSheets, SheetOptions, open_sheets
from grader.course.assignment import Assignment

UNPACKED = "unpacked"
GRADEBOOK = "gradebook.csv"
MOST_WHY = 600  # characters


@dataclass(frozen=True)
class ClassInputs:
    """The class, the instructor's files, and the gradebook of an earlier run."""

    folder: ClassFolder
    sheets: OpenSheets
    gradebook: EarlierGradebook


def read_inputs(
    path: Path,
    assignment: Assignment,
    sheets: SheetOptions,
    out: Path,
    *,
    system: str,
    roster: Path | None,
    accepts: Collection[str],
    notify: Callable[[str], None],
) -> ClassInputs:
    """Read everything; raise UsageError if a file cannot be used or the class does not fit.

    Without `roster` the worksheet is the roster, or else Canvas' gradebook.
    """
    opened = open_sheets(sheets, assignment)
    gradebook = read_earlier_gradebook(out / GRADEBOOK)
    for note in opened.notes:
        notify(f"  {one_line(note)}")
    rosters = [roster] if roster else opened.rosters
    found = discover(
        path,
        system=system,
        roster=rosters[0] if rosters else None,
        unpack=out / UNPACKED,
        zone=assignment.policy.zone,
    )
    found = with_times(found, opened.rosters, assignment.policy)
    _say_found(found, notify)
    folder = _with_elsewhere(found, opened, gradebook)
    students = {one.student.key: one.student for one in folder.handed_in}
    covered = list(opened.covered(list(students.values()), folder.system))
    refuse_poor_join(folder, covered, assignment.policy, accepts)
    return ClassInputs(folder, opened, gradebook)


def _with_elsewhere(
    folder: ClassFolder, opened: OpenSheets, gradebook: EarlierGradebook
) -> ClassFolder:
    """Return the class with what the files and the gradebook say about missing students."""
    # a name must be unique in the whole class, not only among the missing
    class_ = [*{one.student.key: one.student for one in folder.handed_in}.values(), *folder.missing]
    missing = {student.key for student in folder.missing}
    known = opened.elsewhere(class_, folder.system)
    elsewhere = {**{key: known[key] for key in known.keys() & missing}, **folder.elsewhere}
    for key, had in gradebook.elsewhere(folder.missing, class_).items():
        elsewhere[key] = replace(elsewhere.get(key, had), final=had.final)
    return replace(folder, elsewhere=elsewhere)


def _say_found(folder: ClassFolder, notify: Callable[[str], None]) -> None:
    students = {attempt.student.key for attempt in folder.handed_in}
    attempts = len(folder.handed_in)
    more = f" in {attempts} attempts" if attempts != len(students) else ""
    missing = f", {len(folder.missing)} without a submission" if folder.missing else ""
    notify(f"found {counted(len(students))}{more}{missing} ({folder.system.name})")
    for note in folder.notes:
        notify(f"  {one_line(note)}")
    for why in folder.unclear:
        notify(f"needs attention: {one_line(why, most=MOST_WHY)}")
