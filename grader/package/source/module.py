"""A Python file of the package: its exact text and its syntax tree, parsed once."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property

from grader.package.edit.text import SourceText, Splice, read_source
from grader.package.source.kept import keep_small
from grader.package.source.python import can_parse, parse_python

Function = ast.FunctionDef | ast.AsyncFunctionDef


@dataclass(frozen=True, eq=False)
class Module:
    """A file that Python can read; `exact` is False if its text would not give the same bytes."""

    path: str
    text: SourceText
    tree: ast.Module
    exact: bool = True

    def line(self, number: int | None) -> str:
        """Return a line of the file without its indentation; "" if there is none."""
        return self.text.line(number or 0).strip()

    @cached_property
    def nodes(self) -> list[ast.AST]:
        """All parts of the file."""
        return list(ast.walk(self.tree))

    @cached_property
    def parents(self) -> dict[ast.AST, ast.AST]:
        """The parent of each part of the file."""
        return {child: node for node in self.nodes for child in ast.iter_child_nodes(node)}

    def has(self, node: ast.AST) -> bool:
        """Return whether a piece of syntax is of this file."""
        return node is self.tree or node in self.parents

    def around(self, node: ast.AST) -> Iterator[ast.AST]:
        """Yield what contains a part of the file, from the inside out."""
        found = self.parents.get(node)
        while found is not None:
            yield found
            found = self.parents.get(found)

    @cached_property
    def classes(self) -> list[ast.ClassDef]:
        """All classes of the file."""
        return [node for node in self.nodes if isinstance(node, ast.ClassDef)]

    @cached_property
    def functions(self) -> dict[str, Function]:
        """The functions at module level."""
        return {node.name: node for node in self.tree.body if isinstance(node, Function)}

    @cached_property
    def imports(self) -> set[str]:
        """The names that imports bind, and the modules that they name."""
        names: set[str] = set()
        for node in self.nodes:
            if isinstance(node, ast.Import | ast.ImportFrom):
                module = getattr(node, "module", None)
                names |= {module} if module else set()
                names |= {alias.asname or alias.name for alias in node.names}
        return names

    @property
    def uses_ros(self) -> bool:
        """Whether the file imports rclpy."""
        return any(name.partition(".")[0] == "rclpy" for name in self.imports)

    @cached_property
    def names(self) -> set[str]:
        """Every name that the file binds or defines."""
        stored = {
            node.id
            for node in self.nodes
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
        }
        made = {n.name for n in self.nodes if isinstance(n, Function | ast.ClassDef)}
        arguments = {node.arg for node in self.nodes if isinstance(node, ast.arg)}
        return stored | made | arguments | self.imports

    def edited(self, splices: Iterable[Splice]) -> bytes | None:
        """Return the file's bytes with the splices; None if Python cannot read the result."""
        new = self.text.spliced(splices) if self.exact else None
        return new if new is not None and can_parse(new) else None


def is_text(statement: ast.stmt) -> bool:
    """Return whether a statement is only a constant, such as a docstring."""
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)


@keep_small
def parse_module(path: str, found: bytes) -> Module:
    """Parse a file; PythonFault if Python cannot read it."""
    parsed = parse_python(found)
    text = read_source(found)
    return Module(path, text or SourceText(parsed.text, "utf-8"), parsed.tree, text is not None)
