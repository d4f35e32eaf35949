"""Finds students of the roster without a submission in the ledger: they handed in earlier."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from grader.batch.ledger import Ledger
from grader.batch.model import Student


class EarlierSubmissions:
    """The keys under which students have earlier attempts in the ledger.

    The roster may give a student another key than the submission did (a folder's name, say).
    """

    def __init__(
        self,
        ledger: Ledger,
        assignment: str,
        present: Collection[str],
        earlier: Collection[str],
    ) -> None:
        """`present`: keys with a submission now; `earlier`: keys with one in the ledger."""
        self._earlier = earlier
        self._keys: dict[tuple[str, str], set[str]] = {}
        for student in ledger.students(assignment):
            if student.key in earlier and student.key not in present:
                for identifier in _identifiers(student):
                    self._keys.setdefault(identifier, set()).add(student.key)

    def with_known_key(self, student: Student) -> Student:
        """Return the student with the key of the earlier attempts, if exactly one key fits."""
        if student.key in self._earlier:
            return student
        keys = {key for one in _identifiers(student) for key in self._keys.get(one, ())}
        return replace(student, key=keys.pop()) if len(keys) == 1 else student


def _identifiers(student: Student) -> list[tuple[str, str]]:
    values = {
        "id number": student.id_number,
        "email": student.email,
        "username": student.username,
    }
    return [(what, value.casefold()) for what, value in values.items() if value]
