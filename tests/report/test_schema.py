"""`report.schema.json`, the contract with other programs."""

from __future__ import annotations

import copy
import json
import subprocess
import sys
from collections.abc import Callable
from typing import Any

import jsonschema
import pytest

from grader.report.files import report_json
from grader.report.schema import PATH, schema_text
from tests.report.samples import check, failing_report, report

SCHEMA = json.loads(PATH.read_text(encoding="utf-8"))
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
STATUSES = ["passed", "failed", "skipped", "inconclusive", "error"]

# The fields of the published format, as documented in README and docs
CONTRACT: dict[str, set[str]] = {
    "": {"schema", "assignment", "submission", "environment", "status", "message", "score",
         "max_score", "lang", "attempts", "checks", "observed", "evidence", "timing", "started"},
    "AssignmentInfo": {"id", "title", "sha256"},
    "SubmissionInfo": {"name", "student_id", "path", "sha256", "package", "origin", "modes"},
    "Environment": {"distro", "ros", "sandbox", "limits", "rclpy", "rmw", "python", "colcon",
                    "setuptools", "image", "grader"},
    "CheckResult": {"id", "title", "status", "score", "max_score", "visibility", "rationale",
                    "expected", "actual", "fix", "patch", "advice", "mistakes", "where", "depends",
                    "seconds"},
    "Mistake": {"id", "params"},
    "Where": {"file", "line"},
    "Observed": {"command", "clock", "ticks", "nodes", "exit"},
    "Tick": {"n", "text", "virtual", "wall"},
    "Exit": {"status", "signal", "seconds"},
    "Evidence": {"build_log", "transcript"},
    "Timing": {"setup", "intake", "build", "run", "total"},
}  # fmt: skip


def dumped() -> dict[str, Any]:
    content: dict[str, Any] = json.loads(report_json(failing_report()))
    return content


def test_it_is_a_draft_2020_12_schema_with_an_id() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    assert SCHEMA["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    assert SCHEMA["$id"]


def test_the_schema_matches_the_model() -> None:
    assert PATH.read_text(encoding="utf-8") == schema_text(), (
        "the model has changed: run python -m grader.report.schema"
    )


def test_the_command_writes_the_schema(tmp_path: Any) -> None:
    code = (
        "import pathlib, runpy, sys; import grader.report.schema as s\n"
        "real = pathlib.Path.with_name\n"
        "pathlib.Path.with_name = lambda self, name: pathlib.Path(sys.argv[1])\n"
        "runpy.run_module('grader.report.schema', run_name='__main__')"
    )
    written = tmp_path / "schema.json"
    subprocess.run([sys.executable, "-W", "ignore", "-c", code, written], check=True)
    assert json.loads(written.read_text()) == SCHEMA


@pytest.mark.parametrize("part", CONTRACT)
def test_every_documented_field_exists_and_is_required(part: str) -> None:
    definition = SCHEMA["$defs"][part] if part else SCHEMA
    assert CONTRACT[part] <= set(definition["required"])
    assert set(definition["required"]) == set(definition["properties"])


def test_every_part_is_described() -> None:
    for definition in (SCHEMA, *SCHEMA["$defs"].values()):
        assert definition["title"]
        assert definition["description"]


@pytest.mark.parametrize("status", STATUSES)
def test_reports_with_each_status_are_valid(status: str) -> None:
    VALIDATOR.validate(json.loads(report_json(report(check("run.output", status)))))


def test_a_report_of_a_grader_failure_is_valid() -> None:
    failed = report(status="error", message="no sandbox", checks=[], score=0, max_score=0)
    VALIDATOR.validate(json.loads(report_json(failed)))


def test_a_whole_failing_report_is_valid() -> None:
    VALIDATOR.validate(dumped())


def test_unknown_fields_are_accepted_everywhere() -> None:
    def extend(value: Any) -> Any:
        if isinstance(value, list):
            return [extend(item) for item in value]
        if isinstance(value, dict):
            return {key: extend(item) for key, item in value.items()} | {"from_2031": ["new"]}
        return value

    content = extend(dumped())
    # maps: their keys are data, not fields
    del content["environment"]["limits"]["from_2031"]
    for result in content["checks"]:
        for mistake in result["mistakes"]:
            del mistake["params"]["from_2031"]
    VALIDATOR.validate(content)


def lacks_schema(content: dict[str, Any]) -> None:
    del content["schema"]


def of_another_version(content: dict[str, Any]) -> None:
    content["schema"] = 2


def with_schema_as_text(content: dict[str, Any]) -> None:
    content["schema"] = "1"


def lacks_a_default(content: dict[str, Any]) -> None:
    del content["checks"][0]["advice"]


def with_an_unknown_status(content: dict[str, Any]) -> None:
    content["checks"][0]["status"] = "ok"


def with_score_as_text(content: dict[str, Any]) -> None:
    content["score"] = "85"


def with_a_line_of_text(content: dict[str, Any]) -> None:
    content["checks"][8]["where"]["line"] = "23"


def with_another_sandbox(content: dict[str, Any]) -> None:
    content["environment"]["sandbox"] = "chroot"


def with_mistakes_as_names(content: dict[str, Any]) -> None:
    content["checks"][8]["mistakes"] = ["entry_point.module_misspelt"]


@pytest.mark.parametrize(
    "spoil",
    [
        lacks_schema,
        of_another_version,
        with_schema_as_text,
        lacks_a_default,
        with_an_unknown_status,
        with_score_as_text,
        with_a_line_of_text,
        with_another_sandbox,
        with_mistakes_as_names,
    ],
)
def test_an_invalid_report_is_refused(spoil: Callable[[dict[str, Any]], None]) -> None:
    content = copy.deepcopy(dumped())
    VALIDATOR.validate(content)
    spoil(content)
    with pytest.raises(jsonschema.ValidationError):
        VALIDATOR.validate(content)
