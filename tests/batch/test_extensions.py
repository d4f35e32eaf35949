"""Extensions, slip days and times of submission that an instructor gives in CSV files."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from datetime import datetime, timedelta, timezone
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from grader.base.errors import UsageError
from grader.batch.dates import instant_in
from grader.batch.extensions import Extensions, read_extensions
from grader.batch.given_files import GivenFile
from grader.batch.join_file import GivenJoin
from grader.batch.model import ClassFolder, Grant, HandedIn, Student
from grader.batch.policy import Attempt, standing
from grader.batch.roster import Roster, RosterLine
from grader.batch.systems.known import SYSTEMS
from grader.batch.times_file import with_given_times
from grader.course.policy import Late, Policy
from tests.batch.archives import write
from tests.batch.downloads import scored
from tests.batch.stub_run import Run, grade_all
from tests.processes import ROOT
from tests.report.samples import check, report

UTC = timezone.utc
DUE = datetime(2026, 11, 20, 15, tzinfo=UTC)  # midnight in Seoul
POLICY = Policy(due=datetime(2026, 11, 21), time_zone="Asia/Seoul", late=Late(per_day="10%"))
CLASS = (
    Student("ann", "Ann Lee", email="ann@example.org", id_number="007", section="Monday"),
    Student("bob", "Bob Same", email="b1@example.org", id_number="8", section="Monday"),
    Student("bob2", "Bob Same", email="b2@example.org", id_number="9", section="Friday"),
)
ROSTER = Roster(tuple(RosterLine(student, row) for row, student in enumerate(CLASS, start=1)))


def extensions(
    place: Path, text: str | bytes, *, policy: Policy = POLICY, on_roster: bool = True
) -> Extensions:
    path = place / "extensions.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_extensions(GivenFile(path), CLASS, policy, "hello_time", on_roster=on_roster)


def seoul(day: int, hour: int = 0, minute: int = 0, second: int = 0) -> datetime:
    at = datetime(2026, 11, day, hour, minute, second, tzinfo=timezone(timedelta(hours=9)))
    return at.astimezone(UTC)


@pytest.mark.parametrize(
    ("text", "grants"),
    [
        ("student,days\nAnn Lee,2\n", {"ann": Grant(seoul(23))}),
        ("Email;Extra days\nann@example.org;1,5\n", {"ann": Grant(seoul(22, 12))}),
        ("id number,due\n007,2026-11-24\n", {"ann": Grant(seoul(24, 23, 59, 59))}),
        ("id,due\n9,2026-11-24 18:30\n", {"bob2": Grant(seoul(24, 18, 30))}),
        ("id,due\n9,2026-11-24T18:30:00Z\n", {"bob2": Grant(datetime(2026, 11, 24, 18, 30, 0, 0, UTC))}),
        ("name,slip days\nLee Ann,3\n", {"ann": Grant(slip_days=3)}),
        ("학번,마감,유예 일수\n8,2026년 11월 25일 오후 6:00,2\n", {"bob": Grant(seoul(25, 18), 2)}),
        (
            "section,student,days\nmonday,,1\n,ann,3\n",
            {"ann": Grant(seoul(24)), "bob": Grant(seoul(22))},
        ),
        (
            "student,assignment,days\nann,other,1\nann,hello_time,2\nbob2,,3\n",
            {"ann": Grant(seoul(23)), "bob2": Grant(seoul(24))},
        ),
        ("name,email,days\nBob Same,b2@example.org,1\n", {"bob2": Grant(seoul(22))}),
        ("student,days\n", {}),
    ],
)  # fmt: skip
def test_what_is_granted(tmp_path: Path, text: str, grants: dict[str, Grant]) -> None:
    assert extensions(tmp_path, text).grants == grants
    assert extensions(tmp_path, text.encode("utf-16")).grants == grants


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("student,days\nAnn Leh,1\n", [":2: ", "'Ann Leh'", "'Ann Lee'"]),
        ("student,days\nBob Same,1\n", [":2: ", "more than one student"]),
        ("section,days\nMondey,1\n", [":2: ", "'Mondey'", "did you mean 'monday'"]),
        ("student,days\nann,two\n", [":2: ", "'two' is not a number of days"]),
        ("student,days\nann,-1\n", [":2: ", "not a number of days"]),
        ("student,slip days\nann,1.5\n", [":2: ", "not a whole number of slip days"]),
        ("student,due\nann,11/12/2026\n", [":2: ", "'11/12/2026'", "write 2026-11-25 23:59"]),
        ("student,due\nann,2026-11-19\n", [":2: ", "before the due date, 2026-11-21 00:00 (UTC+09"]),
        ("student,due,days\nann,2026-11-24,2\n", [":2: ", "keep one"]),
        ("student,days\nann,\n", [":2: ", "grants nothing"]),
        ("student,days\n\n,3\n", [":3: ", "neither a student nor a section"]),
        ("student,days\nann,1\n007,2\n", [":3: ", "line 2 is about the same"]),
        ("id,email,days\n8,b2@example.org,1\n", [":2: ", "different students"]),
        ("student,dayz\nann,1\n", [":1: ", "no column", "'dayz'", "did you mean 'days'"]),
        ("student,days\nxx,1\nann,z\n", [":2: ", "'xx'", "\n", ":3: ", "'z'"]),
        (b"PK\x03\x04", ["cannot be read as an .xlsx file"]),
    ],
)  # fmt: skip
def test_an_error_has_its_line_and_what_is_meant(
    tmp_path: Path, text: str | bytes, said: Sequence[str]
) -> None:
    with pytest.raises(UsageError) as error:
        extensions(tmp_path, text)
    left = str(error.value)
    for word in said:
        assert word in left, left
        left = left.partition(word)[2]


def test_without_a_due_date_nothing_can_be_extended(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="no due date"):
        extensions(tmp_path, "student,days\nann,1\n", policy=Policy())


def test_without_a_roster_an_unknown_student_is_noted_only(tmp_path: Path) -> None:
    found = extensions(tmp_path, "student,days\nCleo,1\nann,1\n", on_roster=False)
    assert set(found.grants) == {"ann"}
    assert "extensions.csv:2: there is no student 'Cleo'" in found.notes[0]


def test_days_keep_the_time_of_day_when_the_clocks_change(tmp_path: Path) -> None:
    due = datetime(2026, 10, 24, 23, 59)  # the clocks go back in the night to the 25th
    policy = Policy(due=due, time_zone="Europe/Berlin", late=Late(per_day="10%"))
    found = extensions(tmp_path, "student,days\nann,1\n", policy=policy)
    assert found.grants["ann"].until == datetime(2026, 10, 25, 22, 59, tzinfo=UTC)


def entry_of(
    submitted: datetime | None,
    grant: Grant,
    *,
    policy: Policy = POLICY,
    stated: float | None = None,
) -> tuple[float, float | None, int]:
    """Return the penalty, the seconds late and the slip days used of a submission of 100 points."""
    passed = report(checks=[check("a", "passed", score=100, max_score=100)])
    made = passed.model_copy(update={"score": 100, "max_score": 100})
    attempt = Attempt(1, submitted, None, made, late_seconds=stated)
    entry = standing(CLASS[0], [attempt], [], policy, 100, grant=grant)
    return entry.penalty, entry.late_seconds, entry.slip_days_used


DAY = 86_400.0


@pytest.mark.parametrize(
    ("days_late", "grant", "result"),
    [
        (1.5, Grant(), (20, 1.5 * DAY, 0)),
        (1.5, Grant(DUE + timedelta(days=2)), (0, 0, 0)),
        (2.5, Grant(DUE + timedelta(days=2)), (10, 0.5 * DAY, 0)),
        (1.5, Grant(slip_days=3), (0, 1.5 * DAY, 2)),
        (4.5, Grant(slip_days=3), (20, 4.5 * DAY, 3)),
        (3.5, Grant(DUE + timedelta(days=2), 1), (10, 1.5 * DAY, 1)),
        (-1, Grant(slip_days=3), (0, 0, 0)),
    ],
)
def test_what_a_grant_takes_from_the_penalty(
    days_late: float, grant: Grant, result: tuple[float, float, int]
) -> None:
    assert entry_of(DUE + timedelta(days=days_late), grant) == result


def test_a_system_that_does_not_know_the_extension_does_not_count_it_as_late() -> None:
    two_days = Grant(DUE + timedelta(days=2))
    assert entry_of(None, two_days, stated=3 * DAY) == (10, DAY, 0)
    assert entry_of(None, two_days, stated=DAY) == (0, 0, 0)
    assert entry_of(DUE + timedelta(days=1), two_days, stated=DAY) == (0, 0, 0)


def test_slip_days_do_not_go_beyond_the_end_but_an_extension_does() -> None:
    end = datetime(2026, 11, 23)
    late = Late(per_day="10%", until=end)
    policy = Policy(due=datetime(2026, 11, 21), time_zone="Asia/Seoul", late=late)
    at = DUE + timedelta(days=2, hours=1)
    assert entry_of(at, Grant(slip_days=5), policy=policy)[0] == 100
    assert entry_of(at, Grant(DUE + timedelta(days=3)), policy=policy)[0] == 0


def timed(place: Path, text: str) -> ClassFolder:
    path = place / "times.csv"
    path.write_text(text, encoding="utf-8")
    late = HandedIn(CLASS[1], place / "bob", late=True, late_seconds=DAY)
    attempts = [HandedIn(CLASS[2], place / name) for name in ("first.zip", "second.zip")]
    handed_in = (HandedIn(CLASS[0], place / "ann"), late, *attempts)
    folder = ClassFolder(SYSTEMS["folders"], place, handed_in, missing=(Student("eve", "Eve"),))
    return with_given_times(folder, GivenFile(path), POLICY.zone)


def test_times_are_of_students_or_files_in_the_time_zone_of_the_class(tmp_path: Path) -> None:
    text = (
        "file,student,submitted at\n,ann@example.org,2026-11-20 23:00\n,8,2026-11-20T15:00:00Z\n"
        "second.zip,,2026-11-22 10:00 +0900\n,Eve,2026-11-20 23:00\n,007,\n"
    )
    folder = timed(tmp_path, text)
    assert [one.submitted for one in folder.handed_in] == [
        seoul(20, 23), DUE, None, seoul(22, 10)
    ]  # fmt: skip
    assert folder.handed_in[1].late_seconds is None, "the instructor's time counts before the word"
    assert "3 times of submission" in folder.notes[-1]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("student,submitted\nann,yesterday\n", ":2: 'yesterday' is not a date"),
        ("student,submitted\nann,2026-11-20\n", ":2: '2026-11-20' is not a date and time"),
        ("student,submitted\nbob2,2026-11-20 10:00\n", ":2: Bob Same has 2 submissions"),
        ("file,submitted\nfirst.zap,2026-11-20 10:00\n", "did you mean 'first.zip'"),
        ("student,submited\nann,2026-11-20 10:00\n", "did you mean 'submitted'"),
        ("student,time\nann,2026-11-20 10:00\n007,2026-11-20 10:01\n", ":3: line 2 has another"),
    ],
)
def test_a_time_that_cannot_be_used_is_an_error(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(UsageError) as error:
        timed(tmp_path, text)
    assert said in str(error.value)


def test_an_offset_after_another_form_of_date_is_not_lost() -> None:
    with pytest.raises(UsageError, match="for sure"):
        instant_in("Friday, 20 November 2026, 9:00 PM +0100", POLICY.zone)
    with pytest.raises(UsageError, match="no time_zone"):
        instant_in("2026-11-20 10:00", None)


HEADERS = ("student,due,days,slip days,section", "name;days", "id,submitted", "file,student", "")


@given(
    header=st.sampled_from(HEADERS),
    rows=st.lists(
        st.lists(
            st.sampled_from(["ann", "Bob Same", "monday", "-", "1", "2026-11-24", "9999-12-31"])
            | st.text(st.characters(codec="utf-8"), max_size=12),
            max_size=6,
        ),
        max_size=5,
    ),
    encoding=st.sampled_from(["utf-8", "utf-8-sig", "utf-16"]),
)
@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_any_list_is_read_or_refused(
    tmp_path: Path, header: str, rows: list[list[str]], encoding: str
) -> None:
    path = tmp_path / "any.csv"
    path.write_bytes("\n".join([header, *(",".join(row) for row in rows)]).encode(encoding))
    folder = ClassFolder(SYSTEMS["folders"], tmp_path, (HandedIn(CLASS[0], tmp_path / "ann"),))
    for read in (
        lambda: read_extensions(GivenFile(path), CLASS, POLICY, "hello_time", on_roster=True),
        lambda: with_given_times(folder, GivenFile(path), POLICY.zone),
        lambda: GivenJoin(path).pinned(folder.handed_in, ROSTER),
    ):
        try:
            read()
        except UsageError as error:
            assert "any.csv" in str(error)


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("course") / "hello_time"
    shutil.copytree(ROOT / "lab/course/hello_time", place)
    with (place / "assignment.yaml").open("a", encoding="utf-8") as file:
        file.write(
            "\npolicy:\n  due: 2026-11-21T00:00:00\n  time_zone: Asia/Seoul\n"
            "  late: {per_day: 10%}\n"
        )
    return place / "assignment.yaml"


def finals(run: Run) -> dict[str, tuple[str, str]]:
    return {row["name"]: (row["late"], row["final"]) for row in run.rows()}


@pytest.mark.prefix
def test_a_run_with_times_and_extensions_and_the_next_without(tmp_path: Path, course: Path) -> None:
    for name in ("Ann Lee", "Bob Ray", "Cleo Fox"):
        write(tmp_path / "class" / name, scored(100))
    lists = {
        "roster": "id,name,section\n1,Ann Lee,A\n2,Bob Ray,B\n3,Cleo Fox,B\n4,Dan Poe,B\n",
        "times": "id,submitted\n1,2026-11-22 12:00\n2,2026-11-22 12:00\n3,2026-11-22 12:00\n",
        "extensions": "student,section,days,slip days\nAnn Lee,,3,\n,B,,1\n",
    }
    words: list[str | Path] = ["--assignment", course]
    for name, text in lists.items():
        (tmp_path / f"{name}.csv").write_text(text, encoding="utf-8")
        words += [f"--{name}", tmp_path / f"{name}.csv"]
    out = tmp_path / "out"
    first = grade_all(tmp_path / "class", out, *words)
    half = {"Ann Lee": ("0", "100"), "Bob Ray": ("129600", "90"), "Cleo Fox": ("129600", "90")}
    assert finals(first) == {**half, "Dan Poe": ("", "")}, first.output
    rows = {row["name"]: row for row in first.rows()}
    assert rows["Ann Lee"]["due"] == "2026-11-23T15:00:00+00:00"
    assert "1 of 1 slip days used" in rows["Bob Ray"]["notes"]
    texts = {path.name[:3]: path.read_text("utf-8") for path in (out / "feedback").glob("*.md")}
    assert "Your due date was extended until 2026-11-24 00:00 (UTC+09:00)." in texts["Ann"]
    assert "Slip days used: 1 of 1." in texts["Bob"]
    page = (out / "index.html").read_text(encoding="utf-8")
    table = page.partition('<table id="all"')[2].partition("</table>")[0]
    for cell in ("Submitted (UTC+09:00)", "Extended until (UTC+09:00)", "2026-11-22 12:00<"):
        assert table.count(cell) >= 1, cell
    assert "2026-11-24 00:00<" in table
    assert "1 of 1" in table
    without = grade_all(tmp_path / "class", out, "--roster", tmp_path / "roster.csv", *words[:2])
    assert finals(without) == finals(first), without.output
    assert "--extensions as given earlier" in without.output
    (tmp_path / "extensions.csv").write_text("student,days\n", encoding="utf-8")
    dry = grade_all(tmp_path / "class", out, *words, "--dry-run")
    assert "3 grades will change:\n  Ann Lee: 100 → 80" in dry.output
    taken = grade_all(tmp_path / "class", out, *words, "--accept", "lower")
    assert finals(taken)["Ann Lee"] == ("129600", "80")
    assert "extended" not in (out / "index.html").read_text(encoding="utf-8")
