"""Classroom 50: a real checkout marked by autograder.py, and its scores beside ours."""

from __future__ import annotations

import csv
import io
import json
import subprocess
import sys
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from grader.batch.systems.classroom50 import autograder, compare
from grader.package.edit.tree import Replace
from grader.ros.prefix import Ros
from tests import processes
from tests.batch.archives import git
from tests.corpus.build import write
from tests.corpus.model import Package
from tests.gradebook.schemas import CLASSROOM50
from tests.report import samples

RUNNER = {
    "CLASSROOM": "robots-2026",
    "ASSIGNMENT": "hello-time",
    "ASSIGNMENT_TYPE": "individual",
    "OWNER": "ann-lee",
    "SUBMISSION_TAG": "submit/2026-11-30T10-00-00Z-a1b2c3d",
    "COMMIT_URL": "https://github.com/o/r/commit/a1b2c3d",
    "RELEASE_URL": "https://github.com/o/r/releases/tag/s",
}
WHEN = datetime(2026, 11, 30, 10, tzinfo=timezone.utc)


def valid(found: dict[str, Any]) -> dict[str, Any]:
    """Check a result by the schema, and by the rules that Classroom 50 has in code."""
    jsonschema.validate(found, CLASSROOM50)
    assert all(test["score"] <= test["max-score"] for test in found["tests"])
    assert found["score"] == sum(test["score"] for test in found["tests"])
    assert found["max-score"] == sum(test["max-score"] for test in found["tests"])
    assert (found["classroom"], found["assignment"], found["owner"]) == (
        "robots-2026",
        "hello-time",
        "ann-lee",
    )
    return found


def checkout(folder: Path, *edits: Replace) -> Path:
    """Make a student's checkout: a repository with the package, committed in 2026."""
    write(Package(name="my_robot_controller", edits=edits), folder)
    git(folder, "init", "-q", "-b", "main")
    git(folder, "add", "-A")
    git(folder, "commit", "-q", "-m", "my package", at="2026-03-04T10:20:30+01:00")
    return folder


def run(folder: Path, **changes: str) -> subprocess.CompletedProcess[str]:
    """Run the printed autograder.py as the runner does: in the checkout, with its variables."""
    printed = processes.run(
        [sys.executable, "-m", "grader", "classroom50-autograder", "hello_time"]
    )
    assert printed.returncode == 0, printed.stderr
    script = folder.parent / "autograder.py"
    script.write_text(printed.stdout)
    lab = {"GRADER_CHECKOUT": str(processes.ROOT), "GRADER_SANDBOX": "bubblewrap"}
    return processes.run(
        [sys.executable, str(script)], cwd=folder, env={**RUNNER, **lab, **changes}
    )


@pytest.mark.full
def test_a_checkout_is_marked_and_the_result_is_by_the_schema(
    ros_jazzy: Ros, tmp_path: Path
) -> None:
    folder = checkout(tmp_path / "ann")
    (folder / "result.json").symlink_to(tmp_path / "elsewhere")
    done = run(folder)
    assert done.returncode == 0, done.stdout + done.stderr
    assert not (tmp_path / "elsewhere").exists()
    found = valid(json.loads((folder / "result.json").read_text()))
    assert (found["score"], found["max-score"]) == (100, 100)
    assert found["datetime"] == "2026-03-04T09:20:30Z"
    assert "**100 of 100 points**" in (folder / "release-body.md").read_text()


@pytest.mark.full
def test_a_broken_checkout_has_its_points_and_status_0(ros_jazzy: Ros, tmp_path: Path) -> None:
    folder = checkout(
        tmp_path / "ann", Replace("setup.py", "my_first_node:main", "my_frist_node:main")
    )
    assert run(folder).returncode == 0
    found = valid(json.loads((folder / "result.json").read_text()))
    failed = {test["test-name"].partition(":")[0] for test in found["tests"] if not test["passed"]}
    assert "entry_point.mapping" in failed
    assert 0 < found["score"] < 100


def test_without_the_runners_variables_it_says_what_is_missing(tmp_path: Path) -> None:
    done = run(checkout(tmp_path / "ann"), COMMIT_URL="")
    assert done.returncode == 2
    assert "COMMIT_URL" in done.stderr
    assert not (tmp_path / "ann/result.json").exists()


@pytest.mark.parametrize(("most", "whole"), [(20, 20), (2.5, 25), (0.25, 25)])
def test_fractions_become_whole_points(most: float, whole: int) -> None:
    report = json.loads(samples.report().model_dump_json())
    for check in report["checks"]:
        check.update(max_score=most, score=most if check["status"] == "passed" else 0)
    found = valid(autograder.result_of(report, RUNNER, WHEN))
    assert {test["max-score"] for test in found["tests"]} == {whole}
    assert found["datetime"] == "2026-11-30T10:00:00Z"


def scores(**shares: int) -> bytes:
    """Return a scores.json: each login's points of 50, at the commit a1b2c3d."""
    result = {
        "schema": "classroom50/result/v1",
        "submission": RUNNER["SUBMISSION_TAG"],
        "max-score": 50,
        "tests": [],
    }
    entries = [
        {"owner": owner, "submissions": [{**result, "owner": owner, "score": score}]}
        for owner, score in shares.items()
    ]
    bucket = {"type": "individual", "entries": entries}
    return json.dumps(
        {"schema": "classroom50/scores/v1", "assignments": {"hello": bucket}}
    ).encode()


def gradebook(**finals: str) -> bytes:
    """Return a gradebook.csv: each login's points of 100; its key is `robots-hello-LOGIN`."""
    out = io.StringIO()
    table = csv.writer(out)
    table.writerow(["key", "name", "username", "final", "max_score"])
    table.writerows(
        [f"robots-hello-{name}", name, name, final, "100"] for name, final in finals.items()
    )
    return out.getvalue().encode()


def test_what_differs_comes_first(tmp_path: Path) -> None:
    rows = compare.compared(
        scores(Ann=50, bo=45, cy=10), gradebook(ann="100", bo="40", di="70"), "", None
    )
    assert [(row.owner, row.theirs, row.ours) for row in rows if row.differs] == [
        ("bo", 0.9, 0.4),
        ("cy", 0.2, None),
        ("di", None, 0.7),
    ]
    text = list(compare.report_lines(rows))
    assert text[1].split() == ["90", "%", "40", "%", "bo"]
    assert text[-1] == "4 students: 1 equal, 3 to look at"


def test_a_score_of_another_commit_is_said(tmp_path: Path) -> None:
    clone = checkout(tmp_path / "robots-hello-ann")
    (row,) = compare.compared(scores(ann=50), gradebook(ann="100"), "hello", tmp_path)
    head = git(clone, "rev-parse", "HEAD").strip()
    assert compare.head_of(clone) == head
    git(clone, "pack-refs", "--all")
    assert compare.head_of(clone) == head
    assert row.commit == f"marked here: commit {head[:7]}, there: a1b2c3d"
    assert row.differs


@pytest.mark.parametrize(
    ("content", "slug", "said"),
    [
        (b"{}", "", "no scores.json of Classroom 50: KeyError"),
        (b"no json", "", "no scores.json"),
        (scores(ann=1), "helo", "did you mean 'hello'"),
    ],
)
def test_another_file_is_refused(content: bytes, slug: str, said: str, tmp_path: Path) -> None:
    (tmp_path / "scores.json").write_bytes(content)
    (tmp_path / "gradebook.csv").write_bytes(gradebook(ann="1"))
    words = [sys.executable, "-m", "grader", "classroom50-compare"]
    words += [str(tmp_path / "scores.json"), str(tmp_path / "gradebook.csv"), "--slug", slug]
    done = processes.run(words)
    assert done.returncode == 2
    assert said in done.stderr
