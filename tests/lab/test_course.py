"""A lab for another course's lesson: its guide, its check, and nothing else."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from grader.base.errors import UsageError
from grader.package.edit.tree import Replace
from grader.ros.distro import find_distro
from lab import container
from lab.config import LabConfig
from lab.lesson import chosen_lesson
from lab.workspace import prepare
from tests import weather
from tests.lab.helpers import run
from tests.lab.kinds import Kind, long_in_a_container


def of_course(kind: Kind, course: Path, **more: str) -> Kind:
    return Kind(kind.sandbox, {**kind.env, "GRADER_COURSE": str(course), **more})


def workspace_with(folder: Path, broken: bool) -> Path:
    """Make a workspace with the package in it, writable by the student."""
    source = folder / "ws" / "src"
    source.mkdir(parents=True)
    edits = [Replace(weather.SETUP, weather.ENTRY, "")] if broken else []
    weather.write_package(source, *edits)
    if os.geteuid() == 0:
        for path in (source.parent, *source.parent.rglob("*")):
            os.chown(path, 1000, 1000)
    return source.parent


@long_in_a_container
def test_guide_and_check_belong_to_the_lesson_of_the_lab(kind: Kind, tmp_path: Path) -> None:
    course = weather.write_course(tmp_path, "winds")
    workspace = workspace_with(tmp_path, broken=True)
    opened = of_course(kind, course)
    words = ("--assignment", "readings", "--")
    guided = run(opened, workspace, *words, "guide")
    assert guided.returncode == 0, guided.stderr
    assert guided.stdout.startswith("Step 4 of 4: Name it\n")
    assert weather.ENTRY in guided.stdout
    checked = run(opened, workspace, *words, "check", "src/weather_station")
    assert checked.returncode == 1, checked.stderr
    assert "A weather station that counts its readings" in checked.stdout
    assert weather.ENTRY.rstrip(",") in checked.stdout
    fixed = run(opened, workspace, *words, "fix", "--apply", "--no-run", "src/weather_station")
    assert fixed.returncode == 0, fixed.stderr
    explained = run(opened, workspace, *words, "explain", "node.f_prefix")
    assert "f'Reading {self." in explained.stdout


def test_the_lab_has_only_the_lesson_and_cannot_write_to_it(kind: Kind, tmp_path: Path) -> None:
    course = weather.write_course(tmp_path, "winds")
    (course / "solutions.txt").write_text("secret")
    script = (
        "ls /opt/ros2_teaching_lab/course; cd /opt/ros2_teaching_lab/course/winds; ls; "
        "touch here 2> /dev/null || echo read-only"
    )
    opened = of_course(kind, course, GRADER_ASSIGNMENT="winds")
    done = run(opened, tmp_path / "ws", "--", "bash", "-c", script)
    assert done.stdout.split() == [
        "winds",
        *("assignment.yaml", "lesson.ko.md", "lesson.md"),
        "read-only",
    ]
    assert not (course / "winds" / "here").exists()


def test_a_lesson_may_be_named_by_its_file(kind: Kind, tmp_path: Path) -> None:
    file = weather.write_course(tmp_path) / "readings" / "assignment.yaml"
    odd = file.parent.rename(tmp_path / "a b; $(touch x)") / "own.yaml"
    odd.with_name("assignment.yaml").rename(odd)
    done = run(kind, tmp_path / "ws", "--assignment", str(odd), "--", "guide", "list")
    assert done.returncode == 0, done.stderr
    assert "Make the package" in done.stdout
    assert not (tmp_path / "x").exists()


def test_the_default_course_is_opened_for_its_lesson(kind: Kind, tmp_path: Path) -> None:
    script = 'echo "$GRADER_ASSIGNMENT-$GRADER_COURSE"; ls /opt/ros2_teaching_lab/course'
    done = run(kind, tmp_path / "ws", "--", "bash", "-c", script)
    assert done.stdout.split() == ["hello_time-"]


def test_labs_of_two_lessons_are_two_containers(tmp_path: Path) -> None:
    """The mounts of an existing container cannot be changed."""
    course = weather.write_course(tmp_path, "winds")
    workspace = prepare(tmp_path / "ws")
    found = find_distro("jazzy")
    files = [None, *(str(course / name / "assignment.yaml") for name in ("readings", "winds"))]
    visits = [LabConfig(found, workspace, chosen_lesson(file)) for file in files]
    assert len({container._name(visit) for visit in visits}) == 3
    own, readings, _ = ([dict(m) for m in container._mounts(visit)] for visit in visits)
    home = ["/home/student", "/home/student/ros2_ws"]
    assert [mount["Target"] for mount in own] == home
    assert readings[2:] == [
        {
            "Target": "/opt/ros2_teaching_lab/course/readings",
            "Source": str(course / "readings"),
            "Type": "bind",
            "ReadOnly": True,
        }
    ]


def test_a_home_folder_is_not_a_lesson(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """All files of the person would be visible in the lab."""
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    for folder in (tmp_path / "home", tmp_path):
        folder.mkdir(exist_ok=True)
        (folder / "assignment.yaml").write_text(weather.ASSIGNMENT)
        with pytest.raises(UsageError, match="does not have a folder of its own"):
            chosen_lesson(str(folder / "assignment.yaml"))
    with pytest.raises(UsageError, match="no assignment"):
        chosen_lesson(str(tmp_path / "none.yaml"))
