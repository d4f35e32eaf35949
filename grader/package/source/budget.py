"""How much of a student's Python file is read: bytes, parts, and the size of its numbers.

Most of what is read from a file takes time that is linear in its parts, some takes their square. The
bounds count what the file has, not time, so that the same file has the same verdict on each machine.
"""

from __future__ import annotations

import ast

MOST_BYTES = 100_000
"""A larger hostile file takes seconds and hundreds of megabytes to parse."""
MOST_PARTS = 10_000
"""Names, numbers, calls and the like: about 2,000 lines of usual code."""
MOST_DEPTH = 200
"""Parts inside each other; Python itself allows 200 brackets and 100 blocks."""
LARGEST = 10**20
"""The largest number that is calculated with; int64 ends at 9.2e18."""


def first_beyond(tree: ast.Module) -> int:
    """Return the line of the first part of a file that is not read; 0 if all of it is.

    Replace numbers beyond `LARGEST` by it: they overflow in calculations, and Python refuses to
    write them as text.
    """
    count, depth, line, level = 0, 0, 1, list[ast.AST]([tree])
    while level:
        count, depth = count + len(level), depth + 1
        for node in level:
            line = getattr(node, "lineno", line)
            if isinstance(node, ast.Constant) and isinstance(node.value, int | float):
                node.value = _limited(node.value)
        if count > MOST_PARTS or depth > MOST_DEPTH:
            return line
        inner = (one for node in level for one in ast.iter_child_nodes(node))
        level = [one for one in inner if not isinstance(one, ast.expr_context | ast.operator)]
    return 0


def known(number: float) -> float | None:
    """Return a number that was calculated; None if it is too large or too small to go on with."""
    small = number == 0 or 1 / LARGEST <= abs(number) <= LARGEST
    return number if small else None


def _limited(number: float) -> float:
    return type(number)(LARGEST) if number > LARGEST else number
