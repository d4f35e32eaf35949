"""The texts of a student's page about points and checks."""

from __future__ import annotations

from datetime import datetime, timezone

from grader.batch.model import Override
from grader.batch.words import duration, instant
from grader.publish.pages.student import student_view
from tests.pages.classes import entry
from tests.report.samples import check, failing_report, report

AT = datetime(2026, 11, 20, 22, 30, tzinfo=timezone.utc)


def calculation(**fields: object) -> str:
    return "\n".join(
        student_view(entry(1, failing_report(), **fields), show_hidden=True).calculation
    )


def test_points_that_nobody_touched_are_said_to_be_the_checks() -> None:
    assert calculation() == "These are the points that the checks gave."


def test_a_late_penalty_is_explained() -> None:
    output = calculation(penalty=5.0, late_seconds=7_800.0, final=55.0)
    assert "Late by 2 h 10 min: 5 points taken." in output
    assert "55 of 100 go into the gradebook." in output


def test_late_without_a_penalty_says_so() -> None:
    assert "no points taken" in calculation(late_seconds=60.0)


def test_a_correction_shows_its_reason_author_and_the_earlier_points() -> None:
    override = Override("1001", "run.output", 10, "shown in the laboratory", by="M. C.", at=AT)
    output = calculation(overrides=(override,), score=70.0, final=70.0)
    assert "run.output gives 10 instead of 0, because: shown in the laboratory" in output
    assert "M. C., 2026-11-20 22:30 UTC" in output
    assert "The score is then 70." in output


def test_a_correction_of_the_total_is_called_so() -> None:
    output = calculation(
        overrides=(Override("1001", "", 80, "an oral exam"),), score=80.0, final=80.0
    )
    assert "the total gives 80, because: an oral exam" in output


def test_the_attempt_that_counts_is_named() -> None:
    assert "Attempt 2 of 3 is the one that counts." in calculation(attempt=2, attempts=3)


def test_points_that_wait_for_the_instructor_are_said_to_wait() -> None:
    assert "Nothing goes into the gradebook yet." in calculation(final=None)


def test_undecided_points_are_shown_with_the_total() -> None:
    doubtful = report(check("run.period", "inconclusive"))
    output = student_view(entry(1, doubtful), show_hidden=True).calculation
    assert "4 points could be neither given nor taken." in output


def test_a_grader_failure_is_not_shown_as_the_students_fault() -> None:
    fault = report(status="error", checks=[], score=0, message="no sandbox")
    view = student_view(entry(1, fault, status="error", final=None), show_hidden=True)
    assert "the fault is in the grader" in view.calculation[0]
    assert view.calculation[1:] == ("Nothing goes into the gradebook yet.",)


def test_a_skipped_check_names_its_cause() -> None:
    view = student_view(entry(1, failing_report()), show_hidden=True)
    skipped = next(v for v in view.checks if v.check.id == "run.output")
    assert skipped.because == ("entry_point.mapping",)
    assert not skipped.needs_block


def test_a_failed_check_links_to_its_evidence() -> None:
    view = student_view(entry(1, failing_report()), show_hidden=True)
    failed = next(v for v in view.checks if v.check.status == "failed")
    assert failed.log == "transcript"
    labels = [field.label for field in failed.fields]
    assert labels == ["Expected", "Found", "Where", "Why", "Fix", "Change", "Mistake"]


def test_no_text_of_a_hidden_check_is_shown_to_students() -> None:
    secret = check(
        "run.output", "failed", visibility="hidden", actual="the secret", fix="the secret fix"
    )
    skipped = check("run.logger", "skipped", blocked_by="run.output", depends=["run.output"])
    override = Override("1001", "run.output", 10, "the secret reason")
    view = student_view(entry(1, report(secret, skipped), overrides=(override,)), show_hidden=False)
    assert view.hidden == 1
    assert "secret" not in repr(view.checks) + repr(view.calculation)
    assert "run.output" not in repr(view.calculation)
    (logger,) = [v for v in view.checks if v.check.id == "run.logger"]
    assert logger.because == ("a hidden check",)


def test_durations_have_their_two_largest_units() -> None:
    output = [duration(seconds) for seconds in (4.24, 60, 600.9, 7_800, 86_400, 277_300)]
    assert output == ["4.2 s", "1 min", "10 min", "2 h 10 min", "1 d", "3 d 5 h"]


def test_times_are_shown_in_utc() -> None:
    east = datetime.fromisoformat("2026-11-21T00:30:00+02:00")
    assert instant(east) == "2026-11-20 22:30 UTC"
    assert instant(None) == ""
