"""Submissions and roster brought together: by what names one person, else by a name of one only."""

from __future__ import annotations

import itertools
import unicodedata
from collections.abc import Callable
from collections.abc import Iterable
from collections.abc import Iterator
from dataclasses import dataclass
from dataclasses import field
from dataclasses import replace
from datetime import datetime

from grader.batch.model import HandedIn
from grader.batch.model import Student
from grader.batch.model import System
from grader.batch.roster import Roster

STRANGER = "this student is on no line of the roster"
DOUBTFUL = "more than one line of the roster fits, or more than one submission fits its line"
BY_NAME = "found on the roster by the name alone"
MOST_PARTS = 5  # of a name that is written as one word


@dataclass(frozen=True)
class Joined:
    """The class in its order: the roster's, then by name."""

    handed_in: tuple[HandedIn, ...]
    missing: tuple[Student, ...] = ()
    notes: tuple[str, ...] = ()


def join(system: System, handed_in: Iterable[HandedIn], roster: Roster | None) -> Joined:
    """Give each submission its student's line of the roster; without one, sort by name.

    The students keep the submissions' keys.
    """
    by_key: dict[str, list[HandedIn]] = {}
    for one in handed_in:
        by_key.setdefault(one.student.key, []).append(one)
    if roster is None:
        return Joined(tuple(_in_order(by_key.values())))
    match = _match(system, [group[0].student for group in by_key.values()], roster)
    found: dict[int, list[HandedIn]] = {}
    strangers = []
    for key, group in by_key.items():
        row = match.rows.get(key)
        if row is None:
            note = DOUBTFUL if key in match.doubtful else STRANGER
            strangers.append([replace(one, notes=(*one.notes, note)) for one in group])
            continue
        notes = (BY_NAME,) if key in match.by_name else ()
        student = _fuller(group[0].student, roster.students[row])
        known = [replace(one, student=student, notes=(*one.notes, *notes)) for one in group]
        found[row] = _timed(known, roster.submitted_by(row))
    taken = set(by_key)
    missing = tuple(
        _apart(student, taken) for row, student in enumerate(roster.students) if row not in found
    )
    joined = [one for row in sorted(found) for one in found[row]]
    return Joined((*joined, *_in_order(strangers)), missing, roster.notes)


def _timed(group: list[HandedIn], at: datetime | None) -> list[HandedIn]:
    """Return a student's only submission with the roster's time, unless it has one of its own."""
    if at is None or len(group) > 1 or group[0].submitted is not None:
        return group
    return [replace(group[0], submitted=at)]


def _in_order(groups: Iterable[list[HandedIn]]) -> Iterator[HandedIn]:
    def place(group: list[HandedIn]) -> tuple[str, str]:
        return _folded(group[0].student.name), group[0].student.key

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
    """Return a missing student under a key that no submission has."""
    key = student.key
    while key in taken:
        key = f"{key} (roster)"
    taken.add(key)
    return replace(student, key=key)


@dataclass
class Match:
    """The roster's row of each key; which keys were found by name alone, and which not for sure."""

    rows: dict[str, int] = field(default_factory=dict)
    by_name: set[str] = field(default_factory=set)
    doubtful: set[str] = field(default_factory=set)


def _match(system: System, students: list[Student], roster: Roster) -> Match:
    """Find each student's row; a row is one key's, and the surer way comes first."""
    match = Match()
    for way in _ways(system, roster):
        rows = _rows_by_mark(way, roster, without=set(match.rows.values()))
        claims: dict[int, list[str]] = {}
        for student in students:
            if student.key in match.rows:
                continue
            fit = {row for mark in way.of_own(student) for row in rows.get(mark, ())}
            if len(fit) == 1:
                claims.setdefault(fit.pop(), []).append(student.key)
            elif fit:
                match.doubtful.add(student.key)
        for row, keys in claims.items():
            if len(keys) > 1:
                match.doubtful.update(keys)
                continue
            match.rows[keys[0]] = row
            if way.by_name:
                match.by_name.add(keys[0])
    return match


def _rows_by_mark(way: Way, roster: Roster, *, without: set[int]) -> dict[str, list[int]]:
    rows: dict[str, list[int]] = {}
    for row, student in enumerate(roster.students):
        if row not in without:
            for mark in set(way.of_line(student)):
                rows.setdefault(mark, []).append(row)
    return rows


@dataclass(frozen=True)
class Way:
    """One way to know somebody again: the marks of a submission, and those of a roster's line."""

    of_own: Callable[[Student], Iterable[str]]
    of_line: Callable[[Student], Iterable[str]]
    by_name: bool = False


def _ways(system: System, roster: Roster) -> Iterator[Way]:
    """Yield the ways, the surest first.

    Moodle's and Canvas' numbers mean something only where the roster has them too: a small number
    of another list would be somebody else's.
    """
    numbered = system in ("moodle", "canvas")
    if system == roster.kind and numbered:
        yield Way(_key, _key)
    if system == "github_classroom":
        yield Way(_username, _username)
        yield Way(_tails, _username)
    if not numbered:
        for marks in (_id_number, _username, _email):
            yield Way(_own_marks, marks)
        yield Way(_own_marks, _key)
        yield Way(_own_marks, _mailbox)
    yield Way(_sorted_words, _sorted_words, by_name=True)
    yield Way(_one_word, _words_in_any_order, by_name=True)


def _own_marks(student: Student) -> Iterator[str]:
    for value in (student.key, student.id_number, student.username, student.email):
        yield from _mark(value)


def _mark(value: str) -> tuple[str, ...]:
    value = unicodedata.normalize("NFC", value).strip().casefold()
    return (value,) if value else ()


def _key(student: Student) -> tuple[str, ...]:
    return _mark(student.key)


def _id_number(student: Student) -> tuple[str, ...]:
    return _mark(student.id_number)


def _username(student: Student) -> tuple[str, ...]:
    return _mark(student.username)


def _email(student: Student) -> tuple[str, ...]:
    return _mark(student.email)


def _mailbox(student: Student) -> tuple[str, ...]:
    return _mark(student.email.partition("@")[0])


def _tails(student: Student) -> Iterator[str]:
    """Yield what may be the user's name in `<assignment>-<username>`: both may have a `-`."""
    parts = student.key.split("-")
    for n in range(1, len(parts)):
        yield from _mark("-".join(parts[n:]))


def _folded(name: str) -> str:
    """Return a name without accents and capitals."""
    plain = unicodedata.normalize("NFKD", name.casefold())
    return "".join(c for c in plain if not unicodedata.category(c).startswith("M"))


def _words(student: Student) -> list[str]:
    spaced = "".join(c if c.isalnum() else " " for c in _folded(student.name))
    return spaced.split()


def _sorted_words(student: Student) -> tuple[str, ...]:
    words = _words(student)
    return (" ".join(sorted(words)),) if words else ()


def _one_word(student: Student) -> tuple[str, ...]:
    """Canvas writes `Lee, Ann` as `leeann`."""
    words = _words(student)
    return ("".join(words),) if words else ()


def _words_in_any_order(student: Student) -> Iterator[str]:
    words = _words(student)
    if len(words) <= MOST_PARTS:
        for order in itertools.permutations(words):
            yield "".join(order)
