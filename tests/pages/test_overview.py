"""The counts of the overview, calculated by hand for small classes."""

from __future__ import annotations

from typing import Any

import pytest

from grader.batch.model import GradebookEntry
from grader.publish.pages import overview
from grader.report.model import Mistake, Timing
from tests.pages.classes import entry, result
from tests.report.samples import check, report

TEXT = [Mistake(id="run.wrong_text")]


def failed(check_id: str, **fields: Any) -> Any:
    return check(check_id, "failed", mistakes=TEXT, **fields)


def graded(number: int, final: float) -> GradebookEntry:
    return entry(number, report(), score=final, final=final)


def test_a_bar_includes_its_left_end_and_the_last_bar_full_marks() -> None:
    finals = [0, 9.99, 10, 55, 90, 100]
    found = overview.scores(result([graded(n, final) for n, final in enumerate(finals)]))
    assert found is not None
    assert [b.count for b in found.bins] == [2, 1, 0, 0, 0, 1, 0, 0, 0, 2]
    assert (found.bins[1].low, found.bins[1].high) == (10, 20)
    assert (found.lowest, found.highest, found.median) == (0, 100, 32.5)


def test_points_outside_the_range_are_counted() -> None:
    found = overview.scores(result([graded(1, 104), graded(2, -3)]))
    assert found is not None
    assert (found.bins[0].count, found.bins[-1].count) == (1, 1)


def test_students_without_points_are_not_in_the_histogram() -> None:
    missing = entry(2, None, status="missing", final=0)
    waiting = entry(3, None, status="ungradable")
    found = overview.scores(result([graded(1, 50), missing, waiting]))
    assert found is not None
    assert found.count == 1
    assert overview.scores(result([missing, waiting])) is None


def test_an_assignment_without_points_has_no_histogram() -> None:
    found = overview.scores(result([graded(1, 0)], max_score=0))
    assert found is not None
    assert found.bins == ()


def test_the_rate_covers_students_with_a_known_result() -> None:
    reports = [
        report(failed("run.output")),
        report(),
        report(check("run.output", "skipped")),
        report(check("run.output", "inconclusive")),
        report(check("run.output", "error")),
    ]
    entries = [entry(number, one) for number, one in enumerate(reports)]
    first = overview.checks(result(entries), show_hidden=True)[0]
    assert first.id == "run.output"
    assert (first.failed, first.passed, first.skipped, first.unknown) == (1, 1, 1, 2)
    assert first.rate == pytest.approx(0.5)
    assert not first.clean


def test_the_most_failed_check_is_first() -> None:
    entries = [
        entry(1, report(failed("run.output"), failed("run.logger"))),
        entry(2, report(failed("run.logger"))),
        entry(3, report()),
    ]
    ids = [tally.id for tally in overview.checks(result(entries), show_hidden=True)]
    assert ids[:2] == ["run.logger", "run.output"]


def test_a_mistake_at_two_checks_counts_its_student_once() -> None:
    entries = [
        entry(1, report(failed("run.output", actual="x"), failed("run.logger"))),
        entry(2, report(failed("run.output"))),
        entry(3, report()),
    ]
    (found,) = overview.mistakes(result(entries), show_hidden=True)
    assert found.id == "run.wrong_text"
    assert [one.student.key for one in found.who] == ["1001", "1002"]
    assert found.checks == ["run.output", "run.logger"]
    assert [text for _, text in found.examples] == ["x"]


def test_the_more_frequent_mistake_is_first() -> None:
    other = [Mistake(id="a.rare")]
    entries = [
        entry(1, report(failed("run.output"), check("run.logger", "failed", mistakes=other))),
        entry(2, report(failed("run.output"))),
    ]
    found = overview.mistakes(result(entries), show_hidden=True)
    assert [tally.id for tally in found] == ["run.wrong_text", "a.rare"]


def test_hidden_checks_are_not_counted_unless_shown() -> None:
    secret = failed("run.output", visibility="hidden")
    later = check("run.logger", "inconclusive", visibility="after_due_date")
    one = result([entry(1, report(secret, later))])
    assert overview.mistakes(one, show_hidden=True)
    assert overview.unsure(one, show_hidden=True)
    assert not overview.mistakes(one, show_hidden=False)
    assert not overview.unsure(one, show_hidden=False)
    ids = {tally.id for tally in overview.checks(one, show_hidden=False)}
    assert not ids & {"run.output", "run.logger"}


def test_the_slowest_submissions_with_a_verdict_are_first() -> None:
    entries = [entry(n, report(timing=Timing(total=n % 7 + n / 100))) for n in range(12)]
    entries.append(entry(99, None, status="missing"))
    found = [one.report.timing.total for one in overview.slowest(result(entries)) if one.report]
    assert found == sorted(found, reverse=True)
    assert len(found) == 10
    assert found[0] == pytest.approx(6.06)
