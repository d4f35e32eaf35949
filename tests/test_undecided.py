"""A check that could not be decided takes no points, and neither do those that depend on it."""

from __future__ import annotations

from grader.base.i18n.translator import Translator
from grader.run.run import Run
from grader.run.workspace import BUILD, Build
from grader.sandbox.base import LOAD
from grader.verdict.evaluate import evaluate_checks
from grader.verdict.evidence import Evidence
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


def test_a_build_that_only_the_load_ended_takes_no_points() -> None:
    stopped = Build(BUILD, None, "", 1200.0, stopped_by=LOAD)
    evidence = Evidence(ASSIGNMENT, taken_in(SOLUTION), build=lambda: stopped, run=lambda: Run(""))
    found = {r.id: r.status for r in evaluate_checks(evidence, Translator("en"))}
    assert set(found.values()) == {"passed", "inconclusive"}
    assert {found["build.colcon"], found["run.starts"]} == {"inconclusive"}
