"""The variable of GitHub Classroom's reporter: its notice adds up to the final score."""

from __future__ import annotations

import base64
import json
from typing import Any

import jsonschema
import pytest
from hypothesis import given, settings

from grader.batch.model import ClassResult, Override
from grader.batch.points import single
from grader.batch.systems.github_classroom import write as github
from tests.gradebook.hostile_texts import hostile_entry, texts
from tests.gradebook.schemas import GITHUB
from tests.pages import classes
from tests.report import samples


def read(variable: str) -> dict[str, Any]:
    """Decode as the reporter does (src/main.js)."""
    found: dict[str, Any] = json.loads(base64.b64decode(variable, validate=True).decode("utf-8"))
    jsonschema.validate(found, GITHUB)
    return found


def notice(found: dict[str, Any]) -> tuple[float, float]:
    """Return the points sent to the classroom (src/notify-classroom.js) and shown in the table."""
    return sum(test["score"] for test in found["tests"]), found["max_score"]


def test_the_notice_has_the_final_points(mixed: ClassResult) -> None:
    for entry in mixed.entries:
        found = read(github.encoded(github.results(entry)))
        points, most = notice(found)
        assert most == 100
        assert points == (0 if entry.final is None else entry.final)
        if entry.final is None:
            assert found["status"] == "error"


def test_status_is_pass_only_if_every_test_is(mixed: ClassResult) -> None:
    found = github.results(single(samples.report()))
    assert found["status"] == "pass"
    assert {test["status"] for test in found["tests"]} == {"pass"}
    assert github.results(single(samples.failing_report()))["status"] == "fail"
    late = github.results(single(samples.report(), penalty=2.5))
    assert late["status"] == "fail"
    assert notice(late)[0] == 97.5


@pytest.mark.parametrize("total", [0, 50, 100])
def test_a_corrected_total_is_a_line_of_its_own(total: float) -> None:
    change = Override("1", "", total, "agreed", by="M. Curie")
    found = github.results(single(samples.failing_report(), overrides=(change,)))
    assert notice(found)[0] == total
    assert "M. Curie" in found["tests"][-1]["name"]
    assert "agreed" in found["tests"][-1]["name"]


def test_hidden_checks_are_one_line_without_names() -> None:
    hidden = samples.check("build.colcon", "failed", visibility="hidden", actual="secret")
    entry = single(samples.report(hidden))
    written = json.dumps(github.results(entry))
    assert "build.colcon" not in written
    assert "secret" not in written
    assert "Hidden checks (0/10)" in written
    assert notice(github.results(entry))[0] == 90
    assert "build.colcon" in json.dumps(github.results(entry, show_hidden=True))


def test_there_is_always_at_least_one_test() -> None:
    for entry in (classes.entry(1, None, status="missing"), single(samples.report(checks=[]))):
        assert len(read(github.encoded(github.results(entry)))["tests"]) >= 1


def test_the_steps_output_is_one_line_and_the_variable_has_its_name() -> None:
    line = github.github_output(github.results(single(samples.failing_report())))
    name, _, value = line.partition("=")
    assert name == "result"
    assert line.count("\n") == 1
    assert read(value.rstrip("\n"))["version"] == 1
    assert github.variable("hello-time") == "HELLO-TIME_RESULTS"


@settings(max_examples=60, deadline=None)
@given(texts)
def test_hostile_texts_change_no_points_and_print_no_workflow_command(text: str) -> None:
    entry = hostile_entry(text)
    found = read(github.encoded(github.results(entry)))
    assert notice(found)[0] == entry.final
    for test in found["tests"]:
        assert test["name"].isprintable()
        for line in f"{test['name']}\n{test['message']}".split("\n"):
            # GitHub's runner would execute such a line of the log
            assert not line.lstrip().startswith("::")
            assert "##[" not in line
