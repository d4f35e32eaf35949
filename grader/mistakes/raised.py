"""An exception that ended a node, and the source that it came from."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from dataclasses import dataclass

from grader.base.i18n.message import Value
from grader.course.assignment import Assignment
from grader.mistakes.kind import Finding
from grader.mistakes.suspect import place_of
from grader.mistakes.wanted import words_of
from grader.package.source.module import Module
from grader.package.source.node import NodeSource
from grader.report.model import Where


@dataclass(frozen=True)
class Raised:
    """An exception: its last line, where in the student's code it came from, and that source."""

    error: str
    where: Where | None
    source: NodeSource
    assignment: Assignment

    @property
    def module(self) -> Module:
        """The student's file in which it was raised; that of the class if this is unknown."""
        return self.source.module_at(self.where.file if self.where else "")

    @property
    def line(self) -> int | None:
        """The line of the student's file."""
        return self.where.line if self.where else None

    def finding(
        self,
        slug: str,
        *,
        at: ast.stmt | ast.expr | None = None,
        params: Mapping[str, str] | None = None,
        **more: str,
    ) -> Finding:
        """Return a mistake of the stage `node`: at a piece of syntax, or where it was raised."""
        given = {**(params or {}), **more}
        words = {
            **self.words,
            "close": "",
            "name": "",
            **given,
        }
        where = self.where or Where(file=self.source.entry.path)
        if at is not None:
            where = place_of(self.source, at)
        variant = "close" if words["close"] else ""
        return Finding(kind=f"node.{slug}", params=given, words=words, variant=variant, where=where)

    @property
    def words(self) -> dict[str, Value]:
        """What the assignment and the source fill into a text."""
        return words_of(self.assignment, self.source)
