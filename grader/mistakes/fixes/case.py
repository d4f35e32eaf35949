"""What a fix is given: the files, what was found wrong with them, and what is asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from dataclasses import field

from grader.course.assignment import Assignment
from grader.package.edit.files import Files
from grader.report.model import CheckResult

Param = str | int | float


@dataclass(frozen=True)
class Finding:
    """A check that failed: its mistake with parameters, and the place in the package."""

    check: str
    mistake: str
    params: dict[str, Param] = field(default_factory=dict)
    file: str = ""
    line: int | None = None
    actual: str = ""

    @property
    def known_by(self) -> tuple[object, ...]:
        """What tells this finding from others: if a fix leaves it as it was, it did not help."""
        return self.check, self.mistake, self.actual


@dataclass(frozen=True)
class Case:
    """One finding in one package."""

    files: Files
    finding: Finding
    assignment: Assignment

    @property
    def package(self) -> str:
        """The package's name, which is also that of its inner folder."""
        return self.assignment.package

    @property
    def node_path(self) -> str:
        """Where the node's file has to be."""
        return f"{self.assignment.package}/{self.assignment.node_file}"

    @property
    def entry(self) -> str:
        """The entry of console_scripts that is asked for."""
        return f"{self.assignment.executable} = {self.assignment.target}"

    def with_data(self, path: str, data: bytes | None) -> Files | None:
        """Return the files with other bytes in one; None if there are none or they are the same."""
        same = data is None or self.files.data(path) == data
        return None if same or data is None else self.files.with_data(path, data)


Fix = Callable[[Case], "Files | None"]
"""Returns the files as they would be, or None where no fix is certain."""


def finding_of(result: CheckResult) -> Finding | None:
    """Return what a failed check found; None for one that did not fail."""
    if result.status != "failed":
        return None
    mistake = result.mistakes[0] if result.mistakes else None
    return Finding(
        check=result.id,
        mistake=mistake.id if mistake else "",
        params=dict(mistake.params) if mistake else {},
        file=result.where.file if result.where else "",
        line=result.where.line if result.where else None,
        actual=result.actual,
    )
