"""The names of the students' feedback files: a person finds a student by the name, in any script."""

from __future__ import annotations

import hashlib
import unicodedata
from collections import Counter
from collections.abc import Iterable

from grader.batch.model import Student
from grader.publish.pages.names import RESERVED

MOST_BYTES = 120  # of UTF-8: a file system allows 255, a zip or a mail client may add to it
KEPT = ("L", "M", "N")  # letters, marks and digits (Unicode, general categories)
DIGITS = 8


def feedback_names(students: Iterable[Student]) -> dict[str, str]:
    """Return a file name without its ending for each student, by key: name and number.

    Two students never share one, also where upper and lower case are the same.
    """
    all_ = list(students)
    names = {student.key: _name(student) for student in all_}
    counts = Counter(_folded(name) for name in names.values())
    return {
        key: f"{name}-{_digest(key)}" if counts[_folded(name)] > 1 or _is_taken(name) else name
        for key, name in names.items()
    }


def _name(student: Student) -> str:
    own = _safe(student.name)
    number = _safe(student.id_number or student.key)
    parts = [own] if number in ("", own) else [own, number]
    name = "_".join(part for part in parts if part)
    return name or f"student-{_digest(student.key)}"


def _safe(text: str) -> str:
    """Return a text without what a file system, a shell or the direction of writing makes of it."""
    letters = [
        letter if unicodedata.category(letter)[0] in KEPT else " "
        for letter in unicodedata.normalize("NFC", text)
    ]
    name = "_".join("".join(letters).split()).lstrip("".join(_marks(letters)))
    return _cut(name)


def _marks(letters: Iterable[str]) -> Iterable[str]:
    """Yield the marks among letters: a name does not begin with one."""
    return {letter for letter in letters if unicodedata.category(letter)[0] == "M"}


def _cut(name: str) -> str:
    """Return a name of at most MOST_BYTES, cut between two letters."""
    while len(name.encode("utf-8", "surrogatepass")) > MOST_BYTES:
        name = name[:-1]
    return name


def _is_taken(name: str) -> bool:
    """Whether a name is reserved, or looks like one that is made here."""
    end = name.rpartition("-")[2]
    return bool(RESERVED.fullmatch(name)) or (len(end) == DIGITS and end != name)


def _folded(name: str) -> str:
    return unicodedata.normalize("NFKC", name).casefold()


def _digest(key: str) -> str:
    return hashlib.sha256(key.encode("utf-8", "surrogatepass")).hexdigest()[:DIGITS]
