"""How late a submission is, as Moodle's worksheet says it; what is not known is never 0."""

from __future__ import annotations

import csv
import io
import shutil
from collections.abc import Sequence
from datetime import datetime, timezone
from pathlib import Path

import pytest

from grader.batch.policy import lateness, penalty
from grader.batch.systems.moodle.times import date_in, extension, late_by
from grader.course.policy import Policy
from tests.batch.downloads import ENGLISH, KOREAN, Words, moodle_zip, scored
from tests.batch.stub_run import Run, grade_all
from tests.processes import ROOT

HOUR, DAY = 3_600, 86_400
NAMES = {500: "Student Zero", 501: "Student One", 502: "Student Two", 503: "Student Three"}
# the status and the last modification of 500, 501, 502; by the language packs' `submittedlateshort`,
# `userextensiondate` and `strftimedaydatetime`
STATUSES = {
    "en": [
        ("Submitted for grading", "Friday, 20 November 2026, 9:00 PM"),
        ("Submitted for grading - 2 days 3 hours late", "Monday, 23 November 2026, 3:00 AM"),
        (
            "Submitted for grading - Extension granted until: "
            "Wednesday, 25 November 2026, 11:59 PM",
            "Tuesday, 24 November 2026, 3:00 PM",
        ),
    ],
    "ko": [
        ("채점을 위해 제출되었습니다.", "2026년 11월 20일, 금요일, 오후 9:00"),
        ("채점을 위해 제출되었습니다. - 2 일 3 시간 늦음", "2026년 11월 23일, 월요일, 오전 3:00"),
        (
            "채점을 위해 제출되었습니다. - 2026년 11월 25일, 수요일, 오후 11:59 까지 연장되었습니다.",
            "2026년 11월 24일, 화요일, 오후 3:00",
        ),
    ],
    "de": [
        ("Zur Bewertung abgegeben", "Freitag, 20. November 2026, 21:00"),
        (
            "Zur Bewertung abgegeben - 2 Tage 3 Stunden verspätet",
            "Montag, 23. November 2026, 03:00",
        ),
        (
            "Zur Bewertung abgegeben - Verlängertes Abgabeende bis: "
            "Mittwoch, 25. November 2026, 23:59",
            "Dienstag, 24. November 2026, 15:00",
        ),
    ],
}
WORDS: dict[str, Words] = {"en": ENGLISH, "ko": KOREAN, "de": ENGLISH}
POLICY = """
policy:
  due: 2026-11-21T00:00:00+09:00
  late: {per_day: 10%}
"""


def sheet(statuses: Sequence[tuple[str, str]], words: Words = ENGLISH) -> bytes:
    """Return a worksheet with these statuses and times."""
    out = io.StringIO()
    table = csv.writer(out)
    table.writerow(words.header)
    for (number, name), (status, at) in zip(NAMES.items(), statuses, strict=False):
        who = (f"{words.participant}{number}", name, "", f"s{number}@example.org")
        table.writerow([*who, status, "", "100.00", words.yes, at, "-", ""])
    return out.getvalue().encode()


@pytest.fixture(scope="module")
def due(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The assignment with a due date and a penalty for each day."""
    place = tmp_path_factory.mktemp("course") / "hello_time"
    shutil.copytree(ROOT / "lab/course/hello_time", place)
    with (place / "assignment.yaml").open("a", encoding="utf-8") as file:
        file.write(POLICY)
    return place / "assignment.yaml"


def zipped_class(place: Path) -> Path:
    submissions = [(name, number, scored(100)) for number, name in list(NAMES.items())[:3]]
    return moodle_zip(place / "class.zip", submissions)


def late_and_final(run: Run) -> dict[str, tuple[str, str]]:
    return {row["key"]: (row["late"], row["final"]) for row in run.rows()}


LATE = {"500": ("0", "100"), "501": ("183600", "70"), "502": ("0", "100")}


def feedback_of(out: Path, student: str) -> str:
    """Return what is handed back to a student; the file's name begins with theirs."""
    (file,) = (out / "feedback").glob(f"*{student}.md")
    return file.read_text(encoding="utf-8")


@pytest.mark.prefix
@pytest.mark.parametrize("language", STATUSES)
def test_the_worksheets_lateness_counts_in_every_run(
    tmp_path: Path, due: Path, language: str
) -> None:
    given = tmp_path / "lists" / "worksheet.csv"
    given.parent.mkdir()
    given.write_bytes(sheet(STATUSES[language], WORDS[language]))
    path, out = zipped_class(tmp_path), tmp_path / "out"
    first = grade_all(path, out, "--assignment", due, "--worksheet", given)
    assert late_and_final(first) == LATE, first.output
    again = grade_all(path, out, "--assignment", due, "--worksheet", given)
    assert late_and_final(again) == LATE
    # the times stay known without the list, and no grade changes
    without = grade_all(path, out, "--assignment", due)
    assert late_and_final(without) == LATE, without.output
    text = feedback_of(out, "501")
    assert "Late by 2 d 3 h: 30 points taken" in text
    assert "Late" not in feedback_of(out, "502")
    assert "unknown" not in (out / "index.html").read_text(encoding="utf-8").split("</style>")[1]


@pytest.mark.prefix
def test_a_worksheet_beside_the_zip_is_used_and_one_of_others_is_not(
    tmp_path: Path, due: Path
) -> None:
    path = zipped_class(tmp_path)
    (tmp_path / "Grades.csv").write_bytes(sheet(STATUSES["en"]))
    (tmp_path / "other.csv").write_bytes(sheet(STATUSES["en"][:2]))
    (tmp_path / "notes.csv").write_bytes(b"\0\1")
    run = grade_all(path, tmp_path / "out", "--assignment", due)
    assert late_and_final(run) == LATE, run.output
    assert run.output.count("Grades.csv") == 1
    (tmp_path / "Grades (1).csv").write_bytes(sheet(STATUSES["en"]))
    two = grade_all(path, tmp_path / "out 2", "--assignment", due)
    assert "several lists fit" in two.output
    assert {late for late, _ in late_and_final(two).values()} == {"unknown"}


@pytest.mark.prefix
def test_an_unknown_time_is_unknown_everywhere_and_costs_nothing(tmp_path: Path, due: Path) -> None:
    path, out = zipped_class(tmp_path), tmp_path / "out"
    run = grade_all(path, out, "--assignment", due)
    assert set(late_and_final(run).values()) == {("unknown", "100")}
    page = (out / "index.html").read_text(encoding="utf-8")
    assert "Time of submission unknown: 3" in page
    assert page.index("Needs attention</h2>") < page.index("Time of submission unknown: 3")
    assert page.count(">unknown</td>") == 3
    assert "time of submission is unknown" in feedback_of(out, "500")
    # without a due date too: "0" would be a claim
    plain = grade_all(path, tmp_path / "out 2")
    assert {late for late, _ in late_and_final(plain).values()} == {"unknown"}


@pytest.mark.prefix
def test_moodles_lateness_is_shown_without_a_due_date_in_the_assignment(tmp_path: Path) -> None:
    (tmp_path / "w.csv").write_bytes(sheet(STATUSES["en"]))
    run = grade_all(zipped_class(tmp_path), tmp_path / "out", "--worksheet", tmp_path / "w.csv")
    late = {key: late for key, (late, _) in late_and_final(run).items()}
    assert late == {"500": "0", "501": "183600", "502": "0"}


@pytest.mark.prefix
def test_without_a_due_date_in_moodle_the_assignments_counts(tmp_path: Path, due: Path) -> None:
    statuses = [("Submitted for grading", at) for _, at in STATUSES["en"]]
    (tmp_path / "w.csv").write_bytes(sheet(statuses))
    words = ("--assignment", due, "--worksheet", tmp_path / "w.csv")
    run = grade_all(zipped_class(tmp_path), tmp_path / "out", *words)
    late = {key: late for key, (late, _) in late_and_final(run).items()}
    assert late == {"500": "0", "501": "183600", "502": str(3 * DAY + 15 * HOUR)}


@pytest.mark.parametrize(
    ("status", "seconds"),
    [
        ("Submitted for grading", 0),
        ("Submitted for grading - 1 day late - Graded", DAY),
        ("Submitted for grading - 1 hour 20 mins late", HOUR + 1_200),
        ("Submitted for grading - 5 mins 3 secs late", 303),
        ("Submitted for grading - 1 year 20 days late", 385 * DAY),
        ("채점을 위해 제출되었습니다. - 3분 늦음 - 채점됨", 180),
        ("Palautettu arvioitavaksi - 2 päivää myöhässä", None),
    ],
)
def test_lateness_in_a_status(status: str, seconds: float | None) -> None:
    assert late_by(status) == seconds


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("Friday, 20 November 2026, 12:05 AM", datetime(2026, 11, 20, 0, 5)),
        ("Friday, November 20, 2026, 12:05 PM", datetime(2026, 11, 20, 12, 5)),
        ("2026년 11월 5일, 목요일, 오전 12:30", datetime(2026, 11, 5, 0, 30)),
        ("mardi 3 mars 2026, 21:05", datetime(2026, 3, 3, 21, 5)),
        ("martes, 1 de diciembre de 2026, 21:05", datetime(2026, 12, 1, 21, 5)),
        ("2026-11-20 21:00", datetime(2026, 11, 20, 21)),
        ("perjantai, 20. marraskuu 2026, 19.00", None),  # November, not March
        ("11/12/2026 09:00", None),  # November or December
        ("Friday, 31 November 2026, 9:00 PM", None),
        ("Friday, 20 November 2026", None),
        ("-", None),
    ],
)
def test_a_date_is_read_for_sure_or_not_at_all(text: str, found: datetime | None) -> None:
    assert date_in(text) == found
    assert extension(f"Submitted for grading - Extension granted until: {text}") == found


def test_the_exact_time_counts_where_moodle_cuts_it_off() -> None:
    """`1 day late` is any time of the 25th hour: the second day has begun."""
    policy = Policy.model_validate({"due": "2026-11-20T12:00:00Z", "late": {"per_day": "10"}})
    at = datetime(2026, 11, 21, 12, 30, tzinfo=timezone.utc)
    assert lateness(at, policy, stated=DAY) == DAY + 1_800
    assert penalty(100, 100, at, policy, stated=DAY) == 20
    assert lateness(None, policy, stated=DAY) == DAY
    assert lateness(at, policy, stated=0) == 0, "Moodle knows another due date of this student"
    later = datetime(2026, 11, 21, 13, tzinfo=timezone.utc)
    assert lateness(at, policy, extension=later) == 0
