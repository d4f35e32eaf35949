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


class StudentIndex:
    """Finds many students of one list, each as `find_student` does."""

    def __init__(self, students: Sequence[Student]) -> None:
        self._students = students
        self._rows: dict[str, set[int]] = {}
        for row, student in enumerate(students):
            words = _folded((student.key, student.email, student.username, student.id_number))
            for word in {*words, *possible_names(student)}:
                self._rows.setdefault(word, set()).add(row)

    def find(self, word: str) -> int:
        """Return the place of the student whom `word` identifies; raise UsageError as above."""
        rows = self._fit(word)
        if len(rows) == 1:
            return rows.pop()
        return self._students.index(find_student(word, self._students))

    def word_for(self, row: int) -> str:
        """Return the word that identifies a student: what a spreadsheet does not change comes first."""
        one = self._students[row]
        words = (one.email, one.username, one.id_number, one.key)
        return next((word for word in words if word and self._fit(word) == {row}), one.key)

    def _fit(self, word: str) -> set[int]:
        words = {*_folded((word,)), *written_names(Student("", word))}
        return {row for one in words for row in self._rows.get(one, ())}


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
