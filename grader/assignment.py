"""An assignment as data: what is asked for, which checks ask it, and what each is worth."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from typing import Literal

from pydantic import BaseModel
from pydantic import ConfigDict
from pydantic import Field

from grader.report.model import Visibility


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Output(_Part):
    """The counting output: `text` holds `{n}` once; `period` in seconds of ROS time."""

    text: str = "Hello time: {n}"
    start: int = 0
    step: int = 1
    period: float = Field(default=1.0, gt=0)
    ticks: int = Field(default=10, ge=2)

    def line(self, k: int) -> str:
        """Return the text of the k-th line, counted from 0."""
        return self.text.replace("{n}", str(self.start + k * self.step))


class CheckUse(_Part):
    """A check that the assignment uses, its points, and who sees it."""

    id: str
    points: float = Field(ge=0)
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
    sha256: str = ""

    @property
    def max_score(self) -> float:
        """The sum of the points of its checks."""
        return sum(use.points for use in self.checks)


def load_assignment(path: Path, *, hidden: Path | None = None) -> Assignment:
    """Load `assignment.yaml` (and the hidden checks of the instructor's side, if any)."""
    raise NotImplementedError(path, hidden, Any)
