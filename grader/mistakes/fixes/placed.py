"""Whether a change puts a statement where Python never runs it, or not in the method that is meant."""

from __future__ import annotations

import ast

from grader.package.source.module import Function
from grader.package.source.python import PythonFault, parse_python

ENDS = ast.Return | ast.Raise | ast.Continue | ast.Break


def is_misplaced(old: bytes, new: bytes) -> bool:
    """Return whether a new version of a file has more statements that are out of place than the old."""
    try:
        before, after = parse_python(old).tree, parse_python(new).tree
    except PythonFault:
        return False  # (the file could not be read before)
    return _never_run(after) > _never_run(before) or _self_of_class(after) > _self_of_class(before)


def _never_run(tree: ast.AST) -> int:
    """Return how many statements stand below one of the same block that does not go on."""
    count = 0
    for node in ast.walk(tree):
        for name in ("body", "orelse", "finalbody"):
            block = getattr(node, name, None)
            if isinstance(block, list):
                ends = [n for n, statement in enumerate(block) if isinstance(statement, ENDS)]
                count += len(block) - 1 - ends[0] if ends else 0
    return count


def _self_of_class(tree: ast.AST) -> int:
    """Return how often the block of a class uses self outside of its methods."""
    found = 0
    for owner in (n for n in ast.walk(tree) if isinstance(n, ast.ClassDef)):
        for statement in owner.body:
            if not isinstance(statement, Function | ast.ClassDef):
                names = [n for n in ast.walk(statement) if isinstance(n, ast.Name)]
                found += sum(n.id == "self" for n in names)
    return found
