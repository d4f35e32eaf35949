"""A print() in a function that is no method of the node: how the node is called there, if it is."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.package.source.counter import targets_of
from grader.package.source.module import Function, is_text
from grader.package.source.names import called_name, calls_in, dotted, last_part
from grader.package.source.node import NodeSource

Callable = Function | ast.Lambda
MAKES = ("create_node", "Node")


@dataclass(frozen=True)
class Outside:
    """The function that prints, its name, and where the node's methods call it.

    `passed` is the place of the only parameter that it prints; -1 if it prints something else.
    """

    function: Callable
    name: str
    calls: list[ast.Call]
    passed: int


def outside(source: NodeSource, call: ast.Call) -> Outside | None:
    """Return where a function prints that has no self of the node; None if it has one."""
    function = _around(source, call)
    if function is None or _has_self(source, call):
        return None
    name = _name_of(source, function)
    owner = _class_of(source, function)
    calls = [
        each
        for each, written in source.calls
        if name
        and last_part(written) == name
        and _has_self(source, each)
        and _is_of(source, each, owner, name)
    ]
    return Outside(function, name, calls, _passed(source, function, call, owner))


def _around(source: NodeSource, call: ast.Call) -> Callable | None:
    around = source.module_of(call).around(call)
    return next((part for part in around if isinstance(part, Callable)), None)


def _has_self(source: NodeSource, call: ast.Call) -> bool:
    """Whether a call is in a method of the node, or in a function of one."""
    for part in source.module_of(call).around(call):
        if isinstance(part, Function) and part in source.own_methods:
            return bool(part.args.args) and part.args.args[0].arg == "self"
    return False


def _name_of(source: NodeSource, function: Callable) -> str:
    if isinstance(function, Function):
        return function.name
    statement = source.module_of(function).parents.get(function)
    named = list(targets_of(statement)) if statement is not None else []
    return last_part(named[0]) if len(named) == 1 else ""


def _class_of(source: NodeSource, function: Callable) -> ast.ClassDef | None:
    """Return the class of a method."""
    around = source.module_of(function).around(function)
    found = next(iter(around), None)
    if isinstance(found, ast.Assign):
        found = next(iter(source.module_of(function).around(found)), None)
    return found if isinstance(found, ast.ClassDef) else None


def _is_of(source: NodeSource, call: ast.Call, owner: ast.ClassDef | None, name: str) -> bool:
    """Whether a call is one of the function, and of no other with its name."""
    before = dotted(call.func).rpartition(".")[0]
    if owner is None:
        return not before and called_name(call) == name
    return before.removesuffix("()") == owner.name or before in _objects(source, owner)


def _objects(source: NodeSource, owner: ast.ClassDef) -> set[str]:
    """Return the variables and attributes that hold an object of a class."""
    return {
        name
        for n in source.all_nodes
        if isinstance(n, ast.Assign) and isinstance(n.value, ast.Call)
        if last_part(dotted(n.value.func)) == owner.name
        for name in targets_of(n)
    }


def _passed(
    source: NodeSource, function: Callable, call: ast.Call, owner: ast.ClassDef | None
) -> int:
    """Return which of the arguments of its call a function prints, and does nothing else."""
    given = call.args[0] if len(call.args) == 1 else None
    quiet = all(keyword.arg == "flush" for keyword in call.keywords)
    if isinstance(function, Function):
        body = [s for s in function.body if not is_text(s)]
        alone = len(body) == 1 and isinstance(body[0], ast.Expr) and body[0].value is call
        static = any(dotted(d) == "staticmethod" for d in function.decorator_list)
        decorated = len(function.decorator_list) - static
    else:
        alone, static, decorated = function.body is call, False, 0
    names = [each.arg for each in function.args.args]
    if not alone or not quiet or decorated or dotted(given or call) not in names:
        return -1
    at = names.index(dotted(given or call))
    bound = owner is not None and not static and not _by_class(source, owner, function)
    return at - 1 if bound else at


def _by_class(source: NodeSource, owner: ast.ClassDef, function: Callable) -> bool:
    """Whether a function without self is called by the name of its class: Serial.println(text)."""
    name = _name_of(source, function)
    return any(
        dotted(call.func) == f"{owner.name}.{name}" and len(call.args) == len(function.args.args)
        for call, _ in source.calls
    )


def node_at(source: NodeSource, call: ast.Call) -> str:
    """Return by which name a function that is no method of the node knows it; "" if by none."""
    for part in source.module_of(call).around(call):
        if isinstance(part, Function):
            known = _given(source, part) or _kept(source, part)
            if known:
                return known
        if isinstance(part, Function | ast.Module):
            made = _made_in(source, part)
            if len(made) == 1:
                return next(iter(made))
    return ""


def _made_in(source: NodeSource, part: ast.AST) -> set[str]:
    """Return the variables of a function, or of the file, that get the node."""
    return {
        name
        for n in ast.walk(part)
        if isinstance(n, ast.Assign) and isinstance(n.value, ast.Call)
        if source.is_node_class(n.value.func) or called_name(n.value) in MAKES
        if (source.function_around(n) or source.module_of(n).tree) is part
        for name in targets_of(n)
        if "." not in name
    }


def _given(source: NodeSource, function: Function) -> str:
    """Return the parameter of a function of the file that gets the node."""
    known = {"self", *source.node_variables}
    names = [each.arg for each in function.args.args]
    for timer in source.timers:
        partial = timer.callback.args if isinstance(timer.callback, ast.Call) else []
        if partial and dotted(partial[0]) == function.name:
            for name, value in zip(names, partial[1:]):
                if dotted(value) in known:
                    return name
    if _class_of(source, function) is not None:
        return ""
    for call, name in source.calls:
        if name == function.name:
            for parameter, value in zip(names, call.args):
                if dotted(value) in source.node_variables or (
                    dotted(value) == "self" and _has_self(source, call)
                ):
                    return parameter
    return ""


def _kept(source: NodeSource, function: Function) -> str:
    """Return the attribute of another class in which an object of it keeps the node."""
    owner = _class_of(source, function)
    init = next(
        (s for s in (owner.body if owner else []) if getattr(s, "name", "") == "__init__"), None
    )
    if owner is None or not isinstance(init, Function) or not function.args.args:
        return ""
    names = [each.arg for each in init.args.args][1:]
    for call, name in calls_in(source.module_of(owner).tree):
        if last_part(name) != owner.name:
            continue
        given = {
            parameter
            for parameter, value in zip(names, call.args)
            if dotted(value) in source.node_variables
            or (dotted(value) == "self" and _has_self(source, call))
        }
        for statement in init.body:
            if isinstance(statement, ast.Assign) and dotted(statement.value) in given:
                return next(targets_of(statement), "")
    return ""
