"""JSON Schemas of the fields that other systems read, written from their documentation."""

from __future__ import annotations

from typing import Any

SHOWN = {"enum": ["hidden", "after_due_date", "after_published", "visible"]}
FORMAT = {"enum": ["text", "html", "simple_format", "md", "ansi"]}
TEXT, NUMBER, POINTS = {"type": "string"}, {"type": "number"}, {"type": "number", "minimum": 0}


def _object(properties: dict[str, Any], *required: str) -> dict[str, Any]:
    return {
        "type": "object",
        "additionalProperties": False,
        "properties": properties,
        "required": list(required),
    }


# autograder_samples/docs/specs.md
GRADESCOPE = _object(
    {
        "score": POINTS,
        "execution_time": POINTS,
        "output": TEXT,
        "output_format": FORMAT,
        "test_output_format": FORMAT,
        "test_name_format": FORMAT,
        "visibility": SHOWN,
        "stdout_visibility": SHOWN,
        "extra_data": {"type": "object"},
        "leaderboard": {"type": "array"},
        "tests": {
            "type": "array",
            "minItems": 1,
            "items": _object(
                {
                    "score": POINTS,
                    "max_score": POINTS,
                    "status": {"enum": ["passed", "failed"]},
                    "name": TEXT,
                    "name_format": FORMAT,
                    "number": TEXT,
                    "output": TEXT,
                    "output_format": FORMAT,
                    "tags": {"type": "array", "items": TEXT},
                    "visibility": SHOWN,
                    "extra_data": {"type": "object"},
                },
                "name",
                "score",
            ),
        },
    },
    "score",
)
# autograding-grading-reporter/src
GITHUB = _object(
    {
        "version": {"const": 1},
        "status": {"enum": ["pass", "fail", "error"]},
        "max_score": POINTS,
        "tests": {
            "type": "array",
            "minItems": 1,
            "items": _object(
                {
                    "name": TEXT,
                    "status": {"enum": ["pass", "fail", "error"]},
                    "message": TEXT,
                    "line_no": {"type": "integer"},
                    "test_code": TEXT,
                    "execution_time": {"type": "string", "pattern": r"^\d+ms$"},
                    "score": NUMBER,
                },
                "name",
                "status",
                "message",
                "line_no",
                "test_code",
                "execution_time",
                "score",
            ),
        },
    },
    "version",
    "status",
    "max_score",
    "tests",
)
# PrairieLearn, docs/externalGrading.md
PRAIRIELEARN = _object(
    {
        "gradable": {"type": "boolean"},
        "score": {"type": "number", "minimum": 0, "maximum": 1},
        "message": TEXT,
        "output": TEXT,
        "images": {"type": "array"},
        "format_errors": {"type": "array", "items": TEXT, "minItems": 1},
        "tests": {
            "type": "array",
            "items": _object(
                {
                    "name": TEXT,
                    "description": TEXT,
                    "points": POINTS,
                    "max_points": POINTS,
                    "message": TEXT,
                    "output": TEXT,
                    "images": {"type": "array"},
                },
                "name",
                "points",
                "max_points",
            ),
        },
    },
    "gradable",
)
