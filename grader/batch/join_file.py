"""The join as a CSV file: which file is whose. An instructor corrects it and gives it back.

The columns are the same in both directions: `file,student,name,section,joined,why`. Only `file` and
`student` are read. An empty `student` leaves the file to the grader, `-` leaves the file out, and
several rows with one file are the members of a group.
"""

from __future__ import annotations

import csv
import io
import unicodedata
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.base.plain_text import one_line
from grader.batch import cells
from grader.batch.find_student import StudentIndex
from grader.batch.instructor_csv import InstructorCsv, did_you_mean, raise_all, read_csv
from grader.batch.join import BY_NAME, STRANGER, Pinned
from grader.batch.model import ClassFolder, HandedIn
from grader.batch.roster import Roster
from grader.batch.sheet import folded_header
from grader.batch.systems.notes import printable

JOIN_FILE = "join.csv"
COLUMNS = ("file", "student", "name", "section", "joined", "why")
NOBODY = ("-", cells.text("-"))  # (the second as a cell that no spreadsheet runs)
WHAT = "the join file"
LEFT_OUT = say("left out, as the join file says")
JoinState = Literal[
    "yes", "by name", "unsure", "stranger", "missing", "elsewhere", "left out", "no roster"
]


@dataclass(frozen=True)
class JoinRow:
    """One file and its student, a student without a file, or a file without a student ("")."""

    file: str
    student: str
    name: str
    section: str
    joined: JoinState
    why: str = ""


def join_rows(folder: ClassFolder) -> list[JoinRow]:
    """Return every file of a class with its student, and the students without one at the end."""
    names = file_names(one.path for one in folder.handed_in)
    rows = [_row(one, names[one.path], folder) for one in folder.handed_in]
    for student in folder.missing:
        known = folder.elsewhere.get(student.key)
        state: JoinState = "missing" if known is None else "elsewhere"
        if known is not None and known.is_unclear:
            state = "unsure"
        word = folder.on_list.get(student.key, student.key)
        why = known.reason if known is not None else ""
        rows.append(JoinRow("", word, student.name, student.section, state, why))
    rows += [JoinRow(name, NOBODY[0], "", "", "left out", LEFT_OUT) for name in folder.left_out]
    return rows


def _row(one: HandedIn, file: str, folder: ClassFolder) -> JoinRow:
    who = one.student
    if folder.on_roster is None:
        return JoinRow(file, who.key, who.name, who.section, "no roster")
    word = folder.on_list.get(who.key, "")
    if one.unclear:
        return JoinRow(file, "", who.name, who.section, "unsure", one.unclear)
    if STRANGER in one.notes or not word:
        return JoinRow(file, "", who.name, who.section, "stranger", STRANGER)
    if BY_NAME in one.notes:
        return JoinRow(file, word, who.name, who.section, "by name", BY_NAME)
    return JoinRow(file, word, who.name, who.section, "yes")


def join_csv(rows: Iterable[JoinRow]) -> bytes:
    """Return the rows as a CSV file in UTF-8, with the byte order mark by which Excel knows it."""
    out = io.StringIO()
    table = csv.writer(out, quoting=csv.QUOTE_ALL)
    table.writerow(COLUMNS)
    for row in rows:
        who = (row.file, row.student, row.name, row.section, row.joined, row.why)
        table.writerow([cells.text(value) for value in who])
    return out.getvalue().encode("utf-8-sig")


def file_names(paths: Iterable[Path]) -> dict[Path, str]:
    """Return a short name for each path: its last part, and more of it if several have that."""
    left = dict.fromkeys(paths)
    most = max((len(path.parts) for path in left), default=0)
    found: dict[Path, str] = {}
    for length in range(1, most + 1):
        short = {path: "/".join(path.parts[-length:]) for path in left}
        counts = Counter(short.values())
        single = [path for path in left if counts[short[path]] == 1 or length == most]
        found |= {path: printable_path(short[path]) for path in single}
        left = {path: None for path in left if path not in found}
    return found


def printable_path(path: str) -> str:
    """Return a relative path as printable text."""
    return "/".join(printable(part) for part in path.split("/"))


class GivenJoin:
    """A join file that an instructor gave back: the words that name the students of each file."""

    def __init__(self, path: Path, *, is_remembered: bool = False) -> None:
        """Read the file; raise UsageError, with its line, if it cannot be used.

        `is_remembered`: it was given in an earlier run, and what no longer fits is ignored.
        """
        self._file = read_csv(path, WHAT)
        self.is_remembered = is_remembered
        self.name = f"{WHAT} {self._file.name}"
        self._files = _column(self._file, "file")
        self._words = _column(self._file, "student")

    def pinned(
        self, handed_in: Sequence[HandedIn], roster: Roster
    ) -> tuple[list[HandedIn], list[Pinned], list[str]]:
        """Return the submissions to be matched, those with given students, and files left out.

        Raises UsageError with the lines that name an unknown file or student, or contradict others.
        """
        names = file_names(one.path for one in handed_in)
        known = by_name(names)
        rows = self._rows(known, names, StudentIndex(roster.students))
        rest = [one for one in handed_in if one.path not in rows]
        given = [Pinned(one, rows[one.path]) for one in handed_in if rows.get(one.path)]
        out = [name for path, name in names.items() if rows.get(path) == ()]
        return rest, given, out

    def _rows(
        self, known: Mapping[str, Path], names: Mapping[Path, str], index: StudentIndex
    ) -> dict[Path, tuple[int, ...]]:
        """Return the rows of the roster for each file with a statement; (): it is left out."""
        found: dict[Path, dict[int | None, int]] = {}
        errors: list[str] = []
        for row in range(1, len(self._file.sheet.rows)):
            file, word = self._cell(row, self._files), self._cell(row, self._words)
            try:
                path = self._path(file, known, names) if file else None
                # (a cell that a spreadsheet would run has an apostrophe before it)
                who = index.find(word.removeprefix("'")) if word not in ("", *NOBODY) else None
                if path is not None and word:
                    _add(found.setdefault(path, {}), who, row, self._file)
            except UsageError as error:
                if self.is_remembered:
                    continue
                errors.append(f"{self._file.place(row)}: {error.message}{_hint(error)}")
        raise_all(errors, f"Correct {self.name}; `grader grade-all … --dry-run` writes a new one.")
        return {path: tuple(one for one in rows if one is not None) for path, rows in found.items()}

    def _cell(self, row: int, column: int) -> str:
        return one_line(self._file.sheet.value(row, column), most=cells.MOST)

    @staticmethod
    def _path(file: str, known: Mapping[str, Path], names: Mapping[Path, str]) -> Path:
        path = known.get(composed(file))
        if path is None:
            near = did_you_mean(file, names.values())
            raise UsageError(f"there is no submission '{file}' in this class{near}")
        return path


def _add(rows: dict[int | None, int], who: int | None, row: int, file: InstructorCsv) -> None:
    """Add what a row says of a file; raise UsageError if another row says it too, or the opposite."""
    if who in rows:
        raise UsageError(f"line {file.line(rows[who])} says the same of this file")
    if rows and (who is None or None in rows):
        other = file.line(next(iter(rows.values())))
        raise UsageError(f"this line and line {other} contradict each other: '-' leaves a file out")
    rows[who] = row


def _hint(error: UsageError) -> str:
    return f" ({error.remedy})" if error.remedy else ""


def by_name(names: Mapping[Path, str]) -> dict[str, Path]:
    """Return the paths by their names, also as they are written in a cell."""
    return {
        composed(text): path for path, name in names.items() for text in (cells.text(name), name)
    }


def composed(name: str) -> str:
    """Return a name with composed characters: other systems and spreadsheets decompose them."""
    return unicodedata.normalize("NFC", name)


def _column(file: InstructorCsv, name: str) -> int:
    header = [folded_header(one) for one in file.sheet.header]
    if header.count(name) == 1:
        return header.index(name)
    near = next((f" (is it '{one}'?)" for one in header if did_you_mean(name, [one])), "")
    fault = "has no column" if name not in header else "has several columns"
    raise UsageError(
        f"{file.place(0)}: it {fault} '{name}'{near}",
        remedy=f"The columns are {', '.join(COLUMNS)}; only file and student are read.",
    )
