"""A class with hostile students: everybody has a line, and none controls the terminal."""

from __future__ import annotations

import csv
import json
import time
from pathlib import Path

import pytest

from grader.ros.prefix import Ros
from grader.sandbox.limits import Limits
from tests.batch.classes import corpus_class, grade_all
from tests.batch.pool_tasks import CORPUS
from tests.corpus.build import write
from tests.corpus.hostile import HOSTILE
from tests.report.test_hostile import forbidden_in

pytestmark = pytest.mark.prefix

HOSTILE_NAME = ("deaf_and_prints_dots", "setup_paints_and_ends_with_250")
BIG = "\x1b]0;owned\x07bob\u202e"  # a folder name; its content does not fit into the workspace


@pytest.fixture
def hostile_class(tmp_path: Path) -> Path:
    """A right package, a broken one, two hostile ones, and one on which the grader fails."""
    folder = corpus_class(tmp_path / "class", ["solution", "entry_missing", "solution"])
    (folder / "s2-solution").rename(folder / BIG)
    (folder / BIG / "my_robot_controller" / "big.bin").write_bytes(b"x" * 4_000_000)
    for package in HOSTILE:
        if package.name in HOSTILE_NAME:
            place = folder / package.name
            place.mkdir()
            write(package, place).rename(place / "my_robot_controller")
    return folder


@pytest.mark.full
def test_a_class_with_hostile_students_ends_with_a_verdict_on_each(
    ros_jazzy: Ros, hostile_class: Path, tmp_path: Path
) -> None:
    out = tmp_path / "out"
    begin = time.monotonic()
    done = grade_all(hostile_class, out, "--limit", "workspace=3000000")
    seconds = time.monotonic() - begin
    assert done.returncode == 1, done.stderr
    output = done.stdout + done.stderr
    assert "\x1b" not in output
    assert forbidden_in(output) == set()
    text = (out / "gradebook.csv").read_text(encoding="utf-8-sig")
    rows = {row["key"]: row for row in csv.DictReader(text.splitlines())}
    found = {key: (row["status"], row["final"]) for key, row in rows.items()}
    (big,) = found.keys() - {"s0-solution", "s1-entry_missing", *HOSTILE_NAME}
    packages = {
        "s0-solution": CORPUS["solution"],
        "s1-entry_missing": CORPUS["entry_missing"],
        **{package.name: package for package in HOSTILE if package.name in HOSTILE_NAME},
    }
    scores = {key: f"{package.expect_score:g}" for key, package in packages.items()}
    assert found == {
        **{key: ("graded", score) for key, score in scores.items()},
        big: ("error", ""),
    }
    assert "could not be laid out" in rows[big]["notes"]
    assert "1 submission was not marked" in done.stderr
    reports = [json.loads(path.read_bytes()) for path in out.rglob("report.json")]
    assert len(reports) == 4
    ceiling = Limits().verdict_seconds
    assert all(report["environment"]["limits"]["verdict_seconds"]["value"] == ceiling
               for report in reports)  # fmt: skip
    assert all(report["timing"]["total"] < 60 for report in reports)
    assert seconds < 120
