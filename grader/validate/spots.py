"""Places in a Python source: the code of a node, and the source with that code replaced."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from grader.package.edit.text import Positioned, SourceText, Splice

MOST_SLUG = 60  # characters of code in a mutant's name


def misspelt(word: str) -> str:
    """Return a word without its last letter but one (a single letter doubled)."""
    return word[:-2] + word[-1] if len(word) > 1 else word * 2


@dataclass(frozen=True)
class Code:
    """A Python source as text."""

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
        return self._source.code(_positioned(node))

    def put(self, node: ast.AST, new: str) -> str:
        """Return the source with a node replaced by `new`."""
        return self._spliced(self._source.swap(_positioned(node), new))

    def put_both(self, first: ast.AST, second: ast.AST) -> str:
        """Return the source with two nodes swapped; `first` comes before `second`."""
        source = self._source
        return self._spliced(
            source.swap(_positioned(first), self.of(second)),
            source.swap(_positioned(second), self.of(first)),
        )

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
    def _source(self) -> SourceText:
        return SourceText(self.text, "utf-8")

    def _spliced(self, *splices: Splice) -> str:
        new = self._source.spliced(splices)
        if new is None:
            raise ValueError("the places overlap")
        return new.decode()


def _positioned(node: ast.AST) -> Positioned:
    if not isinstance(node, Positioned):
        raise TypeError(f"{type(node).__name__} has no place")
    return node
