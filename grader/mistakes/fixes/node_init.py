"""Fixes of an rclpy.init() in the wrong place, and the call as the student's function needs it."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.lines import own_lines
from grader.package.edit.files import Files
from grader.package.edit.text import indent_of
from grader.package.source.counter import targets_of
from grader.package.source.names import calls_in, dotted
from grader.package.source.node import NodeSource

PLAIN = ("Node", "rclpy.node.Node", "rclpy.create_node", "create_node")
MOST_CODE = 60  # characters of the student's call that a text shows


def new_call(source: NodeSource) -> str:
    """Return the call for the entry function: with args only if the function has them."""
    given = source.main.args.args if source.main is not None else []
    return f"rclpy.init({'args=args' if 'args' in [a.arg for a in given] else ''})"


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


def made_on_import(source: NodeSource) -> tuple[ast.stmt, ast.Call | None] | None:
    """Return the statement outside of functions that creates the node, and the function's init.

    The init may be the call of a function that has it. None if rclpy.init() is called outside of
    functions too, or the entry function is elsewhere.
    """
    main = source.main
    if main is None or main not in source.entry.tree.body:
        return None
    outside = [
        s for s in source.entry.tree.body if isinstance(s, ast.Assign | ast.Expr | ast.AnnAssign)
    ]
    calls = [(s, call) for s in outside for call, _ in calls_in(s)]
    names = {*PLAIN, *_makers(source)}
    made = [s for s, call in calls if source.is_node_class(call.func) or dotted(call.func) in names]
    inits = source.calls_of("init")
    if len(made) != 1 or any(source.function_around(call) is None for call in inits):
        return None
    own = [call for call in inits if source.function_around(call) is main]
    having = {f.name for call in inits if (f := source.function_around(call)) not in (None, main)}
    own = own or [call for call, name in calls_in(main) if name in having]
    return made[0], own[0] if len(own) == 1 else None


def _makers(source: NodeSource) -> set[str]:
    """Return the functions of the entry's file, beside main, that make the node."""
    return {
        function.name
        for function in source.entry.tree.body
        if isinstance(function, ast.FunctionDef)
        and function is not source.main
        and not source.calls_of("init", within=function)
        and any(source.is_node_class(call.func) for call, _ in calls_in(function))
    }


def used_elsewhere(source: NodeSource, name: str) -> bool:
    """Return whether another function than the entry function reads a variable of its file."""
    uses = [n for n in source.entry.nodes if isinstance(n, ast.Name) and n.id == name]
    around = [source.function_around(n) for n in uses if isinstance(n.ctx, ast.Load)]
    return any(function is not source.main for function in around)


def into_main(case: Case) -> Files | None:
    """Move the line that creates the node into the entry function, below rclpy.init()."""
    node = case.node
    found = made_on_import(node) if node is not None else None
    if node is None or node.main is None or found is None or found[1] is None:
        return None
    module, (made, call), main = node.entry, found, node.main
    name = next(targets_of(made), "")
    init = next((s for s in main.body if isinstance(s, ast.Expr) and s.value is call), None)
    rows = own_lines(module, made)
    if not name or init is None or rows is None or used_elsewhere(node, name):
        return None
    if any(name in targets_of(n) for n in ast.walk(main)) or made.lineno != made.end_lineno:
        return None
    last = made.lineno
    while module.text.line(last + 1).strip() == "" and last + 1 < len(module.text.lines):
        last += 1
    row = f"{indent_of(module.text.line(init.lineno))}{module.text.code(made)}"
    gone = [module.text.without(n) for n in range(made.lineno, last + 1)]
    return case.changed(module, *gone, module.text.before((init.end_lineno or 0) + 1, row))
