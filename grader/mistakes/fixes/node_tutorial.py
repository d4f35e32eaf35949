"""The fix of a node of a ROS tutorial that publishes what the exercise wants to be logged."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.node_clock import count_of
from grader.mistakes.fixes.node_timer import value_of
from grader.mistakes.placeholders import as_sum
from grader.package.edit.files import Files
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


def logs_instead(case: Case) -> Files | None:
    """Log the required line instead of publishing, with the required name and period."""
    node = case.node
    call, base = (node.log_call, node.super_init) if node else (None, None)
    timers = node.timers if node else []
    if node is None or call is None or base is None or len(timers) != 1 or len(node.modules) > 1:
        return None
    module, wanted = node.module, case.assignment
    text, gone = module.text, parts_of_topic(node)
    period = value_of(node, timers[0].period) if timers[0].period is not None else None
    name = text.plain_string(base.args[0]) if len(base.args) == 1 else None
    counter, counts = count_of(node)
    used = {dotted(n) for n in _outside(node, gone, call) if isinstance(n, ast.Name)}
    made = {dotted(t).partition(".")[0] for s in gone for t in getattr(s, "targets", [])} - {"self"}
    whole = all(module.line(s.lineno) == text.code(s) for s in gone)
    if not whole or not counts or name is None or not isinstance(period, ast.Constant):
        return None
    if used & made:
        return None
    quote = text.code(base.args[0])[0]
    return case.changed(
        module,
        *(text.without(s.lineno) for s in gone),
        text.swap(base.args[0], f"{quote}{wanted.node_name}{quote}"),
        text.swap(period, wanted.seconds),
        text.swap(call.args[0], as_sum(wanted.output, counter)),
    )


def _outside(node: NodeSource, gone: list[ast.stmt], call: ast.Call) -> Iterator[ast.AST]:
    """Yield the parts of the source that stay."""
    left = {part for statement in gone for part in ast.walk(statement)} | set(ast.walk(call))
    yield from (part for part in node.all_nodes if part not in left)
