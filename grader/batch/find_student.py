"""Finds a student by key, id number, name, email address or user name.

A name that several have finds nobody, even if a folder of that name is the key of one of them.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Sequence

from grader.base.errors import UsageError
from grader.base.nearest import nearest
from grader.batch.match import possible_names, written_names
from grader.batch.model import Student

MOST_NAMED = 5


def find_student(word: str, students: Sequence[Student]) -> Student:
    """Return the one student whom `word` identifies.

    Raises UsageError if it is nobody or more than one student, with the possible ones.
    """
    named = set(written_names(Student("", word)))
    same = [student for student in students if named & set(possible_names(student))]
    for words in (_exact, _loose):
        found = [student for student in students if word.strip() in words(student)]
        if not found:
            found = [s for s in students if _folded((word,)) & _folded(words(s))]
        if found and len(same) > 1 and any(student in same for student in found):
            found = same
        if len(found) == 1:
            return found[0]
        if found:
            keys = ", ".join(f"{s.key} ({s.name})" for s in found[:MOST_NAMED])
            raise UsageError(
                f"'{word}' fits more than one student: {keys}",
                remedy="Name one by key, id number or email address.",
            )
    known = {name: student for student in students for name in _loose(student) if name}
    close = nearest(word, known)
    hint = (
        f"Did you mean '{close}'?" if close else "The first column of gradebook.csv has the keys."
    )
    raise UsageError(f"there is no student '{word}'", remedy=hint)


def _exact(student: Student) -> tuple[str, ...]:
    return (student.key,)


def _loose(student: Student) -> tuple[str, ...]:
    return (student.name, student.email, student.username, student.id_number, student.key)


def _folded(words: Sequence[str]) -> set[str]:
    return {unicodedata.normalize("NFC", word.strip()).casefold() for word in words if word}
