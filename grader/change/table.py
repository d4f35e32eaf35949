"""All operators, by their names: one table for every lesson; and all changes of a node's files."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from grader.change import names, order, statements, values
from grader.change.operator import Made, Operator, Site, Wanted, all_made
from grader.package.source.module import Function, Module
from grader.package.source.node import NodeSource

TABLE: tuple[Operator, ...] = (
    *(*names.OPERATORS, *values.OPERATORS),
    *(*statements.OPERATORS, *order.OPERATORS),
)
BY_SORT: Mapping[str, Operator] = MappingProxyType({one.sort: one for one in TABLE})
UTF_8 = ("utf-8", "ascii")


@dataclass(frozen=True)
class Candidate:
    """A change of one file, with the file's new text; `cost` is how far it is from the old one."""

    module: Module
    row: Operator
    made: Made
    text: str
    cost: int

    @property
    def path(self) -> str:
        """The file that it changes."""
        return self.module.path


def candidates(source: NodeSource, wanted: Wanted) -> list[Candidate]:
    """Return the changes of all files of a node, the smallest first; each gives another text.

    Only files in UTF-8 are changed, and not what runs only as a script or when an object is deleted:
    what goes wrong there is not seen, so that any change helps.
    """
    found = []
    for module in source.known_modules:
        if module.text.encoding not in UTF_8:
            continue
        kept = _unseen(module)
        for row, made, text in all_made(Site(module, wanted), TABLE):
            if made.at.lineno not in kept:
                found.append(Candidate(module, row, made, text, row.cost + made.more))
    return sorted(found, key=lambda one: one.cost)


def _unseen(module: Module) -> set[int]:
    """Return the lines of __del__, and those that run only when the file is run as a script."""
    parts: list[ast.stmt] = [
        n for n in module.nodes if isinstance(n, Function) and n.name == "__del__"
    ]
    guards = [s for s in module.tree.body if isinstance(s, ast.If)]
    parts += [s for s in guards if "__name__" in ast.dump(s.test)]
    return {row for s in parts for row in range(s.lineno, (s.end_lineno or s.lineno) + 1)}
