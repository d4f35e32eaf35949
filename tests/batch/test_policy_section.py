"""The `policy:` section of an assignment: what is read, and what is refused with which line."""

from __future__ import annotations

from datetime import datetime, timezone
from pathlib import Path

import pytest

from grader.base.errors import AssignmentError
from grader.course.assignment import Assignment
from grader.course.load import load_assignment
from tests.processes import ROOT

DUE = datetime(2026, 11, 20, 14, 59, tzinfo=timezone.utc)
COURSE = ROOT / "lab/course/hello_time/assignment.yaml"


def load(tmp_path: Path, text: str) -> Assignment:
    path = tmp_path / "assignment.yaml"
    path.write_text(COURSE.read_text(encoding="utf-8") + text, encoding="utf-8")
    return load_assignment(path)


FULL = """\
policy:
  due: 2026-11-20T23:59:00+09:00
  grace: 15 min
  late: {per_day: 10, most: 50%, until: 2026-12-01T00:00:00Z}
  attempts: last
  missing: none
"""


def test_a_policy_is_read_from_the_assignment(tmp_path: Path) -> None:
    found = load(tmp_path, FULL).policy
    assert found.deadline == DUE
    assert found.grace_seconds == 900
    assert (found.late.per_day, found.attempts, found.missing) == ("10", "last", "none")
    assert found.end == datetime(2026, 12, 1, tzinfo=timezone.utc)


def test_a_policy_does_not_change_the_assignments_hash(tmp_path: Path) -> None:
    assert load(tmp_path, FULL).sha256 == load(tmp_path, "").sha256


def test_a_policy_is_sent_to_a_worker_unchanged(tmp_path: Path) -> None:
    found = load(tmp_path, FULL)
    text = found.model_dump_json(by_alias=True)
    assert Assignment.model_validate_json(text).policy == found.policy


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("policy: {due: 2026-11-20T23:59:00}", 1, "due has no time zone"),
        ("policy:\n  due: tomorrow", 2, "must be a date and time"),
        ('policy:\n  due: "2026-11-20T23:59:00Z"', 2, "without quotes"),
        ("policy:\n  due: 0001-01-01T00:00:00+09:00", 2, "in the year 1"),
        ("policy:\n  due: 9999-12-31T23:59:00-09:00", 2, "in the year 9999"),
        ("policy:\n  duee: 2026-11-20T23:59:00Z", 2, "did you mean 'due'"),
        ("policy:\n  grace: 15 minutes", 2, "a duration such as 15 min"),
        ("policy:\n  due: 2026-11-20T23:59:00Z\n  late: {per_dya: 10%}", 3, "'per_day'"),
        ("policy:\n  due: 2026-11-20T23:59:00Z\n  late: {per_day: much}", 3, "a share"),
        ("policy:\n  late: {per_day: 10%}", 2, "no due date"),
        ("policy:\n  attempts: newest", 2, "attempts must be"),
        ("policy:\n  time_zone: Mars/Olympus", 2, "unknown time zone 'Mars/Olympus'"),
        (
            "policy:\n  due: 2026-11-20T23:59:00Z\n  late: {per_day: 1, per_hour: 1}",
            3,
            "keep one",
        ),
        (
            "policy:\n  due: 2026-11-20T23:59:00Z\n  late: {until: 2026-11-01T00:00:00Z}",
            3,
            "before due",
        ),
    ],
)
def test_an_invalid_policy_is_reported_with_its_line(
    tmp_path: Path, text: str, line: int, words: str
) -> None:
    before = len(COURSE.read_text(encoding="utf-8").splitlines())
    with pytest.raises(AssignmentError, match=words) as caught:
        load(tmp_path, text)
    assert f"assignment.yaml:{before + line}:" in str(caught.value)
