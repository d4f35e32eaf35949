"""Submissions and students that were not joined, because it is not clear which belong together."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from grader.base.i18n.message import say, say_plural, some_of
from grader.base.plain_text import one_line
from grader.batch.match import possible_names, written_names
from grader.batch.model import Student

MOST_NAMED = 5


@dataclass(frozen=True)
class Unclear:
    """The keys of submissions and the rows of students that may belong together, and why."""

    reason: str
    keys: frozenset[str]
    rows: frozenset[int]


def unclear_groups(
    candidates: Mapping[str, set[int]],
    submissions: Mapping[str, Student],
    students: Sequence[Student],
) -> list[Unclear]:
    """Return the groups of submissions that may be of the same students.

    `candidates` are the possible rows of each submission, by its key.
    """
    groups: list[tuple[set[str], set[int]]] = []
    for key, rows in candidates.items():
        joined = [group for group in groups if group[1] & rows]
        groups = [group for group in groups if group not in joined]
        keys = {key}.union(*(group[0] for group in joined))
        groups.append((keys, set(rows).union(*(group[1] for group in joined))))
    found = []
    for keys, rows in groups:
        handed_in = [one for key, one in submissions.items() if key in keys]
        reason = _reason(handed_in, [students[row] for row in sorted(rows)])
        found.append(Unclear(reason, frozenset(keys), frozenset(rows)))
    return found


def _reason(handed_in: list[Student], students: list[Student]) -> str:
    name = one_line(handed_in[0].name, most=60)
    names = {own for one in handed_in for own in written_names(one)}
    same = all(names & set(possible_names(one)) for one in students)
    parts = {
        "name": name,
        "students": say_plural("{count} student", "{count} students", len(students)),
        "who": _listed(_identity(one) for one in students),
        "submissions": say_plural("{count} submission", "{count} submissions", len(handed_in)),
        "folders": _listed(f"'{one_line(one.key, most=60)}'" for one in handed_in),
    }
    if same:
        return say(
            "{name}: {students} of this name ({who}), {submissions} ({folders}). It is not known "
            "whose it is: nothing was joined, and no grade is given",
            **parts,
        )
    return say(
        "{name}: {students} that fit ({who}), {submissions} ({folders}). It is not known whose it "
        "is: nothing was joined, and no grade is given",
        **parts,
    )


def _identity(student: Student) -> str:
    return student.id_number or student.email or student.username or student.key


def _listed(names: Iterable[str]) -> str:
    return some_of([one_line(name, most=60) for name in names], MOST_NAMED)
