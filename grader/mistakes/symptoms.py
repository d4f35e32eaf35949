"""What the recognisers look at: an exception that ended a node, or a source with a symptom."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from grader.base.i18n.message import Value
from grader.course.assignment import Assignment, Output
from grader.mistakes.kind import RecognisedMistake
from grader.mistakes.placeholders import placeholder_values
from grader.package.source.node import Function, NodeSource
from grader.report.model import Where


@dataclass(frozen=True)
class Raised:
    """An exception: its last line, where in the student's code it was raised, and that source.

    `file` is the node's own file: the place of the mistake if the traceback names none.
    """

    error: str
    file: str
    where: Where | None
    source: NodeSource
    assignment: Assignment

    @property
    def line(self) -> int | None:
        """The line of the student's file."""
        return self.where.line if self.where else None

    def finding(
        self,
        slug: str,
        *,
        line: int | None = None,
        params: Mapping[str, str] | None = None,
        **more: str,
    ) -> RecognisedMistake:
        """Return the mistake `node.slug`, on a line of the node's file."""
        given = {**(params or {}), **more}
        words = {**self.words, "close": "", "name": "", **given}
        where = self.where or Where(file=self.file, line=line)
        if line is not None:
            where = Where(file=self.file, line=line)
        variant = "close" if words["close"] else ""
        return RecognisedMistake(
            kind=f"node.{slug}", params=given, words=words, variant=variant, where=where
        )

    @property
    def words(self) -> dict[str, Value]:
        """The values that the assignment and the source give to placeholders."""
        return placeholder_values(self.assignment, self.source)


@dataclass(frozen=True)
class Suspect:
    """A source with a known symptom, its path in the package, and its assignment."""

    source: NodeSource
    file: str
    assignment: Assignment

    @property
    def output(self) -> Output:
        """The output that the assignment requires."""
        return self.assignment.output

    @property
    def function(self) -> Function | None:
        """The function that the entry point leads to, if the source has it."""
        return self.source.functions.get(self.assignment.function)

    @property
    def line_of_function(self) -> int | None:
        """The line on which it begins."""
        return self.function.lineno if self.function is not None else None

    def finding(
        self, slug: str, line: int | None = None, **params: str | int | float
    ) -> RecognisedMistake:
        """Return the mistake `node.slug`, on a line of the file."""
        words = {
            **placeholder_values(self.assignment, self.source),
            "node": "node",
            "name": "",
            "close": "",
            **params,
        }
        where = Where(file=self.file, line=line)
        return RecognisedMistake(kind=f"node.{slug}", params=params, words=words, where=where)
