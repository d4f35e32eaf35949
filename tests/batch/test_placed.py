"""A verdict says which folder to hand in next time: of another place it is another verdict."""

from __future__ import annotations

import shutil
from pathlib import Path

from grader.batch.intake import take_in_class
from grader.batch.model import HandedIn, Student
from tests.corpus.model import ASSIGNMENT
from tests.small_package import PACKAGE, make


def test_the_same_package_handed_in_well_has_a_verdict_of_its_own(tmp_path: Path) -> None:
    make(tmp_path / "deep" / "ros2_ws" / "src" / PACKAGE)
    for name in ("well", "again"):
        shutil.copytree(tmp_path / "deep/ros2_ws/src" / PACKAGE, tmp_path / name / PACKAGE)
    handed_in = [
        HandedIn(Student(key="jane", name="Jane"), tmp_path / name)
        for name in ("deep", "well", "again")
    ]
    found = take_in_class(handed_in, ASSIGNMENT, "here", seen=lambda _: None)
    deep, well, again = found
    assert deep.submission == well.submission
    assert deep.key != well.key
    assert well.key == again.key
