"""Finds submissions of groups and their members, by the roster's group column.

Moodle's download names a group's folder after the group, as `clean_filename` returns it
(mod/assign/classes/downloader.php): `_` becomes a space, `&` first becomes `&amp;`, and characters
that a file name cannot have (PARAM_FILE) are dropped. The worksheet has the original name. Names
are compared as Moodle writes them first, then without case and accents.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from grader.base.i18n.message import say
from grader.base.nearest import without_accents
from grader.batch.model import Student
from grader.batch.roster import RosterLine

DROPPED = re.compile(r"[\x00-\x1f\x7f&<>\"`|':\\/]")
SEVERAL = re.compile(r"\s*[,;|]\s*")  # separates the groups of a student who is in more than one


@dataclass
class Groups:
    """The rows of each group's members, and the group's name, by the submission's key.

    `ambiguous` are submissions that may be of several groups, `unsure` the rows that may be in such
    a group, each with the reason.
    """

    rows: dict[str, list[int]] = field(default_factory=dict)
    names: dict[str, str] = field(default_factory=dict)
    ambiguous: dict[str, str] = field(default_factory=dict)
    unsure: dict[int, str] = field(default_factory=dict)


def find_groups(students: Sequence[Student], lines: Sequence[RosterLine]) -> Groups:
    """Return the submissions that are a group's, by the name of the folder."""
    found = Groups()
    cells = _rows_by_group(lines)
    for form in (_as_moodle_writes, _loosely):
        known = found.rows.keys() | found.ambiguous.keys()
        left = [student for student in students if student.key not in known]
        free = {cell: rows for cell, rows in cells.items() if cell not in found.names.values()}
        _match(found, left, free, form)
    _without_double_members(found, lines)
    return found


def group_column(students: Sequence[Student], lines: Sequence[RosterLine]) -> str:
    """Return the unknown column that contains the names of most submissions, "" if there is none.

    It counts as a group column only if several students share a name in it.
    """
    for column in lines[0].unknown if lines else ():
        trial = [RosterLine(line.student, group=line.unknown.get(column, "")) for line in lines]
        found = find_groups(students, trial)
        members = sum(len(rows) for rows in found.rows.values())
        if 2 * len(found.rows) > len(students) and members > len(found.rows):
            return column
    return ""


def _rows_by_group(lines: Sequence[RosterLine]) -> dict[str, list[int]]:
    cells: dict[str, list[int]] = {}
    for row, line in enumerate(lines):
        for name in dict.fromkeys((line.group, *SEVERAL.split(line.group))):
            if name:
                cells.setdefault(name, []).append(row)
    return cells


def _match(
    found: Groups,
    students: Iterable[Student],
    cells: Mapping[str, list[int]],
    form: Callable[[str], Iterable[str]],
) -> None:
    by_form: dict[str, set[str]] = {}
    for cell in cells:
        for text in form(cell):
            by_form.setdefault(text, set()).add(cell)
    claims: dict[str, list[Student]] = {}
    for student in students:
        fit = {cell for name in _names(student) for t in form(name) for cell in by_form.get(t, ())}
        for cell in fit:
            claims.setdefault(cell, []).append(student)
        if len(fit) > 1:
            _mark_ambiguous(found, [student], fit, cells)
    for cell, claimants in claims.items():
        if len(claimants) > 1:
            _mark_ambiguous(found, claimants, [cell], cells)
        elif claimants[0].key not in found.ambiguous:
            found.rows[claimants[0].key] = list(cells[cell])
            found.names[claimants[0].key] = cell
    for key in found.ambiguous.keys() & found.rows.keys():
        del found.rows[key], found.names[key]


def _mark_ambiguous(
    found: Groups,
    students: Sequence[Student],
    names: Iterable[str],
    cells: Mapping[str, list[int]],
) -> None:
    for name in names:
        why = say(
            "the group '{group}' may have handed in: more than one group or submission fits",
            group=name,
        )
        found.unsure |= dict.fromkeys(cells[name], why)
        found.ambiguous |= {student.key: why for student in students}


def _without_double_members(found: Groups, lines: Sequence[RosterLine]) -> None:
    """Remove members of several groups: it is not certain which verdict they get."""
    groups: dict[int, list[str]] = {}
    for key, rows in found.rows.items():
        for row in rows:
            groups.setdefault(row, []).append(key)
    for row, keys in groups.items():
        # `Kim, Lee` may be the name of one group
        own = [key for key in keys if found.names[key] == lines[row].group]
        if len(keys) > 1 and not own:
            named = ", ".join(f"'{found.names[key]}'" for key in keys)
            found.unsure[row] = say(
                "is a member of more than one group that handed in: {groups}", groups=named
            )
        if len(keys) > 1:
            for key in set(keys) - set(own):
                found.rows[key].remove(row)


def _names(student: Student) -> Iterator[str]:
    """Yield the possible names of a folder, with and without Moodle's number at the end."""
    yield student.name
    yield student.name.removesuffix(f" {student.key}")


def _as_moodle_writes(name: str) -> Iterator[str]:
    plain = unicodedata.normalize("NFC", name).replace("_", " ")
    yield DROPPED.sub("", plain).strip()
    yield DROPPED.sub("", plain.replace("&", "&amp;")).strip()


def _loosely(name: str) -> Iterator[str]:
    for text in _as_moodle_writes(name):
        yield " ".join(without_accents(text).split())
