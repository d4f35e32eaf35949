"""Submissions and roster brought together: whose is what, whose a group's is, and who has none."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime

from grader.base.plain_text import one_line
from grader.batch.groups import Groups, find_groups, group_column
from grader.batch.match import Match, fallback_rules, folded, is_same_name, match_more, sure_rules
from grader.batch.model import Elsewhere, HandedIn, OnRoster, Student, System
from grader.batch.roster import Roster

STRANGER = "this student is on no line of the roster"
DOUBTFUL = "more than one line of the roster fits, or more than one submission fits its line"
BY_NAME = "found on the roster by the name alone"
BY_GROUPS = ("moodle", "folders", "archives")  # whose download has a folder for each group
ALONE_TOO = "handed in alone as well as with the group: both are attempts"


@dataclass(frozen=True)
class Joined:
    """The class in its order: the roster's, then by name.

    `elsewhere` are those of the missing, by key, whose submission is known to be somewhere.
    """

    handed_in: tuple[HandedIn, ...]
    missing: tuple[Student, ...] = ()
    elsewhere: Mapping[str, Elsewhere] = field(default_factory=dict)
    on_roster: OnRoster | None = None
    notes: tuple[str, ...] = ()


def join(system: System, handed_in: Iterable[HandedIn], roster: Roster | None) -> Joined:
    """Give each submission its student's line of the roster; without one, sort by name.

    A group's submission becomes one of each member. The students keep the submissions' keys, and
    the members of groups have the roster's.
    """
    by_key: dict[str, list[HandedIn]] = {}
    for one in handed_in:
        by_key.setdefault(one.student.key, []).append(one)
    if roster is None:
        return Joined(tuple(_in_order(by_key.values())))
    students = [group[0].student for group in by_key.values()]
    roster, told = _with_groups(system, students, roster)
    match = Match()
    match_more(match, sure_rules(system, students, roster), students, roster)
    # a group `Team Lee` may have the number of a participant Ann Lee
    named = find_groups(students, roster.lines).rows
    for student in students:
        row = match.rows.get(student.key)
        if row is None or student.key not in named:
            continue
        if not is_same_name(student, roster.students[row]):
            del match.rows[student.key]
    groups = find_groups([one for one in students if one.key not in match.rows], roster.lines)
    rest = [one for one in students if one.key not in groups.rows | dict.fromkeys(groups.doubtful)]
    match_more(match, fallback_rules(system, roster), rest, roster)
    return _joined(by_key, match, groups, roster, told)


def _with_groups(
    system: System, students: Sequence[Student], roster: Roster
) -> tuple[Roster, list[str]]:
    """Return the roster with its column of groups, if only the submissions' names tell which it is;
    without any group if these submissions are people's.

    A student can call himself as a group is called. So a name counts as a group's only where Moodle
    or the instructor gave it, and where it is not the exception: in Moodle all hand in as groups or
    nobody does.
    """
    if any(line.group for line in roster.lines):
        found = len(find_groups(students, roster.lines).rows)
        if system in BY_GROUPS and (roster.kind == "moodle" or 2 * found >= len(students)):
            return roster, []
        return replace(roster, lines=tuple(replace(line, group="") for line in roster.lines)), []
    column = group_column(students, roster.lines) if system in BY_GROUPS else ""
    if not column:
        return roster, []
    lines = tuple(replace(line, group=line.unknown[column]) for line in roster.lines)
    named = one_line(column, most=40)
    return replace(roster, lines=lines), [f"the roster's column '{named}' was taken as the group"]


def _joined(
    by_key: Mapping[str, list[HandedIn]],
    match: Match,
    groups: Groups,
    roster: Roster,
    told: list[str],
) -> Joined:
    found: dict[int, list[HandedIn]] = {}
    strangers = []
    # a key that no longer names a submission is free: a group's number may be a participant's
    taken = set(by_key) - groups.rows.keys()
    for key, row in match.rows.items():
        student = _fuller(by_key[key][0].student, roster.students[row])
        notes = (BY_NAME,) if key in match.by_name else ()
        own = [replace(o, student=student, notes=(*o.notes, *notes)) for o in by_key[key]]
        found[row] = _timed(own, roster.lines[row].submitted)
    for key, rows in groups.rows.items():
        for row in rows:
            own = found.get(row, [])
            student = own[0].student if own else _apart(roster.students[row], taken)
            found[row] = [*_of_group(by_key[key], student, groups.names[key], alone=own), *own]
    for key, attempts in by_key.items():
        if key not in match.rows and not groups.rows.get(key):
            note = DOUBTFUL if key in match.doubtful | groups.doubtful else STRANGER
            strangers.append([replace(one, notes=(*one.notes, note)) for one in attempts])
    missing = [
        (row, _apart(line.student, taken))
        for row, line in enumerate(roster.lines)
        if row not in found
    ]
    why = {s.key: groups.unsure.get(row) or roster.lines[row].evidence for row, s in missing}
    return Joined(
        handed_in=(*(o for row in sorted(found) for o in found[row]), *_in_order(strangers)),
        missing=tuple(student for _, student in missing),
        elsewhere={key: Elsewhere(reason) for key, reason in why.items() if reason},
        on_roster=_counts(by_key, strangers, roster),
        notes=(*roster.notes, *told, *_told(groups)),
    )


def _counts(
    by_key: Mapping[str, list[HandedIn]], strangers: Sequence[list[HandedIn]], roster: Roster
) -> OnRoster:
    return OnRoster(
        roster=roster.name,
        submissions=len(by_key),
        strangers=tuple(group[0].student.name for group in strangers),
        lines=len(roster.lines),
    )


def _of_group(
    attempts: Sequence[HandedIn], student: Student, name: str, *, alone: Sequence[HandedIn]
) -> Iterator[HandedIn]:
    note = f"handed in by the group '{one_line(name, most=80)}'"
    for one in attempts:
        more = (ALONE_TOO,) if alone else ()
        yield replace(one, student=student, notes=(*one.notes, note, *more))


def _told(groups: Groups) -> Iterator[str]:
    members = sum(len(rows) for rows in groups.rows.values())
    if members:
        count = len(groups.rows)
        what = "1 submission is a group's" if count == 1 else f"{count} submissions are groups'"
        yield f"{what}: each of the {members} members gets the verdict of the group"


def _timed(group: list[HandedIn], at: datetime | None) -> list[HandedIn]:
    """Return a student's only submission with the roster's time, unless it has one of its own."""
    if at is None or len(group) > 1 or group[0].submitted is not None:
        return group
    return [replace(group[0], submitted=at)]


def _in_order(groups: Iterable[list[HandedIn]]) -> Iterator[HandedIn]:
    def place(group: list[HandedIn]) -> tuple[str, str]:
        return folded(group[0].student.name), group[0].student.key

    for group in sorted(groups, key=place):
        yield from group


def _fuller(own: Student, line: Student) -> Student:
    """Return the roster's line with the submission's key, and what only the submission tells."""
    return Student(
        key=own.key,
        name=line.name or own.name,
        email=line.email or own.email,
        username=line.username or own.username,
        id_number=line.id_number or own.id_number,
        section=line.section or own.section,
    )


def _apart(student: Student, taken: set[str]) -> Student:
    """Return a student of the roster under a key that no submission has."""
    key = student.key
    while key in taken:
        key = f"{key} (roster)"
    taken.add(key)
    return replace(student, key=key)
