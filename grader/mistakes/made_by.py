"""Texts about the lines of a file that make or change the value that a log call shows."""

from __future__ import annotations

import ast

from grader.base.i18n.message import Message, joined, say
from grader.base.shown import shown
from grader.package.source.counter import parts_of_callback
from grader.package.source.module import Module
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of, function_at, statement_at
from grader.package.source.traced import traced
from grader.report.model import Where

MOST_LINES = 6
TEXT_METHODS = (
    *("strip", "lstrip", "rstrip", "replace", "title", "upper", "lower", "capitalize"),
    *("swapcase", "ljust", "rjust", "center", "zfill", "removeprefix", "removesuffix"),
)


def lines_that_make(
    source: NodeSource, where: Where | None, *, only_texts: bool = False
) -> Message | None:
    """Return the lines, with their code, that make or change what is logged at a place.

    If no log call is there, that of the callback is looked at. None if there is none, if no such
    line is known, or if they are too many for a text. With `only_texts`, those without a piece of
    text, and without a method that changes one, are left out.
    """
    statements = statements_that_make(source, where)
    if only_texts:
        statements = [n for n in statements if any(map(_makes_text, ast.walk(n)))]
    places = list(dict.fromkeys((source.module_of(n), n.lineno) for n in statements))
    if not 0 < len(places) <= MOST_LINES:
        return None
    here = where.file if where is not None else source.module.path
    several = {module.path for module, _ in places} != {here}
    texts = []
    for module, line in places:
        code = shown(module.line(line))
        text = say("line {line}: {code}", line=line, code=code)
        if several:
            text = say("{path}, line {line}: {code}", path=module.path, line=line, code=code)
        idle = _uncalled(source, module, line)
        if idle:
            text = say("{text} (no line calls {function})", text=text, function=idle)
        before = _returned_before(module, line)
        if before:
            text = say("{text} (not reached: line {line} returns)", text=text, line=before)
        own = _replaced(source, module, line)
        if own:
            text = say("{text} (not called: {type} has its own {function})", text=text, **own)
        texts.append(text)
    return joined(*texts, by="; ")


def statements_that_make(source: NodeSource, where: Where | None) -> list[ast.stmt]:
    """Return the statements that make or change what is logged at a place, or by the callback."""
    calls = [call for part in parts_of_callback(source) for call in source.logs(part)]
    if where is not None and where.line:
        module = source.module_at(where.file)
        there = [call for call in source.logs(module.tree) if call.lineno == where.line]
        calls = there or calls
    return traced(source, calls[0]) if calls else []


def _uncalled(source: NodeSource, module: Module, line: int) -> str:
    """Return the function that a line is in, if nothing calls it and nothing gets it; else ""."""
    function = function_at(module, line)
    if function is None or function is source.main or function.decorator_list:
        return ""
    if function.name.startswith("__") or function in parts_of_callback(source):
        return ""
    names = (n for n in source.all_nodes if isinstance(n, ast.Name | ast.Attribute))
    uses = [n for n in names if last_part(dotted(n)) == function.name]
    idle = [n for n in uses if isinstance(source.module_of(n).parents.get(n), ast.Expr)]
    return function.name if len(idle) == len(uses) else ""


def _returned_before(module: Module, line: int) -> int:
    """Return the line of a return above a line of the same block; 0 if there is none."""
    statement = statement_at(module, line)
    block = block_of(module, statement) if isinstance(statement, ast.stmt) else []
    ends = [one.lineno for one in block if isinstance(one, ast.Return) and one.lineno < line]
    return ends[0] if ends else 0


def _replaced(source: NodeSource, module: Module, line: int) -> dict[str, str]:
    """Return the class whose own method replaces the one of a line, which it does not call."""
    function = function_at(module, line)
    own = source.methods.get(function.name) if function is not None else None
    if (
        function is None
        or own is None
        or function in source.own_methods
        or function.name == "__init__"
    ):
        return {}
    if not any(function in family.body for family in source.family):
        return {}
    calls = [name for _, name in calls_in(own)]
    if any(last_part(name) == function.name for name in calls) or source.node_class is None:
        return {}
    return {"type": source.node_class.name, "function": function.name}


def _makes_text(node: ast.AST) -> bool:
    """Whether a part is a text, or a call of a method that makes another text of one."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
        return node.func.attr in TEXT_METHODS
    return isinstance(node, ast.Constant) and isinstance(node.value, str)
