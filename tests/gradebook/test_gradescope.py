"""Gradescope's results.json: its fields, the points, and what students must not see."""

from __future__ import annotations

import json
from datetime import datetime, timezone
from pathlib import Path

import jsonschema
import pytest
from hypothesis import given, settings

from grader.batch.model import ClassResult, Override
from grader.batch.systems.gradescope import container
from grader.batch.systems.gradescope import write as gradescope
from grader.report.detail import Detail
from grader.report.model import Report
from tests.gradebook.hostile_texts import hostile_entry, texts
from tests.gradebook.schemas import GRADESCOPE
from tests.processes import ROOT
from tests.report import samples


def test_real_reports_give_results_that_gradescope_reads(mixed: ClassResult) -> None:
    reports = [entry.report for entry in mixed.entries if entry.report is not None]
    for report in reports:
        found = gradescope.results(report)
        jsonschema.validate(json.loads(gradescope.results_json(found)), GRADESCOPE)
        assert found["score"] == sum(test["score"] for test in found["tests"])
        assert [test["max_score"] for test in found["tests"]] == [
            check.max_score for check in report.checks
        ]


def test_a_failed_check_says_what_was_found_and_how_to_fix_it(broken: Report) -> None:
    tests = {t["extra_data"]["check"]: t for t in gradescope.results(broken)["tests"]}
    output = tests["run.output"]["output"]
    assert tests["run.output"]["status"] == "failed"
    assert broken.check("run.output").fix.split()[0] in output
    assert "found" in output
    assert tests["build.colcon"]["status"] == "passed"


def test_each_check_keeps_its_visibility_and_hidden_ones_are_not_named() -> None:
    hidden = samples.check("build.colcon", "failed", visibility="hidden", actual="secret fault")
    late = samples.check("run.logger", "passed", visibility="after_due_date")
    blocked = samples.check("run.output", "skipped", blocked_by="build.colcon")
    found = gradescope.results(samples.report(hidden, late, blocked))
    tests = {t["extra_data"]["check"]: t for t in found["tests"]}
    shown = {check: test["visibility"] for check, test in tests.items()}
    assert shown.pop("build.colcon") == "hidden"
    assert shown.pop("run.logger") == "after_due_date"
    assert set(shown.values()) == {"visible"}
    for check, test in tests.items():
        if check not in ("build.colcon", "run.logger"):
            assert "build.colcon" not in json.dumps(test)
    assert "a hidden check did not pass" in tests["run.output"]["output"]
    assert "build.colcon" not in found["output"]
    assert "secret" not in found["output"]


def test_penalty_and_corrections_are_in_the_score_and_in_the_text() -> None:
    change = Override("1", "entry_point.mapping", 12.5, "a typo of the sheet", by="M. Curie")
    report = samples.failing_report()
    found = gradescope.results(report, penalty=5, overrides=(change,))
    assert found["score"] == report.score + 12.5 - 5
    assert "Points taken for lateness: -5 points" in found["output"]
    tests = {t["extra_data"]["check"]: t for t in found["tests"]}
    assert tests["entry_point.mapping"]["score"] == 12.5
    assert "M. Curie" in tests["entry_point.mapping"]["output"]
    assert "a typo of the sheet" in tests["entry_point.mapping"]["output"]


@pytest.mark.parametrize("penalty", [100, 1_000])
def test_a_penalty_never_gives_a_negative_score(penalty: float) -> None:
    assert gradescope.results(samples.failing_report(), penalty=penalty)["score"] == 0


def test_an_inconclusive_check_is_neither_passed_nor_failed() -> None:
    open_ = samples.check("run.period", "inconclusive", actual="too busy")
    found = gradescope.results(samples.report(open_))
    test = next(t for t in found["tests"] if t["extra_data"]["check"] == "run.period")
    assert "status" not in test
    assert found["score"] == 96
    assert "4 points could be neither given nor taken" in found["output"]


def test_a_grader_failure_is_called_one() -> None:
    found = gradescope.results(samples.report(status="error", checks=[], score=0))
    assert found["score"] == 0
    assert "not your package" in found["output"]


@settings(max_examples=60)
@given(texts)
def test_hostile_texts_are_shown_as_harmless_text(text: str) -> None:
    report = hostile_entry(text).report
    assert report is not None
    written = gradescope.results_json(gradescope.results(report))
    assert written.isascii()
    assert "\r" not in written
    found = json.loads(written)
    jsonschema.validate(found, GRADESCOPE)
    for test in found["tests"]:
        assert test["name"].isprintable()
        assert test["output"].replace("\n", "").isprintable()


@pytest.mark.parametrize(
    ("theirs", "policy", "told"),
    [
        ("2999-01-01T00:00:00.000000-08:00", "", False),
        ("2020-01-01T00:00:00.000000-08:00", "", True),
        ("2020-01-01T00:00:00.000000-08:00", "policy: {due: 2999-01-01T00:00:00Z}", False),
        (None, "", True),
        ("soon", "", True),
    ],
)
def test_gradescopes_due_date_counts_if_the_policy_has_none(
    theirs: str | None, policy: str, told: bool, tmp_path: Path
) -> None:
    lesson = ROOT / "lab/course/hello_time/assignment.yaml"
    file = tmp_path / "assignment.yaml"
    file.write_text(f"{lesson.read_text(encoding='utf-8')}{policy}\n", encoding="utf-8")
    metadata = {"assignment": {"due_date": theirs}}
    order = container.order_for(tmp_path, metadata, str(file), "jazzy", "account")
    rules, due = order.assignment.feedback, order.assignment.policy.deadline
    detail = rules.handed_back(due, datetime(2026, 11, 20, tzinfo=timezone.utc))
    assert (detail == Detail.LINE) == told
