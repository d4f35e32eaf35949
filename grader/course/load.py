"""Loads an assignment from its YAML file."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict

from grader.base.positioned_yaml import read_yaml
from grader.course.assignment import OWN, Assignment
from grader.course.rules import KnownChecks, check_content, merge_hidden
from grader.course.shorthands import with_kinds

AFTERWARDS = ("policy", "feedback", "archive")  # what changes no verdict
BEFORE = ("id", "points", "visibility", "title")  # of a check, in schema 1


def load_assignment(
    path: Path,
    *,
    hidden: Path | None = None,
    known_checks: KnownChecks | None = None,
    known_limits: Iterable[str] | None = None,
    own_checks: str = "",
    drop_own: bool = False,
) -> Assignment:
    """Load `assignment.yaml`, and the instructor's file of hidden checks if there is one.

    `hidden` is a YAML file with `checks: […]`; their visibility is `hidden` unless they set
    another. `known_checks` are the allowed kinds of checks with their parameters, `known_limits`
    the allowed keys of `limits:` (default: any; the loader knows neither). `own_checks` is the text
    of the instructor's checks.py. With `drop_own` the checks in it are counted as hidden ones: on a
    student's machine there is no such file.

    Raises AssignmentError; each line of its message reads `file:line:column: what is wrong`.
    """
    limits = None if known_limits is None else tuple(known_limits)
    document = read_yaml(path)
    if drop_own and known_checks is not None:
        known_checks = {**known_checks, **dict.fromkeys(_own_kinds(document.content), ANY)}
    assignment = check_content(document, known_checks=known_checks, known_limits=limits)
    if drop_own:
        assignment = _without_own(assignment)
    if hidden is not None:
        assignment = merge_hidden(
            assignment, document, read_yaml(hidden), known_checks=known_checks
        )
    assignment = assignment.model_copy(update={"own_checks": own_checks})
    return with_kinds(assignment.model_copy(update={"sha256": _digest(assignment)}))


class _Anything(BaseModel):
    """The parameters of a check that is not known here."""

    model_config = ConfigDict(extra="allow")


@dataclass(frozen=True)
class _AnyCheck:
    parameters: type[BaseModel] | None = _Anything
    stimulus: tuple[str, ...] = ()


ANY = _AnyCheck()


def _own_kinds(content: Any) -> Iterator[str]:
    """Yield the kinds of an instructor's own checks in the content of a file."""
    uses = content.get("checks") if isinstance(content, dict) else None
    for use in uses if isinstance(uses, tuple) else ():
        kind = (use.get("check") or use.get("id")) if isinstance(use, dict) else None
        if isinstance(kind, str) and kind.startswith(OWN):
            yield kind


def _without_own(assignment: Assignment) -> Assignment:
    kept = tuple(use for use in assignment.checks if not use.kind.startswith(OWN))
    hidden = assignment.hidden_checks + len(assignment.checks) - len(kept)
    return assignment.model_copy(update={"checks": kept, "hidden_checks": hidden})


def _digest(assignment: Assignment) -> str:
    """Return a hash of the content, which does not depend on the layout of the files.

    The policy, the feedback and the archive's name are left out: they change no verdict.
    """
    content = assignment.model_dump(mode="json", by_alias=True, exclude={"sha256", *AFTERWARDS})
    if assignment.own_checks:
        content["own_checks"] = assignment.own_checks
    for use in content["checks"]:
        if not use["title"]:  # which assignments of before do not have
            del use["title"]
    for plan in content["runs"]:
        del plan["kept_back"]  # (it follows from the checks)
    if assignment.schema_ == 1:  # what a later schema added does not change it
        del content["nodes"], content["runs"]
        content["checks"] = [{n: use[n] for n in BEFORE if n in use} for use in content["checks"]]
    canonical = json.dumps(content, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(canonical.encode()).hexdigest()
