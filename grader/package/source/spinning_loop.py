"""A loop that calls spin_once in each round, and what else it does."""

from __future__ import annotations

import ast

from grader.package.source.endless import Loop
from grader.package.source.module import Function
from grader.package.source.node import NodeSource


def loop_around(source: NodeSource, call: ast.Call) -> Loop | None:
    """Return the innermost loop around a call, in the same function."""
    for part in source.module_of(call).around(call):
        if isinstance(part, Function | ast.Lambda):
            return None
        if isinstance(part, Loop):
            return part
    return None
