"""Errors that lines raise for certain, as far as the source shows them."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterator

from grader.base.nearest import nearest
from grader.package.source.counter import declares, starts_of, targets_of
from grader.package.source.module import Function, Module
from grader.package.source.names import called_name, dotted, last_part, own_name
from grader.package.source.node import NodeSource

SIMPLE = ast.Expr | ast.Assign | ast.AugAssign | ast.AnnAssign | ast.Return
KNOWN = {*dir(builtins), "__file__", "__name__", "__doc__"}


def sure_error(source: NodeSource, body: list[ast.stmt]) -> tuple[str, int] | None:
    """Return the first error that these lines raise for certain, as Python writes it, and its line."""
    for statement in body:
        if not isinstance(statement, SIMPLE):
            return None
        for error, part in _errors(source, statement):
            return error, part.lineno
    return None


def _errors(source: NodeSource, statement: ast.stmt) -> Iterator[tuple[str, ast.expr]]:
    module, function = source.module_of(statement), source.function_around(statement)
    for node in ast.walk(statement):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            if node.id not in module.names | KNOWN and not _imports_all(module):
                yield f"NameError: name '{node.id}' is not defined", node
        elif isinstance(node, ast.Call) and source.is_own_log(node) and len(node.args) > 1:
            given, method = len(node.args) + 1, called_name(node)
            error = f"TypeError: RcutilsLogger.{method}() takes 2 positional arguments but"
            yield f"{error} {given} were given", node
        elif isinstance(node, ast.Call) and _makes_without_name(source, node):
            yield (
                "TypeError: Node.__init__() missing 1 required positional argument: 'node_name'",
                node,
            )
        elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
            if _is_text(node.left) and _is_number(source, node.right):
                yield 'TypeError: can only concatenate str (not "int") to str', node
            elif _is_number(source, node.left) and _is_text(node.right):
                yield "TypeError: unsupported operand type(s) for +: 'int' and 'str'", node
    target = statement.target if isinstance(statement, ast.AugAssign) else None
    if isinstance(statement, ast.AugAssign) and target is not None:
        text = isinstance(statement.value, ast.Constant) and isinstance(statement.value.value, str)
        if text and isinstance(statement.op, ast.Add) and _is_number(source, target, statement):
            yield "TypeError: unsupported operand type(s) for +=: 'int' and 'str'", target
        if (
            isinstance(target, ast.Name)
            and function is not None
            and _is_unbound(function, target.id)
        ):
            before = "UnboundLocalError: cannot access local variable"
            yield f"{before} '{target.id}' where it is not associated with a value", target
        own = own_name(target)
        if own and source.node_class is not None and is_never_set(source, own):
            yield (
                f"AttributeError: '{source.node_class.name}' object has no attribute '{own}'",
                target,
            )


def _makes_without_name(source: NodeSource, call: ast.Call) -> bool:
    """Whether a call makes the node, whose class has no constructor, without arguments."""
    own = source.node_class
    if own is None or dotted(call.func) != own.name or call.args or call.keywords:
        return False
    plain = [last_part(dotted(base)) for base in own.bases] == ["Node"] and not own.keywords
    return plain and not own.decorator_list and "__init__" not in source.methods


def is_never_set(source: NodeSource, attribute: str) -> bool:
    """Whether lines only add to an attribute of self, and its name is like that of one that is set."""
    parents = {m: m.parents for m in source.modules}
    stored = [
        n
        for n in source.own_nodes
        if isinstance(n, ast.Attribute) and isinstance(n.ctx, ast.Store) and own_name(n)
    ]
    kinds = [(n.attr, parents[source.module_of(n)].get(n)) for n in stored]
    added = {name for name, around in kinds if isinstance(around, ast.AugAssign)}
    others = {name for name, around in kinds if not isinstance(around, ast.AugAssign)}
    in_class = {name for statement in source.class_body for name in targets_of(statement)}
    known = others | in_class | {*source.methods}
    only = attribute in added and attribute not in known and source.is_one_class
    return only and bool(nearest(attribute, others))


def _imports_all(module: Module) -> bool:
    froms = [n for n in module.nodes if isinstance(n, ast.ImportFrom)]
    return any(alias.name == "*" for node in froms for alias in node.names)


def _is_unbound(function: Function, name: str) -> bool:
    """Whether a function only adds to a variable, and neither sets nor declares it."""
    stored = [
        n
        for n in ast.walk(function)
        if isinstance(n, ast.Name) and n.id == name and isinstance(n.ctx, ast.Store)
    ]
    added = [n.target for n in ast.walk(function) if isinstance(n, ast.AugAssign)]
    given = {a.arg for a in function.args.args}
    return not declares(function, name) and name not in given and all(n in added for n in stored)


def _is_text(part: ast.expr) -> bool:
    """Whether a part of a sum is text for certain."""
    if isinstance(part, ast.BinOp) and isinstance(part.op, ast.Mod | ast.Add):
        return _is_text(part.left)
    if isinstance(part, ast.Call):
        return dotted(part.func) == "str"
    is_string = isinstance(part, ast.Constant) and isinstance(part.value, str)
    return is_string or isinstance(part, ast.JoinedStr)


def _is_number(source: NodeSource, part: ast.expr, left_out: ast.stmt | None = None) -> bool:
    """Whether a part of a sum is a number for certain: only numbers are assigned to it."""
    if isinstance(part, ast.Constant):
        return type(part.value) in (int, float)
    if isinstance(part, ast.Call):
        return dotted(part.func) in ("int", "len")
    name = dotted(part)
    if name not in starts_of(source):
        return False
    return all(
        _only_numbers(statement.value, name)
        for statement in source.own_nodes
        if isinstance(statement, ast.Assign | ast.AnnAssign | ast.AugAssign)
        and statement is not left_out
        and name in targets_of(statement)
        and statement.value is not None
    )


def _only_numbers(value: ast.expr, name: str) -> bool:
    """Whether a value is a number, or a sum of the counter and a number."""
    parts = [value.left, value.right] if isinstance(value, ast.BinOp) else [value]
    return all(
        dotted(part) == name
        or (isinstance(part, ast.Constant) and type(part.value) in (int, float))
        for part in parts
    )
