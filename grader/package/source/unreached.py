"""Why a line of the entry function is not reached, as far as the source shows it for certain."""

from __future__ import annotations

import ast
from dataclasses import dataclass
from typing import Literal

from grader.package.source.counter import targets_of
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.truth import Truth, truth_of

PLAIN = ("staticmethod", "classmethod")
"""Decorators that call nothing by themselves."""
EXITS = ("exit", "quit", "sys.exit", "os._exit")
Obstacle = Literal["except", "condition", "else", "exits", "uncalled"]


@dataclass(frozen=True)
class Unreached:
    """A statement that is not reached, and the part of the source that prevents it."""

    statement: ast.stmt
    obstacle: Obstacle
    at: ast.stmt | ast.ExceptHandler
    truth: Truth | None = None


def unreached(source: NodeSource, calls: list[ast.Call]) -> Unreached | None:
    """Return why the first of these calls is not reached; None if one of them may be."""
    found = [_of_call(source, call) for call in calls]
    return found[0] if found and all(each is not None for each in found) else None


def _of_call(source: NodeSource, call: ast.Call) -> Unreached | None:
    module = source.module_of(call)
    statement = module.parents.get(call)
    function = source.function_around(call)
    if not isinstance(statement, ast.Expr) or function is None:
        return None
    within = _blocked_within(source, module, statement, function)
    if within is not None:
        return within
    if function is source.main:
        return _after_exit(module, statement, function)
    if _is_named(source, function):
        return None
    return Unreached(statement, "uncalled", function)


def _blocked_within(
    source: NodeSource, module: Module, statement: ast.stmt, function: Function
) -> Unreached | None:
    """Look at the blocks around a statement of a function, from the inside out."""
    inner: ast.AST = statement
    for around in module.around(statement):
        if around is function:
            return None
        if isinstance(around, ast.ExceptHandler):
            return Unreached(statement, "except", around) if _only_ctrl_c(around) else None
        if isinstance(around, ast.If | ast.While):
            truth = truth_of(source, around.test)
            first = inner in around.body
            if truth is not None and truth.value is not first:
                looped = isinstance(around, ast.While) and not first
                obstacle: Obstacle = "condition" if first else "else"
                return None if looped else Unreached(statement, obstacle, around, truth)
        inner = around
    return None


def _only_ctrl_c(handler: ast.ExceptHandler) -> bool:
    """Whether an except catches only what Ctrl+C and ROS's end raise."""
    caught = handler.type.elts if isinstance(handler.type, ast.Tuple) else [handler.type]
    names = {last_part(dotted(each)) if each is not None else "" for each in caught}
    return names <= {"KeyboardInterrupt", "ExternalShutdownException"}


def _after_exit(module: Module, statement: ast.stmt, function: Function) -> Unreached | None:
    """Look for a statement of the function that always ends the program before this one."""
    around = module.parents.get(statement)
    own = around.body if isinstance(around, ast.Try) and statement in around.body else []
    for other in (*function.body, *own):
        if other.lineno < statement.lineno and exits(other):
            return Unreached(statement, "exits", other)
    return None


def exits(statement: ast.stmt) -> str:
    """Return what a statement ends the program with; "" if it does not."""
    if isinstance(statement, ast.Raise) and statement.exc is not None:
        name = dotted(statement.exc).removesuffix("()")
        return f"raise {name}" if name == "SystemExit" else ""
    call = statement.value if isinstance(statement, ast.Expr) else None
    if not isinstance(call, ast.Call) or any(isinstance(n, ast.Call) for n in call.args):
        return ""  # (sys.exit(main()))
    return f"{dotted(call.func)}()" if dotted(call.func) in EXITS else ""


def _is_named(source: NodeSource, function: Function) -> bool:
    """Whether something else than its def names a function: it may be called."""
    for node in source.all_nodes:
        named = isinstance(node, ast.Name) and node.id == function.name
        if named or (
            isinstance(node, ast.Attribute)
            and node.attr == function.name
            and dotted(node) != f"rclpy.{node.attr}"
        ):
            return True
        if isinstance(node, ast.Constant) and node.value == function.name:
            return True  # (getattr)
        if any(last_part(name) == function.name for name in targets_of(node)):
            return True
    around = source.module_of(function).parents.get(function)
    inherits = isinstance(around, ast.ClassDef) and any(dotted(b) != "object" for b in around.bases)
    if function.name == "run" and inherits:
        return True  # (start() of a Thread calls it)
    decorated = any(dotted(d) not in PLAIN for d in function.decorator_list)
    special = function.name.startswith("__") or decorated
    return special or function.name in ("destroy_node",)
