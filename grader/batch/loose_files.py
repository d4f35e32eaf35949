"""Files in the class folder that are neither folders nor archives, named after a student.

A student who handed in a PDF has handed in something: it is no package, and no missing submission.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from grader.base.i18n.message import say
from grader.base.shown import shown
from grader.batch.join import STRANGER, Joined, join
from grader.batch.model import HandedIn, Student
from grader.batch.roster import Roster
from grader.batch.systems.layout import FolderItem
from grader.batch.systems.notes import printable
from grader.batch.systems.system import System


def with_loose_files(
    system: System, joined: Joined, path: Path, files: Sequence[FolderItem], roster: Roster
) -> Joined:
    """Return the class with the files whose names are those of students without a submission."""
    missing = {_without_key(student) for student in joined.missing}
    taken = {one.student.key for one in joined.handed_in}
    loose = [one for item in files if (one := loose_file(path, item)).student.key not in taken]
    if not missing or not loose:
        return joined
    lines = tuple(line for line in roster.lines if _without_key(line.student) in missing)
    beside = join(system, loose, replace(roster, lines=lines))
    found = [one for one in beside.handed_in if not one.unclear and STRANGER not in one.notes]
    unclear = {key: why for key, why in beside.elsewhere.items() if why.is_unclear}
    who = {_without_key(one.student) for one in found}
    return replace(
        joined,
        handed_in=(*joined.handed_in, *found),
        missing=tuple(one for one in joined.missing if _without_key(one) not in who),
        elsewhere={**joined.elsewhere, **unclear},
        unclear=(*joined.unclear, *beside.unclear),
        on_list={**joined.on_list, **beside.on_list},
    )


def loose_file(path: Path, item: FolderItem) -> HandedIn:
    """Return a file that cannot be marked as a submission of the student that it is named after."""
    key = printable(Path(item.name).stem)
    name = shown(printable(item.name))
    problem = item.problem or say("{name} is neither a folder nor an archive", name=name)
    return HandedIn(Student(key=key, name=key), path / item.name, problem=problem)


def _without_key(student: Student) -> Student:
    """Return who a student is: the key in the class may be another one."""
    return replace(student, key="")
