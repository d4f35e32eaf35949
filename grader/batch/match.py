"""Students found on a roster: by what names one person, else by a name that only one of them has."""

from __future__ import annotations

import itertools
import unicodedata
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from grader.batch.model import Student, System
from grader.batch.roster import Roster

MOST_PARTS = 5  # of a name that is written as one word


@dataclass
class Match:
    """The roster's row of each key; which keys were found by name alone, and which not for sure."""

    rows: dict[str, int] = field(default_factory=dict)
    by_name: set[str] = field(default_factory=set)
    doubtful: set[str] = field(default_factory=set)


@dataclass(frozen=True)
class MatchRule:
    """One rule to know somebody again: the marks of a submission, and those of a roster's line.

    `fits`, if there is one, says whether a student and a line with the same mark can be one person.
    """

    of_own: Callable[[Student], Iterable[str]]
    of_line: Callable[[Student], Iterable[str]]
    by_name: bool = False
    fits: Callable[[Student, Student], bool] | None = None


def match_more(
    match: Match, rules: Iterable[MatchRule], students: Sequence[Student], roster: Roster
) -> None:
    """Find the row of each student who has none; a row is one key's, and the first rule wins."""
    lines = roster.students
    for rule in rules:
        rows = _rows_by_mark(rule, lines, without=set(match.rows.values()))
        claims: dict[int, list[str]] = {}
        for student in students:
            if student.key in match.rows:
                continue
            marked = {row for mark in rule.of_own(student) for row in rows.get(mark, ())}
            fit = {row for row in marked if rule.fits is None or rule.fits(student, lines[row])}
            if len(fit) == 1:
                claims.setdefault(fit.pop(), []).append(student.key)
            elif fit:
                match.doubtful.add(student.key)
        for row, keys in claims.items():
            if len(keys) > 1:
                match.doubtful.update(keys)
                continue
            match.rows[keys[0]] = row
            if rule.by_name:
                match.by_name.add(keys[0])


def sure_rules(system: System, students: Sequence[Student], roster: Roster) -> Iterator[MatchRule]:
    """Yield how a submission is found by more than a name, the surest rule first.

    Moodle's and Canvas' numbers mean something only where the roster has them too: a small number
    of another list would be somebody else's.
    """
    numbered = system in ("moodle", "canvas")
    if system == roster.kind and numbered:
        yield _by_number(students, roster)
    if system == "github_classroom":
        yield MatchRule(_username, _username)
        yield MatchRule(_tails, _username)
    if not numbered:
        for marks in (_id_number, _username, _email):
            yield MatchRule(_own_marks, marks)
        yield MatchRule(_own_marks, _key)
        yield MatchRule(_own_marks, _mailbox)


def fallback_rules(system: System, roster: Roster) -> Iterator[MatchRule]:
    """Yield the rules that are taken for what is no group's either."""
    if system == roster.kind and system in ("moodle", "canvas"):
        yield MatchRule(_number, _number, fits=_is_nameless)
    yield from NAME_RULES


def rules_for_people(
    system: System, students: Sequence[Student], roster: Roster
) -> Iterator[MatchRule]:
    """Yield how students of whom more is known than their folder's name are found in a sheet."""
    if system == roster.kind and system in ("moodle", "canvas"):
        yield _by_number(students, roster)
    for marks in (_id_number, _email, _username):
        yield MatchRule(marks, marks)
    yield from fallback_rules(system, roster)


def names_agree(own: Student, line: Student) -> bool:
    """Whether two names can be one person's: a word in common, or the same letters."""
    return bool({*_words(own)} & {*_words(line)}) or is_same_name(own, line)


def is_same_name(own: Student, line: Student) -> bool:
    """Whether two names have the same letters: Korean names are written in two orders."""
    return Counter("".join(_words(own))) == Counter("".join(_words(line)))


def folded(name: str) -> str:
    """Return a name without accents and capitals."""
    plain = unicodedata.normalize("NFKD", name.casefold())
    return "".join(c for c in plain if not unicodedata.category(c).startswith("M"))


def _by_number(students: Sequence[Student], roster: Roster) -> MatchRule:
    """Return the rule by the system's own number.

    The number of a Moodle group is a participant's number as well. So the names must agree if the
    roster has groups, or if the names of most numbers do not agree (nobody's name has changed then).
    """
    lines = {mark: line for line in roster.students for mark in _number(line)}
    pairs = [(one, lines[mark]) for one in students for mark in _number(one) if mark in lines]
    agree = sum(names_agree(*pair) or _is_nameless(*pair) for pair in pairs)
    groups = any(line.group for line in roster.lines)
    moodle = roster.kind == "moodle" and (groups or 2 * agree < len(pairs))
    return MatchRule(_number, _number, fits=names_agree if moodle else None)


def _is_nameless(own: Student, line: Student) -> bool:
    """Whether one of the two has no name but the number: a blind marker sees no other."""
    return line.name in ("", line.key) or own.name.endswith(f" {own.key}") or own.name == own.key


def _rows_by_mark(
    rule: MatchRule, lines: Sequence[Student], *, without: set[int]
) -> dict[str, list[int]]:
    rows: dict[str, list[int]] = {}
    for row, student in enumerate(lines):
        if row not in without:
            for mark in set(rule.of_line(student)):
                rows.setdefault(mark, []).append(row)
    return rows


def _own_marks(student: Student) -> Iterator[str]:
    for value in (student.key, student.id_number, student.username, student.email):
        yield from _mark(value)


def _mark(value: str) -> tuple[str, ...]:
    value = unicodedata.normalize("NFC", value).strip().casefold()
    return (value,) if value else ()


def _key(student: Student) -> tuple[str, ...]:
    return _mark(student.key)


def _number(student: Student) -> tuple[str, ...]:
    return _mark(student.key.lstrip("0"))


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


def _words(student: Student) -> list[str]:
    spaced = "".join(c if c.isalnum() else " " for c in folded(student.name))
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


NAME_RULES = (
    MatchRule(_sorted_words, _sorted_words, by_name=True),
    MatchRule(_one_word, _words_in_any_order, by_name=True),
)
