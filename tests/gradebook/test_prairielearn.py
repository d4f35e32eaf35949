"""PrairieLearn's results.json: gradable or not, points of all tests, at most one megabyte."""

from __future__ import annotations

import json

import jsonschema
from hypothesis import given, settings

from grader.batch.model import ClassResult
from grader.batch.points import single
from grader.batch.systems.prairielearn import write as prairielearn
from grader.report.model import Report
from tests.gradebook.hostile_texts import hostile_entry, texts
from tests.gradebook.schemas import PRAIRIELEARN
from tests.pages import classes
from tests.report import samples


def test_the_score_is_the_share_of_the_final_points(mixed: ClassResult) -> None:
    for entry in mixed.entries:
        found = json.loads(prairielearn.results_json(prairielearn.results(entry)))
        jsonschema.validate(found, PRAIRIELEARN)
        assert found["gradable"] == (entry.final is not None)
        if entry.final is not None and entry.report is not None:
            assert found["score"] == entry.final / 100
            assert len(found["tests"]) == len(entry.report.checks)


def test_an_unreadable_archive_costs_no_attempt() -> None:
    entry = classes.entry(1, None, status="ungradable", problem="not a zip file any more")
    found = prairielearn.results(entry)
    assert found["gradable"] is False
    assert found["format_errors"] == ["not a zip file any more"]
    assert "score" not in found


def test_corrections_and_lateness_are_shown(mixed: ClassResult) -> None:
    late, corrected = mixed.entry("1003"), mixed.entry("1009")
    assert "late: -5 points" in prairielearn.results(late)["message"]
    tests = {test["name"]: test for test in prairielearn.results(corrected)["tests"]}
    assert tests["run.output"]["points"] == 10
    assert "M. Curie" in tests["run.output"]["message"]


def test_hidden_checks_have_points_but_no_name() -> None:
    hidden = samples.check("build.colcon", "failed", visibility="hidden", actual="secret")
    entry = single(samples.report(hidden))
    written = json.dumps(prairielearn.results(entry))
    assert "build.colcon" not in written
    assert "secret" not in written
    assert sum(test["max_points"] for test in prairielearn.results(entry)["tests"]) == 100


def test_program_output_is_included(broken: Report) -> None:
    output = prairielearn.results(single(broken))["output"]
    assert "hello time: 9" in output
    assert "Finished <<< my_robot_controller" in output


def test_a_report_of_many_megabytes_is_cut_to_the_limit() -> None:
    long = "\U0001f600" * 400 + "\n"
    checks = [
        samples.check(f"check.n{n}", "failed", actual=long * 40, fix=long * 40, expected=long * 40)
        for n in range(12)
    ]
    report = samples.report(*checks, evidence={"transcript": long * 400, "build_log": long * 400})
    found = prairielearn.results(single(report))
    assert len(prairielearn.results_json(found).encode()) <= 1_000_000
    assert len(found["tests"]) == len(report.checks)
    jsonschema.validate(found, PRAIRIELEARN)


@settings(max_examples=60)
@given(texts)
def test_hostile_texts_are_harmless(text: str) -> None:
    entry = hostile_entry(text)
    found = json.loads(prairielearn.results_json(prairielearn.results(entry)))
    jsonschema.validate(found, PRAIRIELEARN)
    assert found["score"] == 0.56
    for test in found["tests"]:
        assert test["name"].isprintable()
        assert test["output"].replace("\n", "").isprintable()
