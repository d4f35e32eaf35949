"""Submissions as one line of JSON, whatever bytes are in their names and contents."""

from __future__ import annotations

import base64
import json
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

from grader.package.intake.model import Candidate, Package, SourceFile, Submission

TUPLES = ("notes", "hints", "node_files", "links_out", "copies")


def submission_json(submission: Submission) -> str:
    """Return a submission as JSON on one line of ASCII; names that are not UTF-8 survive."""
    return json.dumps(asdict(submission), default=_simple)


def submission_from_json(text: str) -> Submission:
    """Return the submission that `submission_json` wrote; raise ValueError for anything else."""
    found = json.loads(text)
    names = {field.name for field in fields(Submission)}
    if not isinstance(found, dict) or {*found, "packages"} != names:  # older ones have none
        raise ValueError("not a submission")
    values: dict[str, Any] = {**found, "path": Path(found["path"])}
    values.update({name: tuple(found[name]) for name in TUPLES})
    values["candidates"] = tuple(Candidate(**entry) for entry in found["candidates"])
    values["files"] = _files(found["files"])
    values["packages"] = tuple(
        Package(entry["name"], entry["root"], _files(entry["files"]))
        for entry in found.get("packages", ())
    )
    return Submission(**values)


def _files(entries: list[dict[str, Any]]) -> tuple[SourceFile, ...]:
    return tuple(
        SourceFile(**{**entry, "data": base64.b64decode(entry["data"])}) for entry in entries
    )


def _simple(value: object) -> str:
    if isinstance(value, bytes):
        return base64.b64encode(value).decode("ascii")
    if isinstance(value, Path):
        return str(value)
    raise TypeError(f"cannot be written as JSON: {type(value)}")
