"""Downloads of Moodle and Canvas for one class: the zip of submissions and the matching list.

Moodle follows mod/assign/gradingtable.php (columns, status, group), feedback/offline/locallib.php
and classes/downloader.php (`clean_filename` of lib/moodlelib.php); Canvas lib/content_zipper.rb and
lib/gradebook_exporter.rb. The terms are those of Moodle's English and Korean language packs.
"""

from __future__ import annotations

import csv
import io
import re
import zipfile
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from tests.batch.archives import package, zipped
from tests.pages.classes import FIRST, LAST

DATE = "Friday, 20 November 2026, 7:00 PM"
BOM = b"\xef\xbb\xbf"


@dataclass(frozen=True)
class Words:
    """Terms of a language pack; `participant` is `hiddenuser`, followed by the number."""

    header: tuple[str, ...]
    group: str
    participant: str
    submitted: str
    nothing: str
    graded: str
    default_group: str
    yes: str


ENGLISH = Words(
    (
        *("Identifier", "Full name", "ID number", "Email address", "Status", "Grade"),
        *("Maximum Grade", "Grade can be changed", "Last modified (submission)"),
        *("Last modified (grade)", "Feedback comments"),
    ),
    "Group",
    "Participant ",
    "Submitted for grading",
    "No submission",
    "Graded",
    "Default group",
    "Yes",
)
KOREAN = Words(
    (
        *("식별자", "전체 이름", "id 번호", "이메일 주소", "상태", "성적", "최대 성적"),
        *("성적을 변경할 수 있음", "마지막 수정됨(제출)", "마지막 수정됨(성적)", "피드백 코멘트"),
    ),
    "모둠",
    "참가자 ",
    "채점을 위해 제출되었습니다.",
    "제출이 없습니다.",
    "채점됨",
    "기본 모둠",
    "예",
)
# the grader knows the letters of this language but not its terms
FINNISH = Words(
    (
        *(
            "Tunniste",
            "Koko nimi",
            "Tunnistenumero",
            "Osoite",
            "Tila",
            "Pisteet",
            "Enimmäispisteet",
        ),
        *("Pisteitä voi muuttaa", "Muokattu (palautus)", "Muokattu (pisteet)", "Palaute"),
    ),
    "Ryhmittely",
    "Osallistuja ",
    "Palautettu arvioitavaksi",
    "Ei palautusta",
    "Arvioitu",
    "Oletusryhmä",
    "Kyllä",
)
FAMILY = "김이박최정강조윤장임"
GIVEN = [
    "민지",
    "서연",
    "지우",
    "하은",
    "도윤",
    "시우",
    "예준",
    "하준",
    "지호",
    "수아",
    "채원",
    "은우",
]


@dataclass(frozen=True)
class Person:
    """A participant: `number` is Moodle's, `grade` the one already in the worksheet."""

    number: int
    name: str
    email: str
    id_number: str
    submitted: bool = True
    group: str = ""
    grade: str = ""

    @property
    def feedback(self) -> str:
        """The name of the feedback files, without their endings."""
        return "_".join([*self.name.split(), self.id_number])


def people(count: int, *, first: int = 1000, korean: bool = False) -> list[Person]:
    """Return `count` participants with different names."""
    found = []
    for n in range(count):
        name = f"{FAMILY[n % 10]}{GIVEN[n // 10]}" if korean else f"{FIRST[n % 10]} {LAST[n // 10]}"
        found.append(Person(first + n, name, f"s{n}@example.org", f"2026{n:04}"))
    return found


def marked(class_: Iterable[Person], grade: str) -> list[Person]:
    """Return the same participants with a grade in the worksheet."""
    return [replace(person, grade=grade) for person in class_]


def scored(score: float) -> dict[str, bytes]:
    """Return a package to which the stub worker gives this score."""
    return package(f"# score: {score}\n")


def worksheet(
    class_: Sequence[Person],
    words: Words = ENGLISH,
    *,
    encoding: str = "utf-8",
    bom: bool = False,
    end: str = "\r\n",
) -> bytes:
    """Return the grading worksheet, with a group column if any participant has a group."""
    groups = any(person.group for person in class_)
    header = [*words.header[:5], *([words.group] if groups else []), *words.header[5:]]
    out = io.StringIO()
    table = csv.writer(out, lineterminator=end)
    table.writerow(header)
    for person in class_:
        status = words.submitted if person.submitted else words.nothing
        status += f" - {words.graded}" if person.grade else ""
        start = (f"{words.participant}{person.number}", person.name, person.id_number, person.email)
        table.writerow(
            [
                *(*start, status, *([person.group] if groups else [])),
                *(person.grade, "100.00", words.yes, DATE if person.submitted else "-"),
                *(DATE if person.grade else "-", ""),
            ]
        )
    return (BOM if bom else b"") + out.getvalue().encode(encoding)


def clean_filename(name: str) -> str:
    """Return a name cleaned as by Moodle's PARAM_FILE."""
    return re.sub(r"[\x00-\x1f\x7f]|[&<>\"`|':\\/]", "", name)


def moodle_prefix(name: str, number: int | None) -> str:
    """Return the prefix of a submission's folder; the default group has no number."""
    escaped = re.sub(r"&(?![a-zA-Z0-9#]{1,8};)", "&amp;", name)  # format_string
    suffix = "" if number is None else f"_{number}"
    return clean_filename(escaped.replace("_", " ") + suffix)


def moodle_zip(path: Path, submissions: Iterable[tuple[str, int | None, dict[str, bytes]]]) -> Path:
    """Write "Download all submissions": the submitted zip of each person or group."""
    with zipfile.ZipFile(path, "w") as archive:
        for name, number, files in submissions:
            prefix = moodle_prefix(name, number)
            place = f"{prefix}_assignsubmission_file/package.zip"
            archive.writestr(place, zipped(files))
    return path


def of_people(
    class_: Iterable[Person], score: float = 90
) -> list[tuple[str, int | None, dict[str, bytes]]]:
    """Return the submissions of all participants that have one."""
    return [(p.name, p.number, scored(score)) for p in class_ if p.submitted]


def moodle_files(path: Path, files: Iterable[tuple[Person, str, bytes]]) -> Path:
    """Write "Download all submissions" of people who each handed in one file."""
    with zipfile.ZipFile(path, "w") as archive:
        for person, name, content in files:
            prefix = moodle_prefix(person.name, person.number)
            archive.writestr(f"{prefix}_assignsubmission_file/{name}", content)
    return path


def canvas_zip(path: Path, class_: Iterable[Person], score: float = 90) -> Path:
    """Write Canvas' "Download Submissions" of these people; the number is the user's id."""
    with zipfile.ZipFile(path, "w") as archive:
        for person in class_:
            if person.submitted:
                last_first = "".join(reversed(person.name.split()))
                name = re.sub(r"\W", "", last_first.lower())
                place = f"{name}_{person.number}_{90_000 + person.number}_package.zip"
                archive.writestr(place, zipped(scored(score)))
    return path


def canvas_gradebook(
    class_: Iterable[Person],
    *,
    columns: Sequence[str] = ("Your first ROS 2 node: Hello time (77)",),
) -> bytes:
    """Return Canvas' gradebook export; the last column has the grades."""
    out = io.StringIO()
    table = csv.writer(out, lineterminator="\n")
    own = ["Student", "ID", "SIS User ID", "SIS Login ID", "Section"]
    empty = [""] * (len(columns) - 1)
    table.writerow([*own, *columns, "Current Score"])
    possible = ["    Points Possible", "", "", "", ""]
    table.writerow([*possible, *(["100.00"] * len(columns)), "(read only)"])
    for person in class_:
        last_first = ", ".join(reversed(person.name.split()))
        who = [last_first, person.number, person.id_number, person.email.partition("@")[0], "A"]
        table.writerow([*who, *empty, person.grade, "88.1"])
    return out.getvalue().encode()
