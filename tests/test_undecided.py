"""A check that could not be decided takes no points, and neither do those that depend on it."""

from __future__ import annotations

from grader.verdict.static import evaluate_static
from tests.corpus.build import SOLUTION
from tests.marking import ASSIGNMENT, taken_in


def test_what_depends_on_an_undecided_check_is_undecided() -> None:
    """Without a build, nothing is known of what follows; nothing is skipped as if it had failed."""
    results = {r.id: r for r in evaluate_static(taken_in(SOLUTION), ASSIGNMENT)}
    assert results["build.colcon"].status == "inconclusive"
    assert results["build.colcon"].blocked_by == ""
    later = [results[check] for check in ("entry_point.executable", "run.starts", "run.period")]
    assert {result.status for result in later} == {"inconclusive"}
    assert {result.blocked_by for result in later} == {"build.colcon"}
