"""The JSON Schema of the report; `python -m grader.report.schema` writes it from the model.

It describes what is written: every field is present in every report, and unknown fields are
accepted ("fields may be added, never changed"), so that an old schema accepts a new report.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from pydantic.json_schema import GenerateJsonSchema
from pydantic_core import core_schema

from grader.report.model import Report

PATH = Path(__file__).with_name("report.schema.json")
ID = "urn:ros2-teaching-lab:report:1"

# What the class descriptions do not cover, by definition ("" is the report itself) and field.
DESCRIPTIONS = {
    "": {
        "schema": "The version of this form. Fields may be added to it, never changed.",
        "status": "`error`: the grader could not do its work; `message` says why.",
        "message": "A message about the whole report; empty if there is none.",
        "score": "The points given: the sum over the checks.",
        "max_score": "The points available: the sum over the checks.",
        "lang": "The language of all texts. Ids, statuses and params do not depend on it.",
        "attempts": "How often the submission was marked for this verdict: more than once only if the grader failed.",
        "checks": "The checks in the order in which they ran.",
        "started": "When the grading began (ISO 8601).",
    },
    "CheckResult": {
        "id": "Stable and independent of the language, e.g. `entry_point.mapping`.",
        "title": "What the check tests, in one line.",
        "status": "`skipped`: not run, a check that it depends on did not pass. `inconclusive`: "
        "the grader or the machine's load prevented a verdict. `error`: the check itself failed.",
        "visibility": "Who may see it; it always counts.",
        "rationale": "Why it matters.",
        "expected": "What was expected.",
        "actual": "What was found.",
        "fix": "The one change that fixes it.",
        "patch": "The same change as a diff, if there is one.",
        "advice": "What could be better and costs no points.",
        "mistakes": "The mistakes of the catalogue that were recognised.",
        "where": "The place to look at.",
        "depends": "The ids of the checks that must pass before this one runs.",
        "seconds": "How long it took.",
    },
    "SubmissionInfo": {
        "path": "The resolved path of what was graded.",
        "modes": "`unknown`: the archive or file system kept no exec bits.",
    },
    "Observed": {
        "command": "The exact command, for the student to try.",
        "clock": "`virtual`: time was driven through /clock. null: there was no run.",
    },
}


class _Written(GenerateJsonSchema):
    """The schema of a dumped report, in which fields with a default are present too."""

    def field_is_required(
        self,
        field: core_schema.ModelField | core_schema.DataclassField | core_schema.TypedDictField,
        total: bool,
    ) -> bool:
        del field, total
        return True


def report_schema() -> dict[str, Any]:
    """Return the JSON Schema (draft 2020-12) of `report.json`."""
    schema = Report.model_json_schema(
        by_alias=True, mode="serialization", schema_generator=_Written
    )
    definitions: dict[str, Any] = schema["$defs"]
    for definition in (schema, *definitions.values()):
        definition.pop("additionalProperties", None)
    for name, texts in DESCRIPTIONS.items():
        properties = (definitions[name] if name else schema)["properties"]
        for field, text in texts.items():
            properties[field]["description"] = text
    return {"$schema": GenerateJsonSchema.schema_dialect, "$id": ID, **schema}


def schema_text() -> str:
    """Return the content of `report.schema.json`."""
    return json.dumps(report_schema(), indent=2, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    PATH.write_text(schema_text(), encoding="utf-8")
