"""Recognises the columns of a roster by the headers of the systems, and by common ones."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from grader.batch.roster_guess import PARTICIPANT, PEEKED, guessed
from grader.batch.sheet import Sheet
from grader.batch.systems.moodle.words import (
    FEEDBACK,
    GRADE,
    IDENTIFIER,
    MAXIMUM,
    STATUS,
    SUBMITTED_ON,
    TEAM,
)

RosterKind = Literal["moodle", "canvas", "gradescope", "github_classroom", "plain"]

NAMES: Mapping[str, tuple[str, ...]] = {
    "name": (
        *("name", "full name", "fullname", "student name", "student", "display name"),
        *("vollständiger name", "nom complet", "nombre completo", "nome completo"),
        *(
            "성명",
            "이름",
            "전체 이름",
            "학생 이름",
            "학생명",
            "사용자 성명",
            "학생 성명",
            "학생",
            "성함",
        ),
    ),
    "first name": ("first name", "firstname", "given name", "forename", "first", "vorname"),
    "last name": ("last name", "lastname", "surname", "family name", "last", "nachname", "성"),
    "email": (
        *("email", "e-mail", "email address", "e-mail address", "mail", "student email"),
        *("e-mail-adresse", "adresse de courriel", "dirección de correo", "indirizzo email"),
        *("이메일", "이메일 주소", "전자우편", "전자우편 주소", "메일", "메일 주소", "e메일"),
    ),
    "username": (
        *("username", "user name", "login", "login id", "sis login id", "github username"),
        *("user", "account", "netid", "net id", "anmeldename"),
        *("사용자 아이디", "아이디", "사용자 id", "사용자명", "사용자 이름", "계정"),
    ),
    "id number": (
        *("id number", "idnumber", "sid", "student id", "student number", "sis user id"),
        *("sis id", "matriculation number", "matrikelnummer", "id-nummer", "학번", "학생 번호"),
        *("id 번호", "식별 번호", "id", "number"),
    ),
    "section": ("section", "sections", "section name", "class", "분반", "반"),
    "group": tuple(sorted(TEAM)),
    "submitted": ("submission timestamp",),  # of Classroom's "Download grades"
}
MOODLES: Mapping[str, frozenset[str]] = {
    "status": STATUS,
    "submitted on": SUBMITTED_ON,
    "grade": GRADE,
}
KNOWN = tuple(name for names in NAMES.values() for name in names)


@dataclass(frozen=True)
class RosterColumns:
    """The columns of each field, the best one first, and which system exported them.

    `guesses` describes the columns that were recognised by their content, `unknown` are those that
    were not recognised.
    """

    kind: RosterKind
    fields: Mapping[str, tuple[int, ...]]
    guesses: tuple[str, ...] = ()
    unknown: tuple[int, ...] = ()

    def of(self, field: str) -> tuple[int, ...]:
        """Return the columns that may contain a field."""
        return self.fields.get(field, ())

    @property
    def identifies_students(self) -> bool:
        """Whether a column identifies a student."""
        known = ("key", "name", "last name", "email", "username", "id number")
        return any(self.of(field) for field in known)


def columns_of(sheet: Sheet, *, participants: int | None = None) -> RosterColumns:
    """Return the columns of a sheet, recognised by their names, or else by their content.

    `participants` is the column of Moodle's identifiers, if it is known.
    """
    header = [_folded(name) for name in sheet.header]
    fields = {field: _named(header, names) for field, names in NAMES.items()}
    if _folded("성") in header:  # `이름` beside it is the given name
        given = _named(header, ("이름",))
        fields["first name"] += given
        fields["name"] = tuple(index for index in fields["name"] if index not in given)
    kind, key = _kind(sheet, header) if participants is None else ("moodle", participants)
    if key is not None:
        fields = {
            field: tuple(index for index in found if index != key)
            for field, found in fields.items()
        }
        fields["key"] = (key,)
    unknown = [i for i, name in enumerate(header) if not _is_known(name) and i != key]
    guesses = guessed(sheet, unknown, {field for field, found in fields.items() if found})
    fields |= {field: (index,) for field, index in guesses.items()}
    if "key" in guesses:
        kind = "moodle"
    if kind == "moodle":
        fields |= _of_moodle(header, fields)
    described = (f"'{sheet.header[index]}' as {field}" for field, index in guesses.items())
    rest = tuple(index for index in unknown if index not in guesses.values())
    return RosterColumns(kind, fields, tuple(described), rest)


def _of_moodle(
    header: list[str], fields: Mapping[str, tuple[int, ...]]
) -> dict[str, tuple[int, ...]]:
    """Return the worksheet's columns that say whether Moodle has a submission or a grade."""
    found = {field: _named(header, tuple(names)) for field, names in MOODLES.items()}
    return {field: columns or fields.get(field, ()) for field, columns in found.items()}


def _named(header: list[str], names: tuple[str, ...]) -> tuple[int, ...]:
    folded = [_folded(name) for name in names]
    return tuple(i for name in folded for i, head in enumerate(header) if head == name)


def _folded(name: str) -> str:
    words = name.casefold().replace("_", " ").split()
    # spaces between Korean words are optional: 이메일 주소, 이메일주소
    return (" " if name.isascii() else "").join(words)


_FOLDED = frozenset(
    _folded(name)
    for names in (KNOWN, GRADE, FEEDBACK, IDENTIFIER, STATUS, SUBMITTED_ON)
    for name in names
)


def _is_known(name: str) -> bool:
    return name in _FOLDED or MAXIMUM.search(name) is not None


def _kind(sheet: Sheet, header: list[str]) -> tuple[RosterKind, int | None]:
    """Return which system exported a sheet, and the column of that system's own number."""
    identifiers = {_folded(name) for name in IDENTIFIER}
    for index, name in enumerate(header):
        values = [value for value in sheet.column(index)[:PEEKED] if value]
        if name in identifiers and values and all(PARTICIPANT.fullmatch(v) for v in values):
            # (`student 1`, `student 2` below another header are somebody's own numbers)
            return "moodle", index
    split = header[:2] == ["lastname", "firstname"]
    if (header[:1] == ["student"] or split) and "id" in header and "section" in header:
        return "canvas", header.index("id")
    for name in ("identifier", "roster identifier"):  # in the roster, and in the grades
        if name in header and "github username" in header:
            return "github_classroom", header.index(name)
    if "sid" in header and "email" in header:
        return "gradescope", None
    return "plain", None


def participant(text: str) -> str:
    """Return the number in Moodle's `Participant 123`, "" if there is none."""
    match = PARTICIPANT.fullmatch(text)
    return match[2] if match else ""
