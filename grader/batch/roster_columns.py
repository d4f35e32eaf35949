"""Recognises the columns of a roster by the headers of the systems, and by common ones."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from grader.batch.roster_guess import PARTICIPANT_SYSTEM, guessed
from grader.batch.sheet import Sheet, folded_header
from grader.batch.systems.known import SYSTEMS
from grader.batch.systems.moodle.words import TEAM
from grader.batch.systems.system import RosterForm, System

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
PLAIN_FORM = RosterForm(key=lambda _sheet, _header: None)
KNOWN = tuple(name for names in NAMES.values() for name in names)


@dataclass(frozen=True)
class RosterColumns:
    """The columns of each field, the best one first, and which system exported them, if any.

    `guesses` describes the columns that were recognised by their content, `unknown` are those that
    were not recognised.
    """

    system: System | None
    fields: Mapping[str, tuple[int, ...]]
    guesses: tuple[str, ...] = ()
    unknown: tuple[int, ...] = ()

    @property
    def form(self) -> RosterForm:
        """How a list of that system is read."""
        return form_of(self.system)

    def of(self, field: str) -> tuple[int, ...]:
        """Return the columns that may contain a field."""
        return self.fields.get(field, ())

    @property
    def identifies_students(self) -> bool:
        """Whether a column identifies a student."""
        known = ("key", "name", "last name", "email", "username", "id number")
        return any(self.of(field) for field in known)


def columns_of(sheet: Sheet, *, exported: tuple[System, int] | None = None) -> RosterColumns:
    """Return the columns of a sheet, recognised by their names, or else by their content.

    `exported` is the system that exported the sheet, and the column of its identifiers, if known.
    """
    header = [folded_header(name) for name in sheet.header]
    fields = fields_by_name(header)
    system, key = _exported_by(sheet, header) if exported is None else exported
    if key is not None:
        fields = {
            field: tuple(index for index in found if index != key)
            for field, found in fields.items()
        }
        fields["key"] = (key,)
    unknown = [i for i, name in enumerate(header) if not _is_known(name) and i != key]
    guesses = guessed(sheet, unknown, {field for field, found in fields.items() if found})
    fields |= {field: (index,) for field, index in guesses.items()}
    if "key" in guesses:  # by its content: `Participant 123`
        system = SYSTEMS[PARTICIPANT_SYSTEM]
    form = form_of(system)
    own = {field: named_columns(header, tuple(names)) for field, names in form.fields.items()}
    fields |= {field: columns or fields.get(field, ()) for field, columns in own.items()}
    described = (f"'{sheet.header[index]}' as {field}" for field, index in guesses.items())
    rest = tuple(index for index in unknown if index not in guesses.values())
    return RosterColumns(system, fields, tuple(described), rest)


def fields_by_name(header: list[str]) -> dict[str, tuple[int, ...]]:
    """Return the columns of each field by their names alone; `header`: see `folded_header`."""
    fields = {field: named_columns(header, names) for field, names in NAMES.items()}
    if folded_header("성") in header:  # `이름` beside it is the given name
        given = named_columns(header, ("이름",))
        fields["first name"] += given
        fields["name"] = tuple(index for index in fields["name"] if index not in given)
    return fields


def form_of(system: System | None) -> RosterForm:
    """Return how a roster that a system exported is read; None: no system did."""
    return system.roster if system is not None and system.roster is not None else PLAIN_FORM


def named_columns(header: list[str], names: tuple[str, ...]) -> tuple[int, ...]:
    """Return the columns with one of these names, in the order of the names."""
    folded = [folded_header(name) for name in names]
    return tuple(i for name in folded for i, head in enumerate(header) if head == name)


_FOLDED = frozenset(map(folded_header, KNOWN))


def _is_known(name: str) -> bool:
    forms = (system.roster for system in SYSTEMS.values() if system.roster is not None)
    return name in _FOLDED or any(form.is_header(name) for form in forms)


def _exported_by(sheet: Sheet, header: list[str]) -> tuple[System | None, int | None]:
    """Return which system exported a sheet, and the column of that system's own identifier."""
    for system in SYSTEMS.values():
        found = system.roster.key(sheet, header) if system.roster is not None else None
        if found is not None:
            return system, found.column
    return None, None
