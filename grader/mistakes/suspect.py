"""A source with a symptom that is known, and what the assignment asks of it."""

from __future__ import annotations

from dataclasses import dataclass

from grader.course.assignment import Assignment, Output
from grader.mistakes.kind import Finding
from grader.mistakes.wanted import words_of
from grader.package.source.node import Function, NodeSource
from grader.report.model import Where


@dataclass(frozen=True)
class Suspect:
    """The source to look at, its path in the package, and what the assignment asks for."""

    source: NodeSource
    file: str
    assignment: Assignment

    @property
    def output(self) -> Output:
        """The output that the assignment asks for."""
        return self.assignment.output

    @property
    def function(self) -> Function | None:
        """The function that the entry point leads to, if the source has it."""
        return self.source.functions.get(self.assignment.function)

    @property
    def line_of_function(self) -> int | None:
        """The line on which it begins."""
        return self.function.lineno if self.function is not None else None

    def finding(self, slug: str, line: int | None = None, **params: str | int | float) -> Finding:
        """Return a mistake of the stage `node` on a line of the file."""
        words = {
            **words_of(self.assignment, self.source),
            "node": "node",
            "name": "",
            "close": "",
            **params,
        }
        where = Where(file=self.file, line=line)
        return Finding(kind=f"node.{slug}", params=params, words=words, where=where)
