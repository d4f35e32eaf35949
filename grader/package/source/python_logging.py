"""What a node's source logs with Python's own logging module instead of ROS's logger."""

from __future__ import annotations

import ast

from grader.package.source.counter import targets_of
from grader.package.source.imported import full_name
from grader.package.source.module import Module
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource

METHODS = ("debug", "info", "warn", "warning", "error", "fatal", "critical", "exception", "log")


def is_of_logging(module: Module, named: ast.AST) -> bool:
    """Return whether a name is of Python's logging module."""
    return full_name(module, named).startswith("logging.")


def python_loggers(source: NodeSource) -> set[str]:
    """Return the variables and attributes that hold a logger of Python's logging."""
    return {
        target
        for node in source.all_nodes
        if isinstance(node, ast.Assign | ast.AnnAssign)
        and isinstance(node.value, ast.Call)
        and last_part(dotted(node.value.func)) in ("getLogger", "Logger")
        and is_of_logging(source.module_of(node), node.value.func)
        for target in targets_of(node)
    }


def python_logs(source: NodeSource, part: ast.AST) -> list[ast.Call]:
    """Return the calls in a part of the source that log with Python's logging, in order."""
    known = python_loggers(source)
    found = [
        call
        for call in ast.walk(part)
        if isinstance(call, ast.Call)
        and _method(source, call) in METHODS
        and (_holder(call) in known or is_of_logging(source.module_of(call), call.func))
    ]
    return sorted(found, key=lambda call: (call.lineno, call.col_offset))


def _method(source: NodeSource, call: ast.Call) -> str:
    return last_part(full_name(source.module_of(call), call.func) or dotted(call.func))


def _holder(call: ast.Call) -> str:
    return dotted(call.func).rpartition(".")[0]
