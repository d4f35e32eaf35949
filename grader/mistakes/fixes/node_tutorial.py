"""The fix of a node of a ROS tutorial that publishes what the exercise wants to be logged."""

from __future__ import annotations

import ast

from grader.package.source.imported import imports
from grader.package.source.names import called_name, dotted
from grader.package.source.node import NodeSource

MESSAGES = (".msg", ".srv", ".action")


def parts_of_topic(node: NodeSource) -> list[ast.stmt]:
    """Return the statements that only serve a topic: its end, the messages, and their import."""
    classes = {
        bound: found
        for module in node.modules
        for bound, _, found in imports(module)
        if isinstance(found, ast.ImportFrom) and (found.module or "").endswith(MESSAGES)
    }
    statements = [n for n in node.own_nodes if isinstance(n, ast.stmt)]
    messages = {
        dotted(target)
        for made in statements
        if isinstance(made, ast.Assign) and isinstance(made.value, ast.Call)
        for target in made.targets
        if dotted(made.value.func) in classes
    }
    found = [*classes.values(), *(s for s in statements if _of_topic(s, messages, set(classes)))]
    kept = {dotted(target) for s in found for target in getattr(s, "targets", [])} - {""}
    found += [s for s in statements if isinstance(s, ast.Expr) and dotted(s.value) in kept]
    return sorted(set(found), key=lambda s: s.lineno)


def _of_topic(statement: ast.stmt, messages: set[str], classes: set[str]) -> bool:
    value = getattr(statement, "value", None)
    called = called_name(value) if isinstance(value, ast.Call) else ""
    if isinstance(statement, ast.Assign):
        fields = [dotted(target).rpartition(".")[0] for target in statement.targets]
        ends = called in ("create_publisher", "create_subscription")
        return ends or called in classes or bool(messages.intersection(fields))
    alone = isinstance(statement, ast.Expr)
    return alone and called in ("publish", "create_publisher", "create_subscription")
