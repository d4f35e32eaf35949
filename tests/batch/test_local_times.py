"""Blackboard and Brightspace: logins, names and local times are in the names of the files."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.batch.archives import zipped
from tests.batch.downloads import scored
from tests.batch.stub_run import grade_all
from tests.processes import ROOT

pytestmark = pytest.mark.prefix


@pytest.fixture
def seoul(tmp_path: Path) -> Path:
    """The assignment, due on 20 November at 21:00 in Seoul."""
    shutil.copytree(ROOT / "lab/course/hello_time", tmp_path / "hello_time")
    with (tmp_path / "hello_time/assignment.yaml").open("a", encoding="utf-8") as file:
        file.write(
            "\npolicy:\n  due: 2026-11-20T21:00:00\n  time_zone: Asia/Seoul\n"
            "  late: {per_day: 10%}\n  attempts: last\n"
        )
    return tmp_path / "hello_time/assignment.yaml"


def test_blackboard_has_the_login_and_the_local_time(tmp_path: Path, seoul: Path) -> None:
    folder = tmp_path / "class"
    folder.mkdir()
    attempts = [
        ("stud0", "2026-11-19-20-00-01", 50, "Name: Student Zero (stud0)\n"),
        ("stud0", "2026-11-20-21-00-11", 80, "Name: Student Zero (stud0)\n"),
        ("stud1", "2026-11-20-20-59-59", 90, ""),
        ("kim_minji", "2026-11-20-20-00-00", 70, "Name: 김민지 (kim_minji)\nComments: (none)\n"),
    ]
    for login, at, score, text in attempts:
        name = f"Hello time_{login}_attempt_{at}"
        (folder / f"{name}.txt").write_text(text, encoding="utf-8")
        (folder / f"{name}_my_robot_controller.zip").write_bytes(zipped(scored(score)))
    (tmp_path / "roster.csv").write_text(
        "Last Name,First Name,Username,Student ID\nZero,Student,stud0,1\nOne,Student,stud1,2\n"
        "김,민지,kim_minji,3\n"
    )
    words = ("--roster", tmp_path / "roster.csv", "--assignment", seoul)
    run = grade_all(folder, tmp_path / "out", *words)
    assert run.status == 1, run.output
    assert "(blackboard)" in run.output
    finals = run.column("gradebook.csv", "final", "username")
    assert finals == {"stud0": "70", "stud1": "90", "kim_minji": "70"}, "one began a day late"
    submitted = run.column("gradebook.csv", "submitted", "username")
    assert submitted["stud0"] == "2026-11-20T12:00:11+00:00"
    assert run.column("gradebook.csv", "attempt", "username")["stud0"] == "2"


def test_brightspace_is_joined_by_name_and_a_time_without_a_zone_is_not_used(
    tmp_path: Path,
) -> None:
    folder = tmp_path / "class"
    folder.mkdir()
    for number, name in ((101, "Student Zero"), (102, "Student One")):
        stem = f"{number}-9 - {name} - Nov 20, 2026 930 PM"
        (folder / f"{stem} - robot.zip").write_bytes(zipped(scored(60)))
    run = grade_all(folder, tmp_path / "out")
    assert run.finals() == {"Student One": "60", "Student Zero": "60"}
    assert "(brightspace)" in run.output
    assert "the times in the files' names are not used" in run.output
    assert set(run.column("gradebook.csv", "submitted", "name").values()) == {""}
