"""Students of the roster without a submission, found again in the ledger: they handed in before."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from grader.batch.ledger import Ledger
from grader.batch.model import Student


class HandedInBefore:
    """Who has earlier attempts in the ledger, under which key.

    A roster's key need not be the one that the submission gave: that may have been a folder's name.
    """

    def __init__(
        self,
        ledger: Ledger,
        assignment: str,
        present: Collection[str],
        earlier: Collection[str],
    ) -> None:
        """`present` are the keys of those who have a submission now, `earlier` of those who had."""
        self._earlier = earlier
        self._keys: dict[tuple[str, str], set[str]] = {}
        for student in ledger.students(assignment):
            if student.key in earlier and student.key not in present:
                for mark in _marks(student):
                    self._keys.setdefault(mark, set()).add(student.key)

    def as_known(self, student: Student) -> Student:
        """Return the student with the key of the earlier attempts, if exactly one key fits."""
        if student.key in self._earlier:
            return student
        keys = {key for mark in _marks(student) for key in self._keys.get(mark, ())}
        return replace(student, key=keys.pop()) if len(keys) == 1 else student


def _marks(student: Student) -> list[tuple[str, str]]:
    values = {
        "id number": student.id_number,
        "email": student.email,
        "username": student.username,
    }
    return [(what, value.casefold()) for what, value in values.items() if value]
