"""The fix of a line that shows the time of a clock instead of a count."""

from __future__ import annotations

import ast

from grader.mistakes.placeholders import COUNTER
from grader.package.source.counter import adds_to, starts_of
from grader.package.source.node import NodeSource


def count_of(node: NodeSource) -> tuple[str, bool]:
    """Return the attribute that can count, and whether the callback adds to it already.

    That is one that __init__ sets to a number, else a new one.
    """
    names = [name for name in starts_of(node) if name.startswith("self.")]
    parts = list(ast.walk(node.callback)) if node.callback is not None else []
    added = [name for name in names if any(adds_to(part, name) for part in parts)]
    taken = {f"self.{name}" for name in (*node.attributes, *node.methods)} - set(names)
    new = next(n for n in (COUNTER, f"{COUNTER}_", "self.number_of_calls") if n not in taken)
    return (*added, *names, new)[0], bool(added)
