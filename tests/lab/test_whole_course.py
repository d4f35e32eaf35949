"""A student who does only what the guide says goes through every lesson to full marks."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from grader.course.find import lessons_of
from grader.course.folder import own_course
from grader.course.load import load_assignment
from grader.verdict.take_in import take_in_for
from tests import processes
from tests.lab.kinds import Kind, long_in_a_container
from tests.lab.player import Player
from tests.lab.screen import Lab

LESSONS = lessons_of(own_course())


def played() -> Iterator[object]:
    """Yield the lessons and languages; test_ten_steps.py plays the first one for `make test-all`."""
    for lesson in LESSONS:
        for lang in ("en", "ko"):
            yield pytest.param(lesson, lang, marks=pytest.mark.long)


@long_in_a_container
@pytest.mark.parametrize(("lesson", "lang"), list(played()))
def test_the_guide_leads_to_full_marks(lesson: str, lang: str, kind: Kind, tmp_path: Path) -> None:
    workspace = tmp_path / "ros2_ws"
    env = {"GRADER_ASSIGNMENT": lesson, "GRADER_LANG": lang, "LANG": "C.UTF-8"}
    with Lab(kind, workspace, env=env) as lab:
        player = Player(lab, lesson, workspace, lang)
        player.play()
        submitted = lab.type("lab submit")
        assert lab.status() == 0, submitted
        assert lab.leave() == 0
    archive = workspace / "submit" / f"{lesson}.zip"
    assert str(archive) in submitted
    assignment = load_assignment(processes.ROOT / "lab/course" / lesson / "assignment.yaml")
    taken = take_in_for(assignment, archive)
    assert (taken.problem, taken.modes) == ("", "recorded")
    assert {path.lstat().st_uid for path in workspace.rglob("*")} == {os.geteuid() or 1000}
