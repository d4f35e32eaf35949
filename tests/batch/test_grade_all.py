"""`grader grade-all` on a class: outputs are complete and nothing is marked twice.

The workers mark from recorded evidence, except in the last test.
"""

from __future__ import annotations

import csv
import json
import shutil
import signal
import subprocess
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import pytest

from grader.batch.ledger import Ledger
from grader.ros.prefix import Ros
from tests.batch.classes import corpus_class, count_verdicts, grade_all, replay_all
from tests.batch.downloads import KOREAN, moodle_zip, people, worksheet
from tests.batch.pool_tasks import workers_of
from tests.processes import ROOT, grader, run

pytestmark = pytest.mark.prefix

NAMES = ["solution", "entry_missing", "text_other_capital"]
ROSTER = """\
id,name,email
s0-solution,Ann Lee,ann@example.org
s1-entry_missing,Bela Nagy,bela@example.org
s2-text_other_capital,Chidi Okafor,chidi@example.org
corrupt,"Weiß, Dörte",doerte@example.org
absent,Émile Zola,emile@example.org
"""


@dataclass(frozen=True)
class Class:
    """A marked class: its folder, its roster and its output folder."""

    folder: Path
    roster: Path
    out: Path
    first: subprocess.CompletedProcess[str]

    def again(self, *words: str) -> subprocess.CompletedProcess[str]:
        return replay_all(self.folder, self.out, "--roster", str(self.roster), *words)

    def override(self, *words: str) -> subprocess.CompletedProcess[str]:
        return run(grader("override", *words, "--out", self.out))

    def rows(self) -> dict[str, dict[str, str]]:
        text = (self.out / "gradebook.csv").read_text(encoding="utf-8-sig")
        return {row["key"]: row for row in csv.DictReader(text.splitlines())}

    def verdicts(self) -> int:
        with Ledger(self.out / "ledger.sqlite") as ledger:
            return ledger.count()


@pytest.fixture(scope="module")
def marked(ros_jazzy: Ros, tmp_path_factory: pytest.TempPathFactory) -> Class:
    """A class of five: three packages, a corrupt archive, and one missing submission."""
    place = tmp_path_factory.mktemp("class")
    folder = corpus_class(place / "handed in", NAMES)
    (folder / "corrupt.zip").write_bytes(b"PK\x03\x04 this ends in the middle")
    roster = place / "roster.csv"
    roster.write_text(ROSTER, encoding="utf-8")
    out = place / "out"
    first = replay_all(folder, out, "--roster", str(roster))
    return Class(folder, roster, out, first)


@pytest.fixture
def copy(marked: Class, tmp_path: Path) -> Class:
    """A copy of the same class that a test may change."""
    shutil.copytree(marked.folder, tmp_path / "handed in", symlinks=True)
    shutil.copytree(marked.out, tmp_path / "out")
    return Class(tmp_path / "handed in", marked.roster, tmp_path / "out", marked.first)


def test_everybody_is_in_the_gradebook_with_their_points(marked: Class) -> None:
    assert marked.first.returncode == 1, marked.first.stderr
    rows = marked.rows()
    found = {key: (row["name"], row["status"], row["final"]) for key, row in rows.items()}
    assert found == {
        "s0-solution": ("Ann Lee", "graded", "100"),
        "s1-entry_missing": ("Bela Nagy", "graded", "45"),
        "s2-text_other_capital": ("Chidi Okafor", "graded", "90"),
        "corrupt": ("Dörte Weiß", "ungradable", ""),
        "absent": ("Émile Zola", "missing", ""),
    }
    assert "setup.no_entry" in rows["s1-entry_missing"]["mistakes"]


def test_everybody_has_a_page_and_feedback(marked: Class) -> None:
    assert (marked.out / "index.html").is_file()
    assert len(list((marked.out / "students").glob("*.html"))) == 5
    assert len(list((marked.out / "feedback").glob("*.md"))) == 5
    (page,) = (marked.out / "feedback").glob("*entry_missing*.md")
    assert "entry_point.mapping" in page.read_text(encoding="utf-8")
    assert "Hello Time" in (marked.out / "students" / "s2-text_other_capital.html").read_text()


def test_reports_are_in_the_same_place_as_for_one_package(marked: Class) -> None:
    reports = {
        path.parts[-3]: json.loads(path.read_text(encoding="utf-8"))
        for path in marked.out.glob("*/jazzy/report.json")
    }
    assert len(reports) == 4
    assert {r["submission"]["student_id"]: r["score"] for r in reports.values()} == {
        "s0-solution": 100,
        "s1-entry_missing": 45,
        "s2-text_other_capital": 90,
        "corrupt": 0,
    }
    assert all(
        report["evidence"].keys() >= {"build_log", "transcript"} for report in reports.values()
    )


def test_the_summary_names_the_first_reasons(marked: Class) -> None:
    lines = marked.first.stdout.splitlines()
    (line,) = (line for line in lines if line.startswith("Bela Nagy"))
    assert "45 / 100" in line
    assert "entry_point.mapping" in line
    total = (
        "5 students, 3 marked (1 with every check), 1 to look at by hand, 1 without a submission."
    )
    assert total in " ".join(marked.first.stdout.split())
    assert "\x1b" not in marked.first.stdout + marked.first.stderr, "plain where it is piped"


def test_an_unchanged_class_is_neither_marked_nor_written_again(copy: Class) -> None:
    assert copy.again().returncode == 1  # the outputs are in another folder now
    before = {path: path.stat().st_mtime_ns for path in copy.out.rglob("*.html")}
    again = copy.again()
    assert again.returncode == 1
    assert "0 to mark, 4 marked before" in again.stderr
    assert copy.verdicts() == 4
    assert {path: path.stat().st_mtime_ns for path in copy.out.rglob("*.html")} == before


def test_a_deleted_output_is_written_again(copy: Class) -> None:
    (copy.out / "gradebook.csv").unlink()
    copy.again()
    assert copy.rows()["s0-solution"]["final"] == "100"


def test_only_changed_submissions_are_marked_and_earlier_attempts_kept(copy: Class) -> None:
    node = "my_robot_controller/my_robot_controller/my_first_node.py"
    path = copy.folder / "s2-text_other_capital" / node
    path.write_text(path.read_text(encoding="utf-8").replace("Hello Time", "Hello time"))
    again = copy.again()
    assert "1 to mark, 3 marked before" in again.stderr
    row = copy.rows()["s2-text_other_capital"]
    assert (row["final"], row["attempt"]) == ("100", "2")
    assert copy.verdicts() == 5
    # a later, worse attempt: the best one still counts
    path.write_text(path.read_text(encoding="utf-8").replace("Hello time", "Hallo"))
    copy.again()
    assert copy.rows()["s2-text_other_capital"]["final"] == "100"


def test_a_correction_survives_a_regrade_and_is_in_every_output(copy: Class) -> None:
    done = copy.override(
        *("Bela Nagy", "--check", "run.output", "--points", "7", "--because", "shown in class")
    )
    assert done.returncode == 0, done.stderr
    again = copy.again("--regrade")
    assert "4 to mark (4 again)" in again.stderr
    assert "Marked again: 4, 4 of them with the same result." in again.stdout
    assert copy.verdicts() == 8
    row = copy.rows()["s1-entry_missing"]
    assert (row["score"], row["final"], row["run.output"]) == ("52", "52", "7")
    assert "shown in class" in row["notes"]
    for place in ("students/s1-entry_missing.html", "feedback/Bela_Nagy_s1_entry_missing.html"):
        assert "shown in class" in (copy.out / place).read_text(encoding="utf-8"), place
    assert "shown in class" in (copy.out / "feedback/Bela_Nagy_s1_entry_missing.md").read_text()
    assert "shown in class" in (copy.out / "junit.xml").read_text(encoding="utf-8")
    assert "52" in (copy.out / "index.html").read_text(encoding="utf-8")
    listed = copy.override("--list")
    assert "Bela Nagy: run.output 7 points, because: shown in class" in listed.stdout
    assert "no longer applies" not in listed.stdout
    assert copy.override("Bela Nagy", "--check", "run.output", "--remove").returncode == 0
    copy.again()
    assert copy.rows()["s1-entry_missing"]["final"] == "45"


def test_a_group_is_marked_once_and_each_member_has_the_report(
    ros_jazzy: Ros, tmp_path: Path
) -> None:
    class_ = [replace(p, group="Team_1") for p in people(3, korean=True)]
    (tmp_path / "worksheet.csv").write_bytes(worksheet(class_, KOREAN, encoding="cp949"))
    root = corpus_class(tmp_path / "corpus", ["entry_missing"]) / "s0-entry_missing"
    files = {
        path.relative_to(root).as_posix(): path.read_bytes()
        for path in root.rglob("*")
        if path.is_file()
    }
    path = moodle_zip(tmp_path / "class.zip", [("Team_1", 1001, files)])
    done = replay_all(path, tmp_path / "out", "--worksheet", str(tmp_path / "worksheet.csv"))
    assert done.returncode == 1, done.stderr
    assert "1 to mark, 0 marked before" in done.stderr
    made = Class(path, tmp_path / "worksheet.csv", tmp_path / "out", done)
    found = {row["name"]: (row["final"], row["mistakes"]) for row in made.rows().values()}
    assert found == {person.name: ("45", "setup.no_entry") for person in class_}
    reports = {
        report.parts[-3]: json.loads(report.read_text(encoding="utf-8"))["submission"]
        for report in made.out.glob("*/jazzy/report.json")
    }
    assert {name: s["student_id"] for name, s in reports.items()} == {
        person.name: person.id_number for person in class_
    }


@pytest.mark.parametrize(
    ("words", "output"),
    [
        (("Bela Nagi", "--points", "1", "--because", "x"), "Did you mean 'Bela Nagy'?"),
        (("Bela Nagy", "--check", "run.outptu", "--points", "1"), "Did you mean 'run.output'?"),
        (("Bela Nagy", "--check", "run.output", "--points", "11", "--because", "x"), "--force"),
        (("Bela Nagy", "--check", "run.output", "--points", "1"), "--because"),
        (("Bela Nagy",), "--points are required"),
        (("Bela Nagy", "--remove"), "was not corrected"),
    ],
)
def test_an_invalid_correction_is_refused(
    marked: Class, words: tuple[str, ...], output: str
) -> None:
    done = marked.override(*words)
    assert done.returncode == 2
    assert output in done.stderr
    assert "Traceback" not in done.stderr


def test_a_regrade_of_one_student_leaves_the_others_unchanged(copy: Class) -> None:
    again = copy.again("--regrade-student", "ann@example.org")
    assert "1 to mark (1 again), 3 marked before" in again.stderr
    assert copy.verdicts() == 5


def test_a_dry_run_marks_nothing(marked: Class, tmp_path: Path) -> None:
    done = replay_all(marked.folder, tmp_path / "out", "--dry-run")
    assert done.returncode == 0
    assert "4 to mark" in done.stderr
    marking = [line.split() for line in done.stdout.splitlines() if line.startswith("s0-solution")]
    assert [(words[0], words[-2:]) for words in marking] == [("s0-solution", ["to", "mark"])]
    assert not (tmp_path / "out" / "gradebook.csv").exists()


def test_a_second_grader_on_the_same_class_is_refused(copy: Class) -> None:
    with Ledger(copy.out / "ledger.sqlite"):
        done = copy.again()
    assert done.returncode == 2
    assert "another grader" in done.stderr


@pytest.mark.parametrize(
    ("words", "output"),
    [
        (("--distro", "jazzy,kilted"), "one distro"),
        (("--regrade-student", "Nobody"), "there is no student 'Nobody'"),
        (("--system", "modle"), "moodle"),
        (("--sandbox", "bubblewarp"), "did you mean 'bubblewrap'"),
    ],
)
def test_usage_errors_are_reported_before_anything_is_marked(
    copy: Class, words: tuple[str, ...], output: str
) -> None:
    done = copy.again(*words)
    assert done.returncode == 2
    assert output in done.stderr
    assert "Traceback" not in done.stderr
    assert copy.verdicts() == 4


@pytest.fixture
def running(ros_jazzy: Ros, tmp_path: Path) -> Iterator[tuple[subprocess.Popen[str], Path, Path]]:
    """A class that is being marked: its process, its folder and its output folder."""
    folder = corpus_class(tmp_path / "class", ["solution"] * 6)
    out = tmp_path / "out"
    command = grader("grade-all", folder, "--out", out, "--sandbox", "bubblewrap", "--workers", "2")
    with subprocess.Popen(
        command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stderr is not None
        for line in process.stderr:
            if line.startswith("marking"):
                break
        yield process, folder, out
        process.kill()


@pytest.mark.full
def test_an_interrupted_run_resumes(
    running: tuple[subprocess.Popen[str], Path, Path],
) -> None:
    process, folder, out = running
    ledger = out / "ledger.sqlite"
    while count_verdicts(ledger) < 1:
        time.sleep(0.02)
    workers = workers_of(process.pid)
    process.send_signal(signal.SIGINT)
    _, output = process.communicate(timeout=60)
    assert process.returncode == 130, output
    assert "run the same command again to continue" in output
    assert not any(Path(f"/proc/{worker}").exists() for worker in workers)
    with (out / "gradebook.csv").open(encoding="utf-8-sig") as file:
        statuses = [row["status"] for row in csv.DictReader(file)]
    assert {"graded", "pending"} == set(statuses)
    again = grade_all(folder, out)
    assert again.returncode == 0, again.stderr
    assert f"{statuses.count('pending')} to mark" in again.stderr
    with Ledger(ledger) as opened:
        assert opened.count() == 6, "none twice"
