"""A small change of a package after which its node counts, as it was found by trying."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from grader.package.edit.files import Files
from grader.report.model import Where

FAR = 2  # lines, from which a change is of another place


@dataclass(frozen=True)
class Step:
    """One change of a file, as a text can show it."""

    sort: str
    path: str
    line: int
    name: str
    written: str
    form: str = ""


@dataclass(frozen=True)
class FoundChange:
    """One or two changes after which the node counts: the new texts of files, by their path."""

    steps: tuple[Step, ...]
    texts: Mapping[str, str]
    cost: int
    whole: bool

    def of(self, files: Files) -> Files:
        """Return the files with this change."""
        for path, text in self.texts.items():
            files = files.with_data(path, text.encode())
        return files

    def distance(self, where: Where | None) -> int:
        """Return how many lines its first change is from a place, at most `FAR`."""
        step = self.steps[0]
        if where is None or where.file != step.path or not where.line:
            return FAR
        return min(abs(step.line - where.line), FAR)

    @property
    def explains_itself(self) -> bool:
        """Whether it can be shown with the reason of another diagnosis of its line."""
        return len(self.steps) == 1 and self.steps[0].sort != "emptied"
