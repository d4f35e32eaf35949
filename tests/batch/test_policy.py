"""The assignment's policy: due date, grace, penalty, attempts, corrections, as tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import datetime, timedelta, timezone
from typing import Any, cast
from zoneinfo import ZoneInfo

import pytest

from grader.batch.model import UNKNOWN, GradebookEntry, LapsedOverride, Override, Student
from grader.batch.policy import Attempt, lateness, penalty, standing
from grader.course.policy import Policy
from tests.report.samples import check, report

DUE = datetime(2026, 11, 20, 14, 59, tzinfo=timezone.utc)
KIM = Student("kim", "Kim Minji")
HOUR, DAY = 3600, 86_400


def policy(**late: Any) -> Policy:
    own = {name: late.pop(name) for name in ("grace", "attempts", "missing") if name in late}
    return Policy.model_validate({"due": DUE, "late": late, **own})


def after(seconds: float) -> datetime:
    return DUE + timedelta(seconds=seconds)


@pytest.mark.parametrize(
    ("seconds", "grace", "late"),
    [
        (-1, "0 s", 0),
        (0, "0 s", 0),
        (1, "0 s", 1),
        (900, "15 min", 0),
        (901, "15 min", 901),
        (DAY, "1 d", 0),
        (DAY + 1, "1 d", DAY + 1),
        (90, "1.5 min", 0),
        (7201, "2 h", 7201),
    ],
)
def test_nothing_is_late_within_the_grace_time(seconds: float, grace: str, late: float) -> None:
    assert lateness(after(seconds), policy(grace=grace)) == late


def test_without_a_due_date_nothing_is_late() -> None:
    assert lateness(after(10 * DAY), Policy()) == 0
    assert lateness(None, Policy()) is None, "not 0: nothing is known"
    assert penalty(80, 100, None, policy(per_day="10%")) == 0


@pytest.mark.parametrize(
    ("seconds", "late", "taken"),
    [
        (1, {"per_day": "10%"}, 10),
        (DAY, {"per_day": "10%"}, 10),
        (DAY + 1, {"per_day": "10%"}, 20),
        (30 * DAY, {"per_day": "10%", "most": "50%"}, 50),
        (30 * DAY, {"per_day": "10%"}, 80),
        (HOUR, {"per_hour": "2"}, 2),
        (HOUR + 1, {"per_hour": 2}, 4),
        (3 * DAY, {"per_day": 5, "most": 12}, 12),
        (1, {"per_day": "12.5%"}, 12.5),
        (2 * DAY - 1, {"per_day": "10%", "until": after(2 * DAY)}, 20),
        (2 * DAY, {"per_day": "10%", "until": after(2 * DAY)}, 80),
        (-1, {"per_day": "10%"}, 0),
        (10 * DAY, {}, 0),
    ],
)
def test_each_started_day_or_hour_counts_in_full(
    seconds: float, late: dict[str, Any], taken: float
) -> None:
    assert penalty(80, 100, after(seconds), policy(**late)) == taken


def test_a_penalty_is_never_more_than_the_score() -> None:
    assert penalty(15, 100, after(5 * DAY), policy(per_day="10%")) == 15


@pytest.mark.parametrize(
    ("due", "zone", "submitted", "late"),
    [
        # the clocks of Berlin go back one hour in the night to 2026-10-25
        ("2026-10-24T23:00:00", "Europe/Berlin", "2026-10-25T23:00:00+01:00", 25 * HOUR),
        # New York's go forward in the night to 2026-03-08
        ("2026-03-07T23:00:00", "America/New_York", "2026-03-08T23:00:00-04:00", 23 * HOUR),
        ("2026-11-20T23:59:00", "Asia/Seoul", "2026-11-20T15:00:00+00:00", 60),
        ("2026-11-20T23:59:00+09:00", "", "2026-11-20T14:59:00+00:00", 0),
    ],
)
def test_times_are_compared_across_changes_of_the_clocks(
    due: str, zone: str, submitted: str, late: float
) -> None:
    found = Policy(due=datetime.fromisoformat(due), time_zone=zone)
    assert lateness(datetime.fromisoformat(submitted), found) == late


def test_two_times_in_one_zone_are_compared_as_instants() -> None:
    berlin = ZoneInfo("Europe/Berlin")
    found = Policy(due=datetime(2026, 10, 24, 23), time_zone="Europe/Berlin")
    assert lateness(datetime(2026, 10, 25, 23, tzinfo=berlin), found) == 25 * HOUR


def attempt(number: int, seconds: float | None, lost: Sequence[str] = (), **more: Any) -> Attempt:
    """An attempt that failed the checks `lost`; `seconds` after the due date."""
    usual: dict[str, Any] = {
        "submitted": None if seconds is None else after(seconds),
        "late": None,
        "report": report(*(check(name, "failed") for name in lost)),
    }
    return Attempt(number, **{**usual, **more})


def stand(*attempts: Attempt, overrides: Sequence[Override] = (), **rules: Any) -> GradebookEntry:
    """Return the entry; `overrides` correct no verdict of these attempts."""
    return standing(KIM, attempts, overrides, policy(**rules), 100)


def test_the_best_attempt_is_the_one_with_the_most_points_after_its_penalty() -> None:
    early, full_but_late = attempt(1, -HOUR, ["run.output"]), attempt(2, 1)
    entry = stand(early, full_but_late, per_day="20%", attempts="best")
    assert (entry.attempt, entry.score, entry.penalty, entry.final) == (1, 90, 0, 90)
    entry = stand(early, full_but_late, per_day="5%", attempts="best")
    assert (entry.attempt, entry.score, entry.penalty, entry.final) == (2, 100, 5, 95)
    assert entry.attempts == 2
    assert entry.late_seconds == 1


def test_the_earlier_of_two_equal_attempts_counts() -> None:
    assert stand(attempt(1, -HOUR), attempt(2, -60), attempts="best").attempt == 1


def test_the_last_attempt_counts_even_if_it_is_worse() -> None:
    entry = stand(attempt(1, -HOUR), attempt(2, -60, ["run.output"]), attempts="last")
    assert (entry.attempt, entry.final) == (2, 90)
    assert stand(attempt(1, 0, ["run.output"]), attempt(2, 0), attempts="first").final == 90


def test_an_ungradable_attempt_is_never_better_than_a_verdict() -> None:
    broken = attempt(2, -60, report=None, problem="the archive ends in the middle")
    lost = attempt(1, -HOUR, ["run.output"])
    assert stand(lost, broken, attempts="best").final == 90
    entry = stand(lost, broken, attempts="last")
    assert (entry.status, entry.final) == ("ungradable", None)
    assert entry.problem == "the archive ends in the middle"
    assert stand(broken, attempts="best").status == "ungradable"


def test_a_report_of_a_grader_failure_is_not_a_verdict() -> None:
    failed = report().model_copy(update={"status": "error", "message": "the disk was full"})
    entry = stand(attempt(1, -HOUR, report=failed), attempts="best")
    assert (entry.status, entry.final, entry.problem) == ("error", None, "the disk was full")
    lost = attempt(1, -HOUR, ["run.output"])
    assert stand(lost, attempt(2, -60, report=failed), attempts="best").final == 90


def test_an_unmarked_attempt_is_pending() -> None:
    entry = stand(attempt(1, -60, report=None))
    assert (entry.status, entry.score, entry.final) == ("pending", None, None)


@pytest.mark.parametrize(("missing", "final"), [("zero", 0), ("none", None)])
def test_a_missing_student_gets_what_the_policy_says(missing: str, final: float | None) -> None:
    entry = stand(missing=missing)
    assert (entry.status, entry.final) == ("missing", final)


def test_a_corrected_check_counts_before_the_penalty() -> None:
    override = Override("kim", "run.output", 8, "the text was given wrongly in class")
    entry = stand(attempt(1, 1, ["run.output"], overrides=(override,)), per_day="50%")
    assert (entry.score, entry.penalty, entry.final) == (98, 50, 48)
    assert entry.report is not None
    assert entry.report.score == 90, "the verdict itself is never changed"
    assert entry.overrides == (override,)


def test_a_corrected_total_is_final() -> None:
    override = Override("kim", "", 77, "agreed in the office hour")
    for found in (
        stand(attempt(1, 5 * DAY, ["run.output"], overrides=(override,)), per_day="10%"),
        stand(attempt(1, 0, report=None, problem="corrupt", overrides=(override,))),
        stand(overrides=[override]),
    ):
        assert (found.score, found.penalty, found.final) == (77, 0, 77)


@pytest.mark.parametrize("check_id", ["", "run.output"])
@pytest.mark.parametrize("attempts", ["best", "last"])
def test_a_correction_counts_for_its_own_attempt_only(check_id: str, attempts: str) -> None:
    override = Override("kim", check_id, 5, "shown in class", verdict=1)
    first = attempt(1, -HOUR, ["run.output"], overrides=(override,))
    entry = stand(first, attempt(2, -60), attempts=attempts)
    assert (entry.attempt, entry.final, entry.overrides) == (2, 100, ())
    assert entry.lapsed == (LapsedOverride(override, attempt=1),)
    # repeated for the attempt that counts, it is listed no longer
    again = replace(override, points=99, verdict=2)
    entry = stand(first, attempt(2, -60, overrides=(again,)), attempts=attempts)
    assert (entry.attempt, entry.overrides, entry.lapsed) == (2, (again,), ())
    # undone, its attempt has its own points again
    assert stand(attempt(1, -HOUR, ["run.output"]), attempts=attempts).final == 90


def test_a_correction_that_makes_an_attempt_the_best_one_holds() -> None:
    override = Override("kim", "", 95, "shown in class", verdict=1)
    first = attempt(1, -HOUR, ["run.output"], overrides=(override,))
    entry = stand(first, attempt(2, -60, ["run.output"]), attempts="best")
    assert (entry.attempt, entry.final, entry.overrides, entry.lapsed) == (1, 95, (override,), ())


@pytest.mark.parametrize("verdict", [1, UNKNOWN])
def test_a_correction_of_no_attempt_is_listed(verdict: int) -> None:
    override = Override("kim", "", 10, "copied", verdict=verdict)
    assert stand(attempt(1, 0), overrides=[override]).lapsed == (LapsedOverride(override),)
    assert stand(overrides=[override], missing="zero").final == 0
    assert stand(overrides=[override]).lapsed == (LapsedOverride(override),)


def without_package(**more: Any) -> Attempt:
    found = report(check("package.found", "failed", actual="a.7z is a 7z archive"))
    submission = found.submission.model_copy(update={"package": None})
    return attempt(1, 0, report=found.model_copy(update={"submission": submission}), **more)


def test_what_holds_no_package_has_no_grade_until_the_instructor_gives_one() -> None:
    for rules in cast("list[dict[str, Any]]", [{}, {"missing": "zero"}, {"attempts": "best"}]):
        entry = stand(without_package(), **rules)
        assert (entry.status, entry.score, entry.final) == ("ungradable", None, None)
        assert entry.by_hand == ("a.7z is a 7z archive",)
        assert entry.report is not None, "the student reads what to do"
    entry = stand(without_package(overrides=(Override("kim", "", 70, "read it"),)))
    assert (entry.status, entry.final, entry.by_hand) == ("graded", 70, ())


def test_a_later_attempt_that_holds_no_package_is_listed_beside_the_best_one() -> None:
    entry = stand(attempt(1, -60, ["run.output"]), replace(without_package(), number=2))
    assert (entry.status, entry.final) == ("graded", 90)
    assert entry.by_hand == ("attempt 2, later than the one that counts: a.7z is a 7z archive",)
    fixed = stand(without_package(), attempt(2, 0))
    assert (fixed.attempt, fixed.final, fixed.by_hand) == (2, 100, ())


def test_an_unknown_time_costs_nothing_and_is_noted() -> None:
    entry = stand(attempt(1, None, late=True), per_day="10%")
    assert (entry.penalty, entry.final) == (0, 100)
    assert "not known" in entry.notes[-1]
    assert "calls it late" in entry.notes[-1]
