"""Which column of a roster is what: the headers of the courses' systems, and common ones."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from grader.gradebook.moodle_words import IDENTIFIER
from grader.gradebook.sheet import Sheet

Kind = Literal["moodle", "canvas", "gradescope", "github_classroom", "plain"]

NAMES: Mapping[str, tuple[str, ...]] = {
    "name": (
        *("name", "full name", "fullname", "student name", "student", "display name"),
        *("vollständiger name", "nom complet", "nombre completo", "nome completo"),
    ),
    "first name": ("first name", "firstname", "given name", "forename", "first", "vorname"),
    "last name": ("last name", "lastname", "surname", "family name", "last", "nachname"),
    "email": (
        *("email", "e-mail", "email address", "e-mail address", "mail", "student email"),
        *("e-mail-adresse", "adresse de courriel", "dirección de correo", "indirizzo email"),
    ),
    "username": (
        *("username", "user name", "login", "login id", "sis login id", "github username"),
        *("user", "account", "netid", "net id", "anmeldename"),
    ),
    "id number": (
        *("id number", "idnumber", "sid", "student id", "student number", "sis user id"),
        *("sis id", "matriculation number", "matrikelnummer", "id-nummer", "id", "number"),
    ),
    "section": ("section", "sections", "section name", "group", "groups", "class", "gruppe"),
    "submitted": ("submission timestamp",),  # of Classroom's "Download grades"
}
KNOWN = tuple(name for names in NAMES.values() for name in names)
PARTICIPANT = re.compile(r"[^\W\d_][^\d]*?\s*(\d+)")  # a word in any language, then the number
EMAIL = re.compile(r"[^@\s]+@[^@\s]+\.[^@\s]+")
PEEKED = 50  # rows


@dataclass(frozen=True)
class Columns:
    """The columns of each field, the best one first, and whose export it is."""

    kind: Kind
    fields: Mapping[str, tuple[int, ...]]

    def of(self, field: str) -> tuple[int, ...]:
        """Return the columns in which a field may stand."""
        return self.fields.get(field, ())

    @property
    def tells_people_apart(self) -> bool:
        """Whether there is anything by which a student is known."""
        known = ("key", "name", "last name", "email", "username", "id number")
        return any(self.of(field) for field in known)


def columns_of(sheet: Sheet) -> Columns:
    """Return what the columns of a sheet are."""
    header = [_folded(name) for name in sheet.header]
    fields = {
        field: tuple(i for name in names for i, head in enumerate(header) if head == name)
        for field, names in NAMES.items()
    }
    kind, key = _kind(sheet, header)
    if key is not None:
        fields = {
            field: tuple(index for index in found if index != key)
            for field, found in fields.items()
        }
        fields["key"] = (key,)
    if not fields["email"]:
        fields["email"] = _looks_like_email(sheet, header)
    if kind == "moodle" and not (fields["name"] or fields["last name"]) and key is not None:
        fields["name"] = _beside(sheet, key, fields["email"])
    return Columns(kind, fields)


def _folded(name: str) -> str:
    return " ".join(name.casefold().replace("_", " ").split())


def _kind(sheet: Sheet, header: list[str]) -> tuple[Kind, int | None]:
    """Return whose export it is, and the column of that system's own number."""
    for index, name in enumerate(header):
        values = [value for value in sheet.column(index)[:PEEKED] if value]
        if name in IDENTIFIER and values and all(PARTICIPANT.fullmatch(v) for v in values):
            # (`student 1`, `student 2` are somebody's own numbers: Moodle has a column of grades)
            return "moodle", index
    if header[:1] == ["student"] and "id" in header and "section" in header:
        return "canvas", header.index("id")
    for name in ("identifier", "roster identifier"):  # of the roster, and of the grades
        if name in header and "github username" in header:
            return "github_classroom", header.index(name)
    if "sid" in header and "email" in header:
        return "gradescope", None
    return "plain", None


def _looks_like_email(sheet: Sheet, header: list[str]) -> tuple[int, ...]:
    """Return a column of addresses, whatever it is called."""
    for index in range(len(header)):
        values = [value for value in sheet.column(index)[:PEEKED] if value]
        if values and all(EMAIL.fullmatch(value) for value in values):
            return (index,)
    return ()


def _beside(sheet: Sheet, key: int, email: tuple[int, ...]) -> tuple[int, ...]:
    """Return the column after Moodle's number, where the full name is in every language."""
    index = key + 1
    values = [value for value in sheet.column(index)[:PEEKED] if value]
    named = values and index not in email and all(len(value.split()) > 1 for value in values)
    return (index,) if named else ()


def participant(text: str) -> str:
    """Return the number in Moodle's `Participant 123`, "" if there is none."""
    match = PARTICIPANT.fullmatch(text)
    return match[1] if match else ""
