"""The model of an assignment: what the package must do, and the checks with their points."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from grader.course.policy import Policy
from grader.report.model import Visibility


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Output(_Part):
    """The lines that the node must print: `text` has `{n}` once; `period` is in s of ROS time."""

    text: str
    start: int = 0
    step: int = 1
    period: float = Field(default=1.0, gt=0, allow_inf_nan=False)
    ticks: int = Field(default=10, ge=2)

    def line(self, k: int) -> str:
        """Return the text of the k-th line, counted from 0."""
        return self.text.replace("{n}", str(self.start + k * self.step))


class CheckUse(_Part):
    """A check of the assignment: its points, and who sees it."""

    id: str
    points: float = Field(ge=0, allow_inf_nan=False)
    visibility: Visibility = "visible"


class Assignment(_Part):
    """One assignment; `course/load.py` reads it from a file."""

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
    timer: Literal["ros", "any"] = "ros"
    confirm: Literal["always", "sample", "never"] = "sample"
    hidden_checks: int = Field(default=0, ge=0)
    limits: dict[str, float] = Field(default_factory=dict)
    checks: tuple[CheckUse, ...]
    policy: Policy = Field(default_factory=Policy)
    sha256: str = ""

    @property
    def function(self) -> str:
        """The function of the entry point's target."""
        return self.target.partition(":")[2]

    @property
    def folder(self) -> str:
        """The inner folder: the Python package that the target names."""
        return self.target.partition(":")[0].partition(".")[0]

    @property
    def max_score(self) -> float:
        """The sum of the checks' points."""
        return sum(use.points for use in self.checks)
