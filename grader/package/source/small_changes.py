"""All small changes of a node's files: one piece of code written differently, moved or removed.

Which of them help is not known here: a caller runs the node with each.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from grader.package.source import small_orders, small_truths, small_values
from grader.package.source.change import Change
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.small_values import Goal

UTF_8 = ("utf-8", "ascii")
ALL = (
    *(*small_values.SORTS, *small_truths.SORTS),
    *small_orders.SORTS,
)
OF_PIECES = ("value", "seconds", "argument")
"""The sorts of changes that can hide a mistake: the code that has it may only not be used any more."""
UNUSED = 2
"""What such a change costs more if it leaves a name that nothing reads."""


@dataclass(frozen=True)
class SmallChange:
    """A change of one file, with the file's new text; `cost` is how far it is from the old one."""

    module: Module
    change: Change
    text: str
    cost: int

    @property
    def path(self) -> str:
        """The file that it changes."""
        return self.module.path

    @property
    def line(self) -> int:
        """The first line of the file that it changes."""
        return self.change.at.lineno


def lines_at_end(module: Module) -> set[int]:
    """Return the lines of __del__: what goes wrong there is not seen, so that any change helps."""
    ends = [n for n in module.nodes if isinstance(n, Function) and n.name == "__del__"]
    return {line for n in ends for line in range(n.lineno, (n.end_lineno or n.lineno) + 1)}


def lines_as_script(module: Module) -> set[int]:
    """Return the lines of a file that run only when it is run as a script."""
    guards = [
        s for s in module.tree.body if isinstance(s, ast.If) and "__name__" in ast.dump(s.test)
    ]
    return {line for s in guards for line in range(s.lineno, (s.end_lineno or s.lineno) + 1)}


def _unchanged(module: Module) -> set[int]:
    return lines_as_script(module) | lines_at_end(module)


def _own_names(module: Module) -> set[str]:
    """Return the names that a file gives a meaning, and that it reads."""
    set_here = {n.arg for n in module.nodes if isinstance(n, ast.arg)}
    for node in module.nodes:
        if isinstance(node, ast.Name | ast.Attribute) and isinstance(node.ctx, ast.Store):
            set_here.add(last_part(dotted(node)))
        elif isinstance(node, Function | ast.ClassDef):
            set_here.add(node.name)
    return set_here & _read(module.nodes)


def _read(nodes: Iterable[ast.AST]) -> set[str]:
    names = (n for n in nodes if isinstance(n, ast.Name | ast.Attribute))
    return {last_part(dotted(n)) for n in names if isinstance(n.ctx, ast.Load)}


def _does_nothing(nodes: Sequence[ast.AST]) -> bool:
    """Return whether something is compared with itself, gets its own value, or 0 is added to it."""
    pairs: list[tuple[ast.expr, ast.expr]] = []
    for node in nodes:
        if isinstance(node, ast.Compare):
            pairs.append((node.left, node.comparators[0]))
        elif isinstance(node, ast.BoolOp):
            pairs.append((node.values[0], node.values[1]))
        elif isinstance(node, ast.Assign):
            pairs.append((node.targets[0], node.value))
    sums = (n for n in nodes if isinstance(n, ast.BinOp) and isinstance(n.op, ast.Add | ast.Sub))
    if any(isinstance(n.right, ast.Constant) and n.right.value == 0 for n in sums):
        return True
    return any(dotted(left) == dotted(right) != "" for left, right in pairs)


def small_changes(source: NodeSource, goal: Goal) -> list[SmallChange]:
    """Return the changes of all files of a node, the smallest first; each gives another text.

    Only files in UTF-8 are changed, and not what runs only when a file is run as a script.
    """
    found: list[SmallChange] = []
    for module in source.known_modules:
        if module.text.encoding not in UTF_8:
            continue
        seen, script, read = {module.text.text}, _unchanged(module), _own_names(module)
        for sort in ALL:
            for cost, change in sort(module, source, goal):
                new = module.edited(change.splices)
                text = new.decode() if new is not None else ""
                if text and text not in seen and change.at.lineno not in script:
                    seen.add(text)
                    nodes = [*ast.walk(ast.parse(text))] if change.sort in OF_PIECES else []
                    if _does_nothing(nodes) and not _does_nothing(module.nodes):
                        continue
                    more = UNUSED if nodes and read - _read(nodes) else 0
                    found.append(SmallChange(module, change, text, cost + more))
    return sorted(found, key=lambda one: one.cost)
