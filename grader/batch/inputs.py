"""Reads the instructor's files, the earlier gradebook and the class before anything is marked.

Every error in them is reported here, before time is spent on marking.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from pathlib import Path

from grader.base.i18n.message import say_plural
from grader.base.plain_text import one_line
from grader.batch.accept import counted, refuse_poor_join
from grader.batch.dated import in_zone, with_times
from grader.batch.discover import discover
from grader.batch.earlier_gradebook import EarlierGradebook, read_earlier_gradebook
from grader.batch.extensions import read_extensions
from grader.batch.given_files import EXTENSIONS, JOIN, TIMES, GivenFiles, say_remembered
from grader.batch.join_file import GivenJoin
from grader.batch.model import ClassFolder
from grader.batch.sheets import OpenSheets, SheetOptions, open_sheets
from grader.batch.times_file import with_given_times
from grader.course.assignment import Assignment
from grader.course.policy import Policy

UNPACKED = "unpacked"
GRADEBOOK = "gradebook.csv"
MOST_WHY = 600  # characters


@dataclass(frozen=True)
class ClassInputs:
    """The class, the instructor's files, and the gradebook of an earlier run."""

    folder: ClassFolder
    sheets: OpenSheets
    gradebook: EarlierGradebook
    given: GivenFiles

    def refuse_poor_join(self, policy: Policy, accepts: Collection[str]) -> None:
        """Raise UsageError if the class hardly fits its roster or one of the instructor's files."""
        students = {one.student.key: one.student for one in self.folder.handed_in}
        covered = self.sheets.covered(list(students.values()), self.folder.system)
        refuse_poor_join(self.folder, list(covered), policy, accepts)


def read_inputs(
    path: Path,
    assignment: Assignment,
    sheets: SheetOptions,
    out: Path,
    *,
    system: str,
    roster: Path | None,
    given: GivenFiles,
    notify: Callable[[str], None],
) -> ClassInputs:
    """Read everything; raise UsageError if a file cannot be used.

    Without `roster` the worksheet is the roster, or else Canvas' gradebook. `given` are the
    instructor's own lists.
    """
    opened = open_sheets(sheets, assignment)
    gradebook = read_earlier_gradebook(out / GRADEBOOK)
    for note in opened.notes:
        notify(f"  {one_line(note)}")
    rosters = [roster] if roster else opened.rosters
    say_remembered(given, notify)
    join = given.get(JOIN)
    found = discover(
        path,
        system=system,
        roster=rosters[0] if rosters else None,
        unpack=out / UNPACKED,
        zone=assignment.policy.zone,
        given=GivenJoin(join.path, is_remembered=join.is_remembered) if join else None,
        lists=opened.rosters if roster else (),
    )
    found = in_zone(found, assignment.policy)
    found = with_times(found, opened.rosters, assignment.policy)
    found = _with_lists(found, given, assignment)
    _say_found(found, notify)
    folder = _with_elsewhere(found, opened, gradebook)
    return ClassInputs(folder, opened, gradebook, given)


def _with_lists(folder: ClassFolder, given: GivenFiles, assignment: Assignment) -> ClassFolder:
    """Return the class with the times and extensions that the instructor gives."""
    policy = assignment.policy
    times, extensions = given.get(TIMES), given.get(EXTENSIONS)
    if times is not None:
        folder = with_given_times(folder, times, policy.zone)
    if extensions is None:
        return folder
    students = {one.student.key: one.student for one in folder.handed_in}
    found = read_extensions(
        extensions,
        [*students.values(), *folder.missing],
        policy,
        assignment.id,
        on_roster=folder.on_roster is not None,
    )
    note = say_plural(
        "{count} student with an extension or slip days",
        "{count} students with an extension or slip days",
        len(found.grants),
    )
    return replace(folder, grants=found.grants, notes=(*folder.notes, *found.notes, note))


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
