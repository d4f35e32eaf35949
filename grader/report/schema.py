"""The JSON Schema of the report, made from the model: `python -m grader.report.schema` writes it.

It describes what is written: every field is there in every report, and there may be more fields
than it knows ("fields may be added, never changed"), so that an old schema accepts a new report.
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

# What the class descriptions leave open, by definition ("" is the report itself) and field.
DESCRIPTIONS = {
    "": {
        "schema": "The version of this form. Fields may be added to it, never changed.",
        "status": "`error`: the grader could not do its work; `message` says why.",
        "message": "What is to be said of the whole; empty if there is nothing.",
        "score": "The points given: the sum over the checks.",
        "max_score": "The points that could be had: the sum over the checks.",
        "lang": "The language of all texts. Ids, statuses and params do not depend on it.",
        "attempts": "How often the run was tried before this verdict.",
        "checks": "The checks in the order in which they were asked.",
        "started": "When the grading began (ISO 8601).",
    },
    "CheckResult": {
        "id": "Stable and independent of the language, e.g. `entry_point.mapping`.",
        "title": "What the check asks, in one line.",
        "status": "`skipped`: not asked, a check that it depends on did not pass. `inconclusive`: "
        "our side or the machine's load kept us from knowing. `error`: the check itself failed.",
        "visibility": "Who may see it; not whether it counts, which it always does.",
        "rationale": "Why it matters.",
        "expected": "What was expected.",
        "actual": "What was found.",
        "fix": "The one change that fixes it.",
        "patch": "The same change as a diff, where there is one.",
        "advice": "What could be better and costs no points.",
        "mistakes": "The entries of the catalogue that were recognised.",
        "where": "The place to look at.",
        "depends": "The ids of the checks without which this one is not asked.",
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
    """The schema of what is dumped, where fields with a default are present as well."""

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
