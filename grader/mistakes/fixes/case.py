"""The input of a fix: the files, the finding about them, and the assignment."""

from __future__ import annotations

import ast
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

from grader.course.assignment import Assignment
from grader.mistakes.fixes.placed import is_misplaced
from grader.package.edit.files import Files
from grader.package.edit.text import SourceText, Splice, read_source
from grader.package.source.module import Module
from grader.package.source.node import NodeSource, read_node
from grader.package.source.python import PythonFault, parse_python
from grader.report.model import CheckResult

Param = str | int | float


@dataclass(frozen=True)
class Finding:
    """A failed check: its mistake with parameters, the place in the package, and the node, if any."""

    check: str
    mistake: str
    params: dict[str, Param] = field(default_factory=dict)
    file: str = ""
    line: int | None = None
    actual: str = ""
    node: str = ""

    @property
    def known_by(self) -> tuple[object, ...]:
        """The identity of this finding: a fix after which it is unchanged did not help."""
        return self.check, self.mistake, self.actual


@dataclass(frozen=True)
class Case:
    """One finding in one package; its assignment is about the node of the finding."""

    files: Files
    finding: Finding
    assignment: Assignment

    def __post_init__(self) -> None:
        """Let the assignment be about the finding's node."""
        object.__setattr__(self, "assignment", self.assignment.about(self.finding.node))

    @property
    def package(self) -> str:
        """The name of the package and of its inner folder."""
        return self.assignment.package

    @property
    def node_path(self) -> str:
        """The required path of the node's file."""
        return f"{self.assignment.folder}/{self.assignment.node_file}"

    @property
    def judged_path(self) -> str:
        """The path of the node's file; the finding's place if the required file has no content."""
        found = self.files.data(self.node_path)
        other = self.files.file(self.finding.file)
        return self.finding.file if other and not (found or b"").strip() else self.node_path

    @property
    def entry(self) -> str:
        """The entry of console_scripts that the assignment requires."""
        return f"{self.assignment.executable} = {self.assignment.target}"

    def parsed(self, path: str) -> tuple[SourceText, ast.Module] | None:
        """Return a Python file as text and syntax tree; None if Python cannot parse it."""
        found = self.files.data(path)
        source = read_source(found)
        if found is None or source is None:
            return None
        try:
            return source, parse_python(found).tree
        except PythonFault:
            return None

    @cached_property
    def node(self) -> NodeSource | None:
        """The source of the node; None if it cannot be read, or if several classes share its code."""
        source = read_node(self.files.data, self.node_path, self.assignment.function)
        return source if source is not None and source.is_one_class else None

    @property
    def module(self) -> Module | None:
        """The file of the node that the finding is about; that of the class if it has no place."""
        return self.node.module_at(self.finding.file) if self.node is not None else None

    def changed(self, module: Module, *splices: Splice) -> Files | None:
        """Return the files after changes to a module.

        None if Python cannot parse the result, or does not run a new line of it.
        """
        new = module.edited(splices) if splices else None
        old = self.files.data(module.path)
        if new is not None and old is not None and is_misplaced(old, new):
            return None
        return self.with_data(module.path, new)

    def with_data(self, path: str, data: bytes | None) -> Files | None:
        """Return the files with one replaced; None if `data` is None or equal to the old bytes."""
        same = data is None or self.files.data(path) == data
        return None if same or data is None else self.files.with_data(path, data)


Fix = Callable[[Case], "Files | None"]
"""Returns the fixed files, or None if no fix is certain."""


def finding_of(result: CheckResult) -> Finding | None:
    """Return the finding of a failed check; None for a check that did not fail."""
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
        node=result.node,
    )
