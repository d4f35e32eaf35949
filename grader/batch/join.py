"""Joins submissions and roster: each submission's student or group, and students without one."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from grader.base.i18n.message import joined, say, say_plural
from grader.base.nearest import without_accents
from grader.base.plain_text import one_line
from grader.batch.find_student import StudentIndex
from grader.batch.groups import Groups, find_groups, group_column
from grader.batch.match import Match, fallback_rules, is_same_name, match_more, sure_rules
from grader.batch.model import Elsewhere, HandedIn, OnRoster, Student
from grader.batch.roster import Roster
from grader.batch.systems.system import System
from grader.batch.times import timed
from grader.batch.unclear import Unclear, unclear_groups

STRANGER = say("not on the roster")
BY_NAME = say("found on the roster by name only")
ALONE_TOO = say("also handed in alone: both are attempts")
GIVEN = say("joined as the join file says")


@dataclass(frozen=True)
class Joined:
    """The class in the order of the roster, then by name.

    `elsewhere` are the missing students, by key, who are known to have handed in elsewhere.
    `unclear` says which submissions were not joined because several students or submissions fit.
    `on_list` has the word that identifies each student on the roster, by key.
    """

    handed_in: tuple[HandedIn, ...]
    missing: tuple[Student, ...] = ()
    elsewhere: Mapping[str, Elsewhere] = field(default_factory=dict)
    on_roster: OnRoster | None = None
    notes: tuple[str, ...] = ()
    unclear: tuple[str, ...] = ()
    on_list: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Pinned:
    """A submission whose students the instructor named: their rows of the roster."""

    handed_in: HandedIn
    rows: tuple[int, ...]


def with_lists(
    system: System, handed_in: Sequence[HandedIn], lists: Sequence[Roster]
) -> list[HandedIn]:
    """Return the submissions with what the system's own lists tell of their students: the address, an id.

    Such a list has the system's numbers, and another roster does not.
    """
    students = {one.student.key: one.student for one in handed_in}
    for known in lists:
        match, own = Match(), [*students.values()]
        match_more(match, sure_rules(system, own, known), own, known)
        for key, row in match.rows.items():
            student, line = students[key], known.students[row]
            students[key] = replace(
                student,
                email=student.email or line.email,
                id_number=student.id_number or line.id_number,
            )
    return [replace(one, student=students[one.student.key]) for one in handed_in]


def join(
    system: System,
    handed_in: Iterable[HandedIn],
    roster: Roster | None,
    pinned: Sequence[Pinned] = (),
) -> Joined:
    """Match each submission with its student's line of the roster; without a roster, sort by name.

    A group's submission becomes one of each member. Students keep the keys of their submissions;
    members of groups get the roster's. `pinned` submissions are not matched, and are not among
    `handed_in`.
    """
    by_key: dict[str, list[HandedIn]] = {}
    for one in handed_in:
        by_key.setdefault(one.student.key, []).append(one)
    if roster is None:
        return Joined(tuple(_by_student_name(by_key.values())))
    students = [group[0].student for group in by_key.values()]
    roster, notes = _with_groups(system, students, with_own_keys(roster))
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
    rest = [one for one in students if one.key not in groups.rows | dict.fromkeys(groups.ambiguous)]
    match_more(match, fallback_rules(system, roster), rest, roster)
    return _joined(by_key, match, groups, roster, notes, pinned)


def _with_groups(
    system: System, students: Sequence[Student], roster: Roster
) -> tuple[Roster, list[str]]:
    """Return the roster with its group column, and a note if the names of the submissions tell it.

    The groups are removed if these submissions are not groups': a student can use a group's name. A
    name counts as a group's only if Moodle or the instructor gave it, and if it is no exception (in
    Moodle everybody hands in as a group or nobody does).
    """
    if any(line.group for line in roster.lines):
        found = len(find_groups(students, roster.lines).rows)
        if system.group_folders and (roster.form.numbers_groups or 2 * found >= len(students)):
            return roster, []
        return replace(roster, lines=tuple(replace(line, group="") for line in roster.lines)), []
    column = group_column(students, roster.lines) if system.group_folders else ""
    if not column:
        return roster, []
    lines = tuple(replace(line, group=line.unknown[column]) for line in roster.lines)
    named = one_line(column, most=40)
    return replace(roster, lines=lines), [
        say("the roster's column '{column}' was used as the group", column=named)
    ]


def _joined(
    by_key: Mapping[str, list[HandedIn]],
    match: Match,
    groups: Groups,
    roster: Roster,
    notes: list[str],
    pinned: Sequence[Pinned],
) -> Joined:
    found: dict[int, list[HandedIn]] = {}
    strangers = []
    # a group's key is free again: its number may be a participant's
    taken = set(by_key) - groups.rows.keys()
    for key, row in match.rows.items():
        student = _fuller(by_key[key][0].student, roster.students[row])
        by_name = (BY_NAME,) if key in match.by_name else ()
        own = [replace(o, student=student, notes=(*o.notes, *by_name)) for o in by_key[key]]
        found[row] = own
    for key, rows in groups.rows.items():
        for row in rows:
            own = found.get(row, [])
            student = own[0].student if own else _with_free_key(roster.students[row], taken)
            found[row] = [*_of_group(by_key[key], student, groups.names[key], alone=own), *own]
    _add_pinned(found, pinned, roster, taken)
    for row, own in found.items():
        found[row] = timed(own, {own[0].student.key: roster.lines[row].times})
    unclear = _unclear(by_key, match, groups, roster, found)
    for key, attempts in by_key.items():
        if key not in match.rows and not groups.rows.get(key):
            why = next((one.reason for one in unclear if key in one.keys), "")
            notes_of = () if why else (STRANGER,)
            strangers.append(
                [replace(o, notes=(*o.notes, *notes_of), unclear=why) for o in attempts]
            )
    missing = [
        (row, _with_free_key(line.student, taken))
        for row, line in enumerate(roster.lines)
        if row not in found
    ]
    index = StudentIndex(roster.students)
    keys = {row: own[0].student.key for row, own in found.items()}
    keys |= {row: student.key for row, student in missing}
    elsewhere: dict[str, Elsewhere] = {}
    for row, student in missing:
        why = next((one.reason for one in unclear if row in one.rows), "")
        if why or roster.lines[row].evidence:
            reason = why or roster.lines[row].evidence
            elsewhere[student.key] = Elsewhere(reason, is_unclear=bool(why))
    return Joined(
        handed_in=(*(o for row in sorted(found) for o in found[row]), *_by_student_name(strangers)),
        missing=tuple(student for _, student in missing),
        elsewhere=elsewhere,
        on_roster=_roster_counts(len(by_key) + len(pinned), strangers, roster),
        notes=(*roster.notes, *notes, *_group_notes(groups)),
        unclear=tuple(one.reason for one in unclear),
        on_list={key: index.word_for(row) for row, key in keys.items()},
    )


def _add_pinned(
    found: dict[int, list[HandedIn]], pinned: Sequence[Pinned], roster: Roster, taken: set[str]
) -> None:
    """Add the submissions whose students the instructor named; `taken` are keys of others."""
    for one in pinned:
        note = GIVEN
        if len(one.rows) > 1:
            note = joined(GIVEN, say("of a group of {count}", count=len(one.rows)), by=": ")
        for row in one.rows:
            own, line = found.get(row, []), roster.students[row]
            if own:
                student = own[0].student
            elif len(one.rows) > 1 or one.handed_in.student.key in taken:
                student = _with_free_key(line, taken)
            else:
                student = _fuller(one.handed_in.student, line)
                taken.add(student.key)
            notes = (*one.handed_in.notes, note)
            found[row] = [*own, replace(one.handed_in, student=student, notes=notes)]


def _unclear(
    by_key: Mapping[str, list[HandedIn]],
    match: Match,
    groups: Groups,
    roster: Roster,
    found: Mapping[int, list[HandedIn]],
) -> list[Unclear]:
    """Return the submissions that were not joined because several fit, with the possible rows."""
    unclear = {key: set(rows) for key, rows in match.unclear.items() if key not in groups.rows}
    students = {key: attempts[0].student for key, attempts in by_key.items()}
    one_by_one = unclear_groups(unclear, students, roster.students)
    of_groups = {
        why: Unclear(
            why,
            frozenset(key for key, reason in groups.ambiguous.items() if reason == why),
            frozenset(row for row, reason in groups.unsure.items() if reason == why),
        )
        for why in (*groups.ambiguous.values(), *groups.unsure.values())
    }
    return [
        one for one in (*one_by_one, *of_groups.values()) if one.keys or one.rows - found.keys()
    ]


def _roster_counts(
    submissions: int, strangers: Sequence[list[HandedIn]], roster: Roster
) -> OnRoster:
    return OnRoster(
        roster=roster.name,
        submissions=submissions,
        strangers=tuple(g[0].student.name for g in strangers if not g[0].unclear),
        lines=len(roster.lines),
    )


def _of_group(
    attempts: Sequence[HandedIn], student: Student, name: str, *, alone: Sequence[HandedIn]
) -> Iterator[HandedIn]:
    note = say("handed in by the group '{group}'", group=one_line(name, most=80))
    for one in attempts:
        more = (ALONE_TOO,) if alone else ()
        yield replace(one, student=student, notes=(*one.notes, note, *more))


def _group_notes(groups: Groups) -> Iterator[str]:
    members = sum(len(rows) for rows in groups.rows.values())
    if members:
        yield say_plural(
            "1 submission is from a group: each of the {members} members gets the group's verdict",
            "{count} submissions are from groups: each of the {members} members gets the group's "
            "verdict",
            len(groups.rows),
            members=members,
        )


def _by_student_name(groups: Iterable[list[HandedIn]]) -> Iterator[HandedIn]:
    def place(group: list[HandedIn]) -> tuple[str, str]:
        return without_accents(group[0].student.name), group[0].student.key

    for group in sorted(groups, key=place):
        yield from group


def _fuller(own: Student, line: Student) -> Student:
    """Return the roster's student with the submission's key, completed from the submission."""
    return Student(
        key=own.key,
        name=line.name or own.name,
        email=line.email or own.email,
        username=line.username or own.username,
        id_number=line.id_number or own.id_number,
        section=line.section or own.section,
    )


def with_own_keys(roster: Roster) -> Roster:
    """Return the roster with different keys for students of one name who have nothing else."""
    counts = Counter(line.student.key for line in roster.lines)
    lines = (
        replace(
            line, student=replace(line.student, key=f"{line.student.key} (line {line.row + 1})")
        )
        if counts[line.student.key] > 1
        else line
        for line in roster.lines
    )
    return replace(roster, lines=tuple(lines))


def _with_free_key(student: Student, taken: set[str]) -> Student:
    """Return a student of the roster with a key that no submission has."""
    key = student.key
    while key in taken:
        key = f"{key} (roster)"
    taken.add(key)
    return replace(student, key=key)
