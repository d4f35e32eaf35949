"""The fix of a loop in the entry function that waits for a rate instead of spinning."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source.names import dotted
from grader.package.source.node import NodeSource


def spin_for_rate(case: Case) -> Files | None:
    """Spin the node in the place of the loop, and create a timer for the method that it calls."""
    node = case.node
    init = node.method("__init__") if node is not None else None
    loop = _loop(node, case.finding.line) if node is not None else None
    called = _called(node, loop) if node is not None and loop is not None else None
    if node is None or node.main is None or init is None or loop is None or called is None:
        return None
    variable, method = called
    module, last = node.module_of(loop), init.body[-1]
    rates = [n for n in ast.walk(node.main) if _makes_rate(n)]
    rows = [n.lineno for n in rates if isinstance(n, ast.Assign) and n.lineno == n.end_lineno]
    alone = last.lineno != init.lineno and not isinstance(last, ast.Return)
    if node.timers or len(rows) != len(rates) or not module.has(init) or not alone:
        return None
    text = module.text
    timer = f"self.create_timer({case.assignment.seconds}, self.{method})"
    return case.changed(
        module,
        text.before(
            (last.end_lineno or last.lineno) + 1, indent_of(text.line(last.lineno)) + timer
        ),
        text.swap(loop, f"rclpy.spin({variable})"),
        *(text.without(row) for row in rows),
    )


def _makes_rate(node: ast.AST) -> bool:
    return isinstance(node, ast.Assign) and dotted(node.value).endswith(".create_rate()")


def _loop(node: NodeSource, line: int | None) -> ast.While | None:
    """Return the loop of the entry function around a line, if nothing in it ends it."""
    found = [
        n
        for n in (ast.walk(node.main) if node.main is not None else ())
        if isinstance(n, ast.While) and n.lineno < (line or 0) <= (n.end_lineno or 0)
    ]
    return found[0] if len(found) == 1 and not found[0].orelse else None


def _called(node: NodeSource, loop: ast.While) -> tuple[str, str] | None:
    """Return the node's variable and the method, if the loop only calls that and sleeps."""
    calls = [s.value for s in loop.body if isinstance(s, ast.Expr)]
    names = [dotted(call.func) for call in calls if isinstance(call, ast.Call) and not call.args]
    others = [name for name in names if not name.endswith(".sleep")]
    variable, _, method = others[0].rpartition(".") if len(others) == 1 else ("", "", "")
    known = variable in node.node_variables and method in node.methods
    return (variable, method) if known and len(names) == len(loop.body) == 2 else None


def timer_for_loop(case: Case) -> Files | None:
    """Let a timer repeat what a method's loop does, and spin in the place of the method's call."""
    node = case.node
    init = node.method("__init__") if node is not None else None
    if node is None or init is None or node.main is None or node.timers or node.calls_of("spin"):
        return None
    method, loop = _looping(node, case.finding.line)
    calls = node.calls_of(method.name, within=node.main) if method is not None else []
    if method is None or loop is None or len(calls) != 1 or calls[0].args or calls[0].keywords:
        return None
    module, last, text = node.module, init.body[-1], node.module.text
    variable = dotted(calls[0].func).rpartition(".")[0]
    rates = [n for n in ast.walk(node.module.tree) if _makes_rate(n)]
    rows = [n.lineno for n in rates if isinstance(n, ast.Assign) and n.lineno == n.end_lineno]
    sleeps = [s for s in loop.body if _sleeps(s)]
    alone = last.lineno != init.lineno and not isinstance(last, ast.Return)
    one_file = len(node.modules) == 1 and variable in node.node_variables
    if len(rows) != 1 or len(sleeps) != 1 or not alone or not one_file or init.lineno in rows:
        return None
    gone = {rows[0], sleeps[0].lineno, loop.lineno}
    deeper = loop.body[0].col_offset - loop.col_offset
    inside = [row for row in range(loop.lineno + 1, (loop.end_lineno or 0) + 1) if row not in gone]
    left = [text.start_of(row) for row in inside if text.line(row).strip()]
    timer = f"self.create_timer({case.assignment.seconds}, self.{method.name})"
    return case.changed(
        module,
        text.before(
            (last.end_lineno or last.lineno) + 1, indent_of(text.line(last.lineno)) + timer
        ),
        *(text.without(row) for row in gone),
        *(Splice(start, start + deeper, "") for start in left),
        text.swap(calls[0], f"rclpy.spin({variable})"),
    )


def _looping(node: NodeSource, line: int | None) -> tuple[ast.FunctionDef | None, ast.While | None]:
    """Return the method whose last statement is the endless loop around a line, and that loop."""
    for method in node.own_methods:
        loop = method.body[-1]
        if not isinstance(loop, ast.While) or loop.orelse or loop.lineno == loop.body[0].lineno:
            continue
        around = loop.lineno < (line or 0) <= (loop.end_lineno or 0)
        rest = method.body[:-1]
        plain = all(_makes_rate(s) or isinstance(s, ast.Expr) for s in rest)
        parts = [n for s in loop.body for n in ast.walk(s)]
        ends = any(isinstance(n, ast.Break | ast.Continue | ast.Return) for n in parts)
        long = any(isinstance(n, ast.Constant) and n.lineno != n.end_lineno for n in parts)
        if around and plain and not ends and not long and ast.unparse(method.args) == "self":
            return method, loop
    return None, None


def _sleeps(statement: ast.stmt) -> bool:
    return (
        isinstance(statement, ast.Expr)
        and dotted(statement.value).endswith(".sleep()")
        and statement.lineno == statement.end_lineno
    )
