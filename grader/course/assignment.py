"""An assignment as data: what is asked for, which checks ask it, and what each is worth."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from pathlib import Path
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from grader.course.policy import Policy
from grader.report.model import Visibility


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Output(_Part):
    """The counting output: `text` holds `{n}` once; `period` in seconds of ROS time."""

    text: str
    start: int = 0
    step: int = 1
    period: float = Field(default=1.0, gt=0, allow_inf_nan=False)
    ticks: int = Field(default=10, ge=2)

    def line(self, k: int) -> str:
        """Return the text of the k-th line, counted from 0."""
        return self.text.replace("{n}", str(self.start + k * self.step))


class CheckUse(_Part):
    """A check that the assignment uses, its points, and who sees it."""

    id: str
    points: float = Field(ge=0, allow_inf_nan=False)
    visibility: Visibility = "visible"


class Assignment(_Part):
    """One assignment; loaded by `load_assignment`."""

    schema_: Literal[1] = Field(alias="schema")
    id: str
    title: str
    package: str
    node_file: str
    node_name: str
    executable: str
    target: str
    output: Output
    modes: Literal["accept-unknown", "require"] = "accept-unknown"
    hidden_checks: int = Field(default=0, ge=0)
    limits: dict[str, float] = Field(default_factory=dict)
    checks: tuple[CheckUse, ...]
    policy: Policy = Field(default_factory=Policy)
    sha256: str = ""

    @property
    def function(self) -> str:
        """The function that the entry point leads to."""
        return self.target.partition(":")[2]

    @property
    def max_score(self) -> float:
        """The sum of the points of its checks."""
        return sum(use.points for use in self.checks)


def load_assignment(
    path: Path,
    *,
    hidden: Path | None = None,
    known_checks: Iterable[str] | None = None,
    known_limits: Iterable[str] | None = None,
) -> Assignment:
    """Load `assignment.yaml` (and the hidden checks of the instructor's side, if any).

    `hidden` is a YAML file with `checks: […]`, whose visibility is `hidden` where it says no
    other. `known_checks` are the ids that a check may have (default: the built-in ones),
    `known_limits` the keys that `limits:` may have (default: any).

    Raises AssignmentError; each line of its message reads `file:line: what is wrong`.
    """
    from grader.base.positioned_yaml import read_yaml  # noqa: PLC0415
    from grader.course.check_ids import known_ids  # noqa: PLC0415
    from grader.course.rules import check_content, merge_hidden  # noqa: PLC0415

    ids = tuple(known_ids() if known_checks is None else known_checks)
    limits = None if known_limits is None else tuple(known_limits)
    document = read_yaml(path)
    assignment = check_content(document, known_checks=ids, known_limits=limits)
    if hidden is not None:
        assignment = merge_hidden(assignment, document, read_yaml(hidden), known_checks=ids)
    return assignment.model_copy(update={"sha256": _digest(assignment)})


def _digest(assignment: Assignment) -> str:
    """Return the hash of what the assignment asks for, however its files are laid out.

    The policy is no part of it: a due date that moves changes no verdict.
    """
    content = assignment.model_dump(mode="json", by_alias=True, exclude={"sha256", "policy"})
    canonical = json.dumps(content, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(canonical.encode()).hexdigest()
