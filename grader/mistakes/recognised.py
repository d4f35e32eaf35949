"""A recognised mistake, and what recognises one."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from grader.base.i18n.message import Value
from grader.course.assignment import Assignment, Output
from grader.mistakes.placeholders import placeholder_values
from grader.package.source.module import Function, Module
from grader.package.source.node import NodeSource
from grader.package.source.place import place_of
from grader.report.model import Mistake, Where


@dataclass(frozen=True, kw_only=True)
class RecognisedMistake:
    """A recognised mistake: the id of its kind, the values of the placeholders, and the place.

    `params` go into the report and are the same in every language; `words` only fill the texts.
    """

    kind: str
    params: Mapping[str, str | int | float] = field(default_factory=dict)
    words: Mapping[str, Value] = field(default_factory=dict)
    variant: str = ""
    where: Where | None = None

    @property
    def mistake(self) -> Mistake:
        """The mistake in the form of the report."""
        return Mistake(id=self.kind, params=dict(self.params))


@dataclass(frozen=True)
class Raised:
    """An exception: its last line, where in the student's code it was raised, and that source.

    `inside` is the library whose code raised it, in what the student's line calls: "rclpy" or
    "Python". It is "" if the line itself raised it, and if this is unknown.
    """

    error: str
    where: Where | None
    source: NodeSource
    assignment: Assignment
    inside: str = ""

    @property
    def module(self) -> Module:
        """The student's file in which it was raised; that of the class if this is unknown."""
        return self.source.module_at(self.where.file if self.where else "")

    @property
    def line(self) -> int | None:
        """The line of the student's file."""
        return self.where.line if self.where else None

    @property
    def interfaces(self) -> set[str]:
        """The names of the messages, services and actions that this file imports."""
        return {
            alias.asname or alias.name
            for node in self.module.nodes
            if isinstance(node, ast.ImportFrom)
            and (node.module or "").endswith((".msg", ".srv", ".action"))
            for alias in node.names
        }

    def finding(
        self,
        slug: str,
        *,
        at: ast.stmt | ast.expr | None = None,
        params: Mapping[str, str] | None = None,
        **more: str,
    ) -> RecognisedMistake:
        """Return the mistake `node.slug`: at a piece of syntax, or where it was raised."""
        given = {**(params or {}), **more}
        words = {**self.words, "close": "", "name": "", **given}
        where = self.where or Where(file=self.source.entry.path)
        if at is not None:
            where = place_of(self.source, at)
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
    """A source with a known symptom, and its assignment.

    If a line of the output is wrong, `text` is that line and `place` is where it was logged.
    `lines` are the lines of the output that came, none if they are not known. `transcript` is
    what the program wrote to its terminal. `stuck` is whether the node stopped answering.
    """

    source: NodeSource
    assignment: Assignment
    text: str = ""
    place: Where | None = None
    lines: tuple[str, ...] = ()
    transcript: str = ""
    stuck: bool = False

    @property
    def output(self) -> Output:
        """The output that the assignment requires."""
        return self.assignment.output

    @property
    def period(self) -> float:
        """The s of ROS time between two lines or messages."""
        return self.assignment.period or self.output.period

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

    def place_at(self, handler: ast.ExceptHandler) -> Where:
        """Return the place of an except."""
        return Where(file=self.source.module_of(handler).path, line=handler.lineno)

    def finding(
        self, slug: str, at: ast.stmt | ast.expr | Where | None = None, **params: str | int | float
    ) -> RecognisedMistake:
        """Return the mistake `node.slug`, at a piece of syntax or at a place.

        Without either it is in the file that has the node's class.
        """
        words = {
            **placeholder_values(self.assignment, self.source),
            "name": "",
            "close": "",
            **params,
        }
        where = at if isinstance(at, Where) else place_of(self.source, at)
        return RecognisedMistake(kind=f"node.{slug}", params=params, words=words, where=where)


FromError = Callable[[Raised, re.Match[str]], "RecognisedMistake | None"]
"""Recognises a mistake by an exception; the match is that of its pattern with the error's line."""
FromSource = Callable[[Suspect], "RecognisedMistake | None"]
"""Recognises in the node's source the mistake behind a symptom."""


def always(slug: str) -> FromError:
    """Return a function that finds `node.slug` whatever the source is."""

    def found(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
        return raised.finding(slug, params=match.groupdict(""))

    return found


def on_line(look: FromError) -> FromError:
    """Return a function that recognises only errors which the student's line itself raises.

    What the error of a library is about is in the library's code, and not on the student's line.
    """

    def found(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
        return None if raised.inside else look(raised, match)

    return found


MISSING_ARGUMENT = (
    r"\.(?P<function>\w{1,120})\(\) missing \d{1,3} required positional arguments?: "
    r"'(?P<name>\w{1,120})'"
)
NAME_ERROR = r"NameError: (?:free variable|name) '(?P<name>\w{1,120})'"
OWN_ATTRIBUTE = (
    r"AttributeError: '(?P<type>\w{1,120})' object has no attribute '(?P<name>\w{1,120})'"
)


def of_self(raised: Raised, match: re.Match[str]) -> bool:
    """Whether a missing attribute is one of the student's class, accessed through self."""
    if match["type"] not in raised.source.known_classes:
        return False
    line = raised.module.line(raised.line)
    return not line or f"self.{match['name']}" in line
