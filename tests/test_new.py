"""`grader new`: the files of a new lesson, which can be marked as they are."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.course.load import load_assignment
from grader.verdict.checks.all import CHECKS
from tests import processes


def test_a_new_lesson_is_complete_and_nothing_is_overwritten(tmp_path: Path) -> None:
    command = processes.grader("new", "blinker", "--title", "A blinking light")
    done = processes.run(command, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    file = tmp_path / "my_course" / "blinker" / "assignment.yaml"
    assignment = load_assignment(file, known_checks=CHECKS)
    assert (assignment.id, assignment.title) == ("blinker", "A blinking light")
    assert (assignment.package, assignment.max_score) == ("my_blinker", 100)
    package = tmp_path / "my_keys" / "blinker" / "solution" / "my_blinker"
    assert (package / "my_blinker" / "blinker.py").stat().st_mode & 0o111
    for name in ("package.xml", "setup.py", "setup.cfg", "resource/my_blinker"):
        assert (package / name).is_file()
    assert "validate my_course/blinker/assignment.yaml" in done.stdout
    file.write_text("mine", encoding="utf-8")
    again = processes.run(command, cwd=tmp_path)
    assert again.returncode == 2
    assert "my_course/blinker exists: nothing was written" in again.stderr
    assert file.read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize(
    "words", [["Blink"], ["1st"], ["x", "--package", "My"], ["x", "--title", "a: <b>"]]
)
def test_a_name_that_ros_does_not_allow_is_refused(words: list[str], tmp_path: Path) -> None:
    done = processes.run(processes.grader("new", *words), cwd=tmp_path)
    assert done.returncode == 2
    assert "Traceback" not in done.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.prefix
@pytest.mark.full
def test_a_new_lesson_marks_what_it_must(tmp_path: Path) -> None:
    processes.run(processes.grader("new", "blinker"), cwd=tmp_path)
    file, keys = "my_course/blinker/assignment.yaml", "my_keys/blinker"
    command = processes.grader("validate", file, "--keys", keys, "--named")
    done = processes.run(command, cwd=tmp_path, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "failed as expected      4 of 4" in done.stdout
    assert "mistake found first     4 of 4" in done.stdout
