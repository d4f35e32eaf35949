"""Places in a Python source: the code of a node, and the source with that code replaced."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

MOST_SLUG = 60  # characters of code in a mutant's name


def misspelt(word: str) -> str:
    """Return a word without its last letter but one (a single letter doubled)."""
    return word[:-2] + word[-1] if len(word) > 1 else word * 2


@dataclass(frozen=True)
class Code:
    """A Python source as text; positions are those of `ast` (bytes of UTF-8 in a line)."""

    text: str

    @cached_property
    def tree(self) -> ast.Module:
        """The syntax tree."""
        return ast.parse(self.text)

    def walk(self) -> Iterator[ast.AST]:
        """Yield all nodes except those in f-strings that Python before 3.12 misplaces."""
        for node in ast.walk(self.tree):
            if id(node) not in self._inside_f_strings or self._is_where_it_says(node):
                yield node

    def shown(self, node: ast.AST) -> str:
        """Return a node's code as one short line, for a mutant's name."""
        return " ".join(self.of(node).split())[:MOST_SLUG]

    def of(self, node: ast.AST) -> str:
        """Return a node's code."""
        begin, end = self._span(node)
        return self._bytes[begin:end].decode()

    def put(self, node: ast.AST, new: str) -> str:
        """Return the source with a node replaced by `new`."""
        begin, end = self._span(node)
        return (self._bytes[:begin] + new.encode() + self._bytes[end:]).decode()

    def put_both(self, first: ast.AST, second: ast.AST) -> str:
        """Return the source with two nodes swapped; `first` comes before `second`."""
        (a, b), (c, d) = self._span(first), self._span(second)
        data = self._bytes
        return (data[:a] + data[c:d] + data[b:c] + data[a:b] + data[d:]).decode()

    def indent(self, node: ast.stmt) -> str:
        """Return the blanks before a statement."""
        return " " * node.col_offset

    def statements(self) -> Iterator[ast.stmt]:
        """Yield the expression and assignment statements, without docstrings."""
        for node in self.walk():
            if not isinstance(node, ast.Expr | ast.Assign | ast.AugAssign | ast.AnnAssign):
                continue
            if not (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)):
                yield node

    def blocks(self) -> Iterator[list[ast.stmt]]:
        """Yield the bodies of functions, without docstrings."""
        for node in self.walk():
            if isinstance(node, ast.FunctionDef):
                doc = ast.get_docstring(node) is not None
                yield node.body[1:] if doc else node.body

    @property
    def docstrings(self) -> set[int]:
        """The ids of the nodes that are docstrings."""
        return {
            id(node.value)
            for node in ast.walk(self.tree)
            if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
        }

    @cached_property
    def _inside_f_strings(self) -> set[int]:
        strings = [node for node in ast.walk(self.tree) if isinstance(node, ast.JoinedStr)]
        return {id(inner) for node in strings for inner in ast.walk(node) if inner is not node}

    def _is_where_it_says(self, node: ast.AST) -> bool:
        if not isinstance(node, ast.expr):
            return False
        try:
            found = ast.parse(self.of(node), mode="eval").body
        except (SyntaxError, ValueError):
            return False
        return ast.dump(found) == ast.dump(node)

    @cached_property
    def _bytes(self) -> bytes:
        return self.text.encode()

    @cached_property
    def _starts(self) -> list[int]:
        starts = [0]
        for line in self._bytes.split(b"\n"):
            starts.append(starts[-1] + len(line) + 1)
        return starts

    def _span(self, node: ast.AST) -> tuple[int, int]:
        if not isinstance(node, ast.expr | ast.stmt | ast.keyword | ast.arg | ast.alias):
            raise TypeError(f"{type(node).__name__} has no place")
        end_line, end = node.end_lineno or node.lineno, node.end_col_offset or 0
        return self._starts[node.lineno - 1] + node.col_offset, self._starts[end_line - 1] + end
