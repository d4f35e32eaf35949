"""Clones of GitHub Classroom: their students and their submission times."""

from __future__ import annotations

from datetime import datetime, timedelta, timezone
from pathlib import Path

import pytest

from grader.batch.discover import discover
from grader.batch.model import ClassFolder, GradebookEntry, HandedIn
from grader.batch.policy import Attempt, standing
from grader.course.policy import Late, Policy
from tests.report.samples import report

from .archives import package, repository, write

DUE = datetime(2026, 3, 4, 9, 20, 30, tzinfo=timezone.utc)
POLICY = Policy(due=DUE, late=Late(per_day="10%"))
HEADER = (
    "assignment_name,assignment_url,starter_code_url,github_username,roster_identifier,"
    "student_repository_name,student_repository_url,submission_timestamp,points_awarded,"
    "points_available\n"
)


def found_in(path: Path, roster: Path | None = None) -> ClassFolder:
    return discover(path, roster=roster, unpack=path.parent / "work")


def grades(path: Path, **times: str) -> Path:
    """Write Classroom's "Download grades" file: a line with the time for each user."""
    lines = (f"hw,u,s,{user},,org/hw-{user},r,{time},0,100\n" for user, time in times.items())
    path.write_text(HEADER + "".join(lines), encoding="utf-8")
    return path


def entry_of(given: HandedIn) -> GradebookEntry:
    """Return what a right package gets under the policy."""
    attempt = Attempt(1, given.submitted, given.late, report(), notes=given.notes)
    return standing(given.student, [attempt], [], POLICY, 100)


def test_a_clone_is_identified_by_the_part_after_the_assignments_name(tmp_path: Path) -> None:
    root = tmp_path / "hw"
    for user in ("ann-lee", "joe"):
        repository(root / f"hello-time-{user}")
    write(root / "mail-max", package())
    found = found_in(root)
    assert found.system.name == "github_classroom"
    ann, joe, max_ = found.handed_in
    assert (ann.student.key, ann.student.username) == ("hello-time-ann-lee", "ann-lee")
    assert joe.student.username == "joe"
    assert max_.student.key == "mail-max"


def test_a_single_clone_is_identified_by_the_folder_that_gh_makes(tmp_path: Path) -> None:
    repository(tmp_path / "hw1-submissions" / "hw1-ann")
    (ann,) = found_in(tmp_path / "hw1-submissions").handed_in
    assert ann.student.username == "ann"


@pytest.mark.parametrize("days", [-3, 3])
def test_the_commit_time_does_not_decide_lateness(tmp_path: Path, days: int) -> None:
    """The student's computer sets it: `git commit --date` can backdate any commit."""
    at = (DUE + timedelta(days=days)).isoformat()
    for user in ("ann", "joe"):
        repository(tmp_path / "hw" / f"hw-{user}", at=at)
    found = found_in(tmp_path / "hw")
    assert [given.submitted for given in found.handed_in] == [None, None]
    assert "sets the time of a commit" in "\n".join(found.notes)
    entry = entry_of(found.handed_in[0])
    assert (entry.penalty, entry.final) == (0, 100)
    assert "time of submission is not known" in entry.notes[-1]


def test_lateness_comes_from_the_grades_file_of_classroom(tmp_path: Path) -> None:
    for user in ("ann", "joe", "max"):
        repository(tmp_path / "hw" / f"hw-{user}")
    file = grades(
        tmp_path / "grades.csv",
        ann="2026-03-04T09:20:30Z",
        joe="2026-03-05 09:20:31 UTC",
        max="",
    )
    found = found_in(tmp_path / "hw", file)
    ann, joe, max_ = found.handed_in
    late = DUE + timedelta(days=1, seconds=1)
    assert [given.submitted for given in (ann, joe, max_)] == [DUE, late, None]
    assert [entry_of(given).final for given in (ann, joe, max_)] == [100, 80, 100]
    assert "not known" not in "\n".join(entry_of(ann).notes)
    assert "not known" in entry_of(max_).notes[-1]


def test_an_invalid_time_in_the_grades_file_is_ignored(tmp_path: Path) -> None:
    for user in ("ann", "joe"):
        repository(tmp_path / "hw" / f"hw-{user}")
    file = grades(tmp_path / "grades.csv", ann="MM-DD-YYYY", joe="2026-99-99T00:00:00Z")
    found = found_in(tmp_path / "hw", file)
    assert [given.submitted for given in found.handed_in] == [None, None]


def test_no_program_that_a_repository_configures_is_run(tmp_path: Path) -> None:
    """An fsmonitor, hooks, an alias and a pager that would leave a file."""
    trap = tmp_path / "trap.sh"
    trap.write_text(f"#!/bin/sh\ntouch {tmp_path}/sprung\n")
    trap.chmod(0o755)
    for user in ("ann", "eve"):
        made = repository(tmp_path / "hw" / f"hw-{user}")
        with (made / ".git/config").open("a") as config:
            config.write(
                f"[core]\n\tfsmonitor = {trap}\n\tpager = {trap}\n\thooksPath = {tmp_path}\n"
            )
            config.write(f"[alias]\n\tlog = !{trap}\n[diff]\n\texternal = {trap}\n")
    found = found_in(tmp_path / "hw")
    assert [given.student.username for given in found.handed_in] == ["ann", "eve"]
    assert not (tmp_path / "sprung").exists()
