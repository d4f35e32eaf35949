"""A source with a symptom that is known, and what the assignment asks of it."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.course.assignment import Assignment, Output
from grader.mistakes.kind import Finding
from grader.mistakes.wanted import words_of
from grader.package.source.module import Function
from grader.package.source.node import NodeSource
from grader.report.model import Where


@dataclass(frozen=True)
class Suspect:
    """The source to look at, and what the assignment asks for."""

    source: NodeSource
    assignment: Assignment

    @property
    def output(self) -> Output:
        """The output that the assignment asks for."""
        return self.assignment.output

    @property
    def function(self) -> Function | None:
        """The function that the entry point leads to, if the source has it."""
        return self.source.main

    @property
    def place_of_function(self) -> Where:
        """The place at which it begins; the entry point's file if the source does not have it."""
        if self.function is None:
            return Where(file=self.source.entry.path)
        return place_of(self.source, self.function)

    def finding(
        self, slug: str, at: ast.stmt | ast.expr | Where | None = None, **params: str | int | float
    ) -> Finding:
        """Return a mistake of the stage `node` on the line of a piece of syntax, or at a place.

        Without either it is in the file that has the node's class.
        """
        words = {
            **words_of(self.assignment, self.source),
            "node": "node",
            "name": "",
            "close": "",
            **params,
        }
        where = at if isinstance(at, Where) else place_of(self.source, at)
        return Finding(kind=f"node.{slug}", params=params, words=words, where=where)


def place_of(source: NodeSource, node: ast.stmt | ast.expr | None) -> Where:
    """Return the file and the line of a piece of syntax; the class's file for None."""
    if node is None:
        return Where(file=source.module.path)
    return Where(file=source.module_of(node).path, line=node.lineno)
