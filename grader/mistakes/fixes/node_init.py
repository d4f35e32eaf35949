"""Fixes of an rclpy.init() in the wrong place, and the call as the student's function needs it."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.lines import own_lines
from grader.package.edit.files import Files
from grader.package.edit.text import indent_of
from grader.package.source.guard import is_guard
from grader.package.source.names import dotted
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of

MOST_CODE = 60  # characters of the student's call that a text shows


def new_call(source: NodeSource) -> str:
    """Return the call for the entry function: with args only if the function has them."""
    given = source.main.args.args if source.main is not None else []
    return f"rclpy.init({'args=args' if 'args' in [a.arg for a in given] else ''})"


def guarded_init(source: NodeSource) -> ast.Call | None:
    """Return the only rclpy.init() of the files, if it is below the guard of the entry's file."""
    calls = [call for call, name in source.calls if name == "rclpy.init"]
    if len(calls) != 1 or not source.entry.has(calls[0]):
        return None
    around = list(source.entry.around(calls[0]))
    guards = [a for a in around if isinstance(a, ast.If) and is_guard(a)]
    return calls[0] if guards and source.function_around(calls[0]) is None else None


def moved_call(source: NodeSource, call: ast.Call) -> str:
    """Return the student's call as it can be in the entry function; else a call without them."""
    module, main = source.module_of(call), source.main
    code = module.text.code(call)
    given = {a.arg for a in main.args.args} if main is not None else set()
    function = source.function_around(call)
    used = {n.id for n in ast.walk(call) if isinstance(n, ast.Name)} - {"rclpy"}
    known = used <= {*given, *module.imports} or function is main
    fits = known and len(code) <= MOST_CODE and "\n" not in code
    return code if fits else new_call(source)


def out_of_guard(case: Case) -> Files | None:
    """Move rclpy.init() from below the guard to the first line of the entry function."""
    node = case.node
    call = guarded_init(node) if node is not None else None
    if node is None or call is None or node.main is None or not node.entry.has(node.main):
        return None
    module, statement = node.entry, node.entry.parents.get(call)
    if not isinstance(statement, ast.Expr) or dotted(call.func) != "rclpy.init":
        return None
    lines = own_lines(module, statement)
    body = [s for s in node.main.body if not _is_text(s)]
    if lines is None or not body or body[0].lineno == node.main.lineno:
        return None
    if len(block_of(module, statement)) == 1:
        return None
    row = f"{indent_of(module.text.line(body[0].lineno))}{moved_call(node, call)}"
    gone = [module.text.without(n) for n in lines]
    return case.changed(module, *gone, module.text.before(body[0].lineno, row))


def _is_text(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)
