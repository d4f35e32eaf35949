"""Loads an assignment from its YAML file."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from pathlib import Path

from grader.base.positioned_yaml import read_yaml
from grader.course.assignment import Assignment
from grader.course.rules import KnownChecks, check_content, merge_hidden

BEFORE = ("id", "points", "visibility")  # of a check, in schema 1


def load_assignment(
    path: Path,
    *,
    hidden: Path | None = None,
    known_checks: KnownChecks | None = None,
    known_limits: Iterable[str] | None = None,
) -> Assignment:
    """Load `assignment.yaml`, and the instructor's file of hidden checks if there is one.

    `hidden` is a YAML file with `checks: […]`; their visibility is `hidden` unless they set
    another. `known_checks` are the allowed kinds of checks with their parameters, `known_limits`
    the allowed keys of `limits:` (default: any; the loader knows neither).

    Raises AssignmentError; each line of its message reads `file:line: what is wrong`.
    """
    limits = None if known_limits is None else tuple(known_limits)
    document = read_yaml(path)
    assignment = check_content(document, known_checks=known_checks, known_limits=limits)
    if hidden is not None:
        assignment = merge_hidden(
            assignment, document, read_yaml(hidden), known_checks=known_checks
        )
    return assignment.model_copy(update={"sha256": _digest(assignment)})


def _digest(assignment: Assignment) -> str:
    """Return a hash of the content, which does not depend on the layout of the files.

    The policy is left out: a later due date changes no verdict.
    """
    content = assignment.model_dump(mode="json", by_alias=True, exclude={"sha256", "policy"})
    if assignment.schema_ == 1:  # what a later schema added does not change it
        del content["nodes"], content["runs"]
        content["checks"] = [{name: use[name] for name in BEFORE} for use in content["checks"]]
    canonical = json.dumps(content, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(canonical.encode()).hexdigest()
