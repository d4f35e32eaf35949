"""Functions that return nothing, and the places that use what they return."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass

from grader.package.source.module import Function, Module
from grader.package.source.names import dotted, last_part, own_name
from grader.package.source.node import LOG_METHODS, NodeSource

WRITES = ("print", *LOG_METHODS)


@dataclass(frozen=True)
class NoReturn:
    """A function without a value, the call whose value is used, and what to write where.

    `sort` is "below" (`written` goes below `at`), "instead" (in place of `name`), "end" (the value is
    not known) or "some" (there is a value, but only under the condition of `at`).
    """

    module: Module
    function: str
    used: ast.Call
    at: ast.stmt | ast.expr
    sort: str
    name: str = ""
    written: str = ""
    printed: bool = False  # (the value is that of print or of the logger)


def no_return(source: NodeSource, within: list[Function]) -> NoReturn | None:
    """Return the only function whose value is None and is used in these functions or by itself."""
    found: dict[str, NoReturn] = {}
    for function in within:
        module = source.module_of(function)
        for call in (n for n in ast.walk(function) if isinstance(n, ast.Call)):
            if isinstance(module.parents.get(call), ast.Expr | ast.Await | ast.Lambda):
                continue
            for made in _called(source, call):
                one = _without_value(source, made, call)
                if one is not None:
                    found.setdefault(one.function, one)
    return next(iter(found.values())) if len(found) == 1 else None


def _called(source: NodeSource, call: ast.Call) -> Iterator[Function | ast.Assign]:
    """Yield the function that a call means: a method, one of the file, or a lambda with a name."""
    name = own_name(call.func)
    method = source.method(name) if name else None
    if method is not None:
        yield method
    yield from _of_helper(source, call)
    for module in source.known_modules:
        if isinstance(call.func, ast.Name) and call.func.id in module.functions:
            yield module.functions[call.func.id]
        for node in module.nodes:
            value = node.value if isinstance(node, ast.Assign) else None
            if isinstance(node, ast.Assign) and isinstance(value, ast.Lambda):
                names = list(map(dotted, node.targets))
                if len(names) == 1 and dotted(call.func) in names and names[0]:
                    yield node


def _of_helper(source: NodeSource, call: ast.Call) -> Iterator[Function]:
    """Yield the method of a helper class, if the object on which it is called is one of this class."""
    owner, _, method = dotted(call.func).rpartition(".")
    made = [
        n.value
        for n in source.own_nodes
        if isinstance(n, ast.Assign) and owner and owner in map(dotted, n.targets)
    ]
    value = made[0] if len(made) == 1 else None
    kind = last_part(dotted(value.func)) if isinstance(value, ast.Call) else ""
    for own in (c for module in source.known_modules for c in module.classes if c.name == kind):
        if own not in source.family:
            yield from (s for s in own.body if isinstance(s, Function) and s.name == method)


def _without_value(
    source: NodeSource, made: Function | ast.Assign, call: ast.Call
) -> NoReturn | None:
    module = source.module_of(made)
    if isinstance(made, ast.Assign):
        body = made.value.body if isinstance(made.value, ast.Lambda) else None
        written = _what_it_writes(body)
        if body is None or written is None:
            return None
        code = module.text.code
        name = dotted(made.targets[0])
        return NoReturn(
            module, name, call, made, "instead", code(body), code(written), printed=True
        )
    plain = all(dotted(mark) == "staticmethod" for mark in made.decorator_list)
    inner = list(_own_parts(made))
    if not plain or isinstance(made, ast.AsyncFunctionDef):
        return None
    if any(isinstance(n, ast.Yield | ast.YieldFrom | ast.Raise) for n in inner):
        return None
    returns = [n for n in inner if isinstance(n, ast.Return)]
    values = [r for r in returns if r.value is not None and not _is_none(r.value)]
    if not values:
        return _never(module, made, call)
    if len(values) == 1 and len(returns) == 1 and _what_it_writes(values[0].value) is not None:
        return _printed(module, made, call, values[0])
    last = made.body[-1]
    some = isinstance(last, ast.If) and not last.orelse and isinstance(last.body[-1], ast.Return)
    if some and len(values) == len(returns):
        return NoReturn(module, made.name, call, last, "some")
    return None


def _own_parts(function: Function) -> Iterator[ast.AST]:
    """Yield the parts of a function, without those of functions and classes in it."""
    waiting: list[ast.AST] = list(function.body)
    for node in waiting:
        yield node
        if not isinstance(node, Function | ast.ClassDef | ast.Lambda):
            waiting += ast.iter_child_nodes(node)


def _is_none(value: ast.expr) -> bool:
    return isinstance(value, ast.Constant) and value.value is None


def _what_it_writes(value: ast.expr | None) -> ast.expr | None:
    """Return the only argument of a call of print or of a logger."""
    if not isinstance(value, ast.Call) or len(value.args) != 1 or value.keywords:
        return None
    name = dotted(value.func)
    logs = name.rpartition(".")[2] in LOG_METHODS and "log" in name.rpartition(".")[0].lower()
    return value.args[0] if name == "print" or logs else None


def _printed(module: Module, made: Function, call: ast.Call, back: ast.Return) -> NoReturn | None:
    written = _what_it_writes(back.value)
    if written is None:
        return None
    code = module.text.code
    name, new = code(back), f"return {code(written)}"
    return NoReturn(module, made.name, call, back, "instead", name, new, printed=True)


def _never(module: Module, made: Function, call: ast.Call) -> NoReturn:
    """Say what a function without a value is to return: what its last statement makes."""
    code, last = module.text.code, made.body[-1]
    unknown = NoReturn(module, made.name, call, last, "end")
    above = made.body[-2] if len(made.body) > 1 else None
    if isinstance(last, ast.Return):
        name = _set_by(above)
        new = f"return {name}"
        return (
            NoReturn(module, made.name, call, last, "instead", code(last), new) if name else unknown
        )
    if name := _only_unread(made) or _set_by(last):
        return NoReturn(module, made.name, call, last, "below", "", f"return {name}")
    value = last.value if isinstance(last, ast.Expr) else None
    written = _what_it_writes(value)
    if isinstance(value, ast.Call) and written is not None:
        new = f"return {code(written)}"
        return NoReturn(module, made.name, call, last, "instead", code(last), new, printed=True)
    documents = isinstance(value, ast.Constant) and len(made.body) == 1
    texts = ast.JoinedStr | ast.BinOp | ast.Name | ast.Attribute | ast.Constant
    makes = isinstance(value, ast.Call) and dotted(value.func) in ("str", "int")
    makes = makes or (
        isinstance(value, ast.Call)
        and isinstance(value.func, ast.Attribute)
        and value.func.attr in ("format", "join")
    )
    if value is not None and not documents and (makes or isinstance(value, texts)):
        return NoReturn(
            module, made.name, call, last, "instead", code(last), f"return {code(last)}"
        )
    return unknown


def _only_unread(made: Function) -> str:
    """Return the only variable that a function sets and never reads; "" if there is none."""
    names = [n for n in _own_parts(made) if isinstance(n, ast.Name)]
    outer = {name for n in _own_parts(made) if isinstance(n, ast.Global) for name in n.names}
    read = {n.id for n in ast.walk(made) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load)}
    set_at_top = {
        name
        for s in made.body
        if isinstance(s, ast.Assign | ast.AnnAssign) and (name := _set_by(s))
    }
    unread = {n.id for n in names if isinstance(n.ctx, ast.Store)} - read - outer
    return unread.pop() if len(unread) == 1 and unread <= set_at_top else ""


def _set_by(statement: ast.stmt | None) -> str:
    """Return the only name that a statement sets, with its dots."""
    if isinstance(statement, ast.Assign) and len(statement.targets) == 1:
        return dotted(statement.targets[0])
    if isinstance(statement, ast.AugAssign | ast.AnnAssign):
        return dotted(statement.target)
    return ""
