"""Fixes of an executor: the node that it gets, and what spins it."""

from __future__ import annotations

import ast

from grader.package.source.names import dotted
from grader.package.source.node import NodeSource


def executors_of(source: NodeSource) -> set[str]:
    """Return the variables of executors."""
    made = [(n.value, n.targets) for n in source.all_nodes if isinstance(n, ast.Assign)]
    items = [item for n in source.all_nodes if isinstance(n, ast.With) for item in n.items]
    made += [(i.context_expr, [i.optional_vars]) for i in items if i.optional_vars is not None]
    return {
        dotted(target)
        for value, targets in made
        if isinstance(value, ast.Call) and dotted(value.func).endswith("Executor")
        for target in targets
    }


def is_passed(source: NodeSource, name: str) -> bool:
    """Return whether an executor is an argument of a call, which may add nodes to it."""
    given = (a for call, _ in source.calls for a in (*call.args, *(k.value for k in call.keywords)))
    return any(dotted(argument) == name for argument in given)
