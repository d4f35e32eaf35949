"""Finds students on a roster: by an identifier, or else by a name that only one of them has.

A name that several have joins nobody, even if only one of them is left: who that is, is not known.
"""

from __future__ import annotations

import itertools
import unicodedata
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from grader.base.nearest import without_accents
from grader.batch.model import Student
from grader.batch.roster import Roster
from grader.batch.systems.system import System

MOST_PARTS = 5  # of a name that is written as one word


@dataclass
class Match:
    """The roster's row of each key, and the keys that were found by name alone.

    `candidates` are the rows that fit a key if it is not clear which one it is.
    """

    rows: dict[str, int] = field(default_factory=dict)
    by_name: set[str] = field(default_factory=set)
    candidates: dict[str, set[int]] = field(default_factory=dict)

    @property
    def unclear(self) -> dict[str, set[int]]:
        """The possible rows of each key that has none because several fit."""
        return {key: rows for key, rows in self.candidates.items() if key not in self.rows}

    def add_candidates(self, key: str, rows: Iterable[int]) -> None:
        """Note that these rows fit a key, and that it is not clear which one it is."""
        if found := set(rows):
            self.candidates.setdefault(key, set()).update(found)


@dataclass(frozen=True)
class MatchRule:
    """One rule to recognise a student: the identifiers of a submission and of a roster's line.

    `fits`, if given, says whether a student and a line with the same identifier can be one person.
    """

    of_student: Callable[[Student], Iterable[str]]
    of_line: Callable[[Student], Iterable[str]]
    by_name: bool = False
    fits: Callable[[Student, Student], bool] | None = None


def match_more(
    match: Match, rules: Iterable[MatchRule], students: Sequence[Student], roster: Roster
) -> None:
    """Find a row for each student without one; a row has one key, and the first rule wins."""
    lines = roster.students
    for rule in rules:
        taken = set(match.rows.values())
        # a name must be unique in the whole class: who already has a row counts too
        rows = _rows_by_identifier(rule, lines, without=set() if rule.by_name else taken)
        claims: dict[int, list[str]] = {}
        for student in students:
            if student.key in match.rows and not rule.by_name:
                continue
            found = {row for own in rule.of_student(student) for row in rows.get(own, ())}
            fit = {row for row in found if rule.fits is None or rule.fits(student, lines[row])}
            if len(fit) == 1:
                claims.setdefault(fit.pop(), []).append(student.key)
            elif student.key not in match.rows:
                match.add_candidates(student.key, fit)
        for row in claims.keys() - taken:
            keys = [key for key in claims[row] if key not in match.rows]
            if len(claims[row]) > 1:
                for key in keys:
                    match.add_candidates(key, [row])
            elif keys:
                match.rows[keys[0]] = row
                if rule.by_name:
                    match.by_name.add(keys[0])


def sure_rules(system: System, students: Sequence[Student], roster: Roster) -> Iterator[MatchRule]:
    """Yield the rules that need more than a name, the surest first.

    A system's numbers are compared only with a roster of the same system: in another list a small
    number would be somebody else's.
    """
    if _has_numbers_of(system, roster):
        yield _by_number(students, roster)
    if system.usernames:
        yield MatchRule(_username, _username)
        yield MatchRule(_tails, _username)
    if system.numbered:  # (the system's own list may have told more than the number)
        for identifiers in (_id_number, _email):
            yield MatchRule(identifiers, identifiers)
    else:
        for identifiers in (_id_number, _username, _email):
            yield MatchRule(_all_identifiers, identifiers)
        yield MatchRule(_all_identifiers, _key)
        yield MatchRule(_all_identifiers, _mailbox)


def fallback_rules(system: System, roster: Roster) -> Iterator[MatchRule]:
    """Yield the last rules to try: by the number of a student without a name, and by name."""
    if _has_numbers_of(system, roster):
        yield MatchRule(_number, _number, fits=_is_nameless)
    yield BY_NAME


def rules_for_people(
    system: System, students: Sequence[Student], roster: Roster
) -> Iterator[MatchRule]:
    """Yield the rules to find the students of a class in a sheet."""
    if _has_numbers_of(system, roster):
        yield _by_number(students, roster)
    for identifiers in (_id_number, _email, _username):
        yield MatchRule(identifiers, identifiers)
    yield from fallback_rules(system, roster)


def _has_numbers_of(system: System, roster: Roster) -> bool:
    return system is roster.system and system.numbered


def names_agree(own: Student, line: Student) -> bool:
    """Whether two names can be one person's: they share a word or have the same letters."""
    return bool({*_words(own)} & {*_words(line)}) or is_same_name(own, line)


def is_participant(own: Student, line: Student | None) -> bool:
    """Whether a line with a student's number can be this student's."""
    return line is not None and (names_agree(own, line) or _is_nameless(own, line))


def is_same_name(own: Student, line: Student) -> bool:
    """Whether two names have the same letters, in any order: Korean names have two orders."""
    return Counter("".join(_words(own))) == Counter("".join(_words(line)))


def _by_number(students: Sequence[Student], roster: Roster) -> MatchRule:
    """Return the rule for the system's own number.

    A numbered group can have the number of a participant. So the names must agree if the roster has
    groups, or if most numbers have different names (more than renamed students would explain).
    """
    lines = {identifier: line for line in roster.students for identifier in _number(line)}
    pairs = [
        (one, lines[identifier])
        for one in students
        for identifier in _number(one)
        if identifier in lines
    ]
    agree = sum(names_agree(*pair) or _is_nameless(*pair) for pair in pairs)
    groups = any(line.group for line in roster.lines)
    unsure = roster.form.numbers_groups and (groups or 2 * agree < len(pairs))
    return MatchRule(_number, _number, fits=names_agree if unsure else None)


def _is_nameless(own: Student, line: Student) -> bool:
    """Whether one of the two has only the number as a name, as in blind marking."""
    return line.name in ("", line.key) or own.name.endswith(f" {own.key}") or own.name == own.key


def _rows_by_identifier(
    rule: MatchRule, lines: Sequence[Student], *, without: set[int]
) -> dict[str, list[int]]:
    rows: dict[str, list[int]] = {}
    for row, student in enumerate(lines):
        if row not in without:
            for identifier in set(rule.of_line(student)):
                rows.setdefault(identifier, []).append(row)
    return rows


def _all_identifiers(student: Student) -> Iterator[str]:
    for value in (student.key, student.id_number, student.username, student.email):
        yield from _normalised(value)


def _normalised(value: str) -> tuple[str, ...]:
    value = unicodedata.normalize("NFC", value).strip().casefold()
    return (value,) if value else ()


def _key(student: Student) -> tuple[str, ...]:
    return _normalised(student.key)


def _number(student: Student) -> tuple[str, ...]:
    return _normalised(student.key.lstrip("0"))


def _id_number(student: Student) -> tuple[str, ...]:
    return _normalised(student.id_number)


def _username(student: Student) -> tuple[str, ...]:
    return _normalised(student.username)


def _email(student: Student) -> tuple[str, ...]:
    return _normalised(student.email)


def _mailbox(student: Student) -> tuple[str, ...]:
    return _normalised(student.email.partition("@")[0])


def _tails(student: Student) -> Iterator[str]:
    """Yield each possible user name in `<assignment>-<username>`: both may contain `-`."""
    parts = student.key.split("-")
    for n in range(1, len(parts)):
        yield from _normalised("-".join(parts[n:]))


def _words(student: Student) -> list[str]:
    spaced = "".join(c if c.isalnum() else " " for c in without_accents(student.name))
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


def written_names(student: Student) -> Iterator[str]:
    """Yield a name as it may be written in a list: in any order of its words, or as one word."""
    yield from _sorted_words(student)
    yield from _one_word(student)


def possible_names(line: Student) -> Iterator[str]:
    """Yield what `written_names` of the same name can be."""
    yield from _sorted_words(line)
    yield from _words_in_any_order(line)


# one rule: `Kim Minji` and `KimMinji` are the same name
BY_NAME = MatchRule(written_names, possible_names, by_name=True)
