"""A node's counters: attributes of the node or of its class, and variables outside the callback."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator

from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, own_name
from grader.package.source.node import NodeSource


def starts_of(source: NodeSource, kind: type = int) -> dict[str, ast.Constant]:
    """Return the literals with which counters start, by name as the callback writes it.

    `self.n` is set in __init__, in a method that it calls or in the class, `MyNode.n` in the class, and `n` at module level
    or in a function around the callback.
    """
    found: dict[str, ast.Constant] = {}
    for method in reversed(_at_start(source)):
        for name, value in _numbers(method.body, kind):
            if name.startswith("self.") and name.count(".") == 1:
                found[name] = value
    used = set(_counted_names(source))
    for name, value in _numbers(source.class_body, kind):
        for written in (f"self.{name}", *(f"{known}.{name}" for known in source.class_names)):
            if written in used:
                found.setdefault(written, value)
    for name in used:
        outer = outer_start(source, name, kind)
        if outer is not None and not _is_local(source.callback, name):
            found[name] = outer
    return found


def _at_start(source: NodeSource) -> list[Function]:
    """Return __init__ and the methods that it calls, without the callback."""
    init = source.method("__init__")
    called = [source.method(own_name(call.func)) for call, _ in calls_in(init)] if init else []
    return [m for m in (init, *called) if m is not None and m is not source.callback]


def _numbers(body: Iterable[ast.stmt], kind: type = int) -> Iterator[tuple[str, ast.Constant]]:
    """Yield the names that statements set to a literal of this type."""
    for statement in body:
        targets = list(targets_of(statement))
        value = getattr(statement, "value", None)
        if isinstance(statement, ast.AugAssign) or not isinstance(value, ast.Constant):
            continue
        if type(value.value) is kind and len(targets) == 1:
            yield targets[0], value


def targets_of(statement: ast.AST) -> Iterator[str]:
    """Yield the names that a statement assigns to, with their dots."""
    if isinstance(statement, ast.Assign):
        yield from filter(None, map(dotted, statement.targets))
    elif isinstance(statement, ast.AugAssign | ast.AnnAssign):
        yield from filter(None, [dotted(statement.target)])


def _counted_names(source: NodeSource) -> Iterator[str]:
    """Yield the names that the callback assigns to or logs."""
    callback = source.callback
    if callback is None:
        return
    for node in ast.walk(callback):
        yield from targets_of(node)
    for call in [*source.logs(callback), *source.prints(callback)]:
        yield from names_given(call)


def names_given(call: ast.Call) -> Iterator[str]:
    """Yield the names in the arguments of a call, with their dots, without what they call."""
    for given in (*call.args, *(keyword.value for keyword in call.keywords)):
        parts = list(ast.walk(given))
        called = [n.func for n in parts if isinstance(n, ast.Call)]
        plain = (n for n in parts if not isinstance(n, ast.Call) and n not in called)
        yield from filter(None, map(dotted, plain))


def outer_start(source: NodeSource, name: str, kind: type = int) -> ast.Constant | None:
    """Return the literal that a variable outside the callback starts with, or None.

    Such a variable is assigned once, at module level or in a function around the callback.
    """
    if source.callback is None or "." in name:
        return None
    for scope in source.module_of(source.callback).around(source.callback):
        if isinstance(scope, Function | ast.Module):
            set_here = [s for s in scope.body if name in targets_of(s)]
            if set_here:
                return dict(_numbers(set_here, kind)).get(name) if len(set_here) == 1 else None
    return None


def outer_word(source: NodeSource, function: Function, name: str) -> str:
    """Return the word with which a function declares a variable of outside: global or nonlocal.

    "" if no outer function and not the module sets a variable of that name.
    """
    for scope in source.module_of(function).around(function):
        body = scope.body if isinstance(scope, Function | ast.Module) else []
        if any(name in targets_of(statement) for statement in body):
            return "global" if isinstance(scope, ast.Module) else "nonlocal"
    return ""


def _is_local(function: Function | None, name: str) -> bool:
    """Return whether a name is a variable or a parameter of the function itself."""
    if function is None or declares(function, name):
        return False
    bound = [given.arg for given in function.args.args]
    return name in bound or any(name in targets_of(node) for node in _scope(function))


def declares(function: Function, name: str) -> bool:
    """Return whether a function declares a name with `global` or `nonlocal`."""
    declared = [n for n in _scope(function) if isinstance(n, ast.Global | ast.Nonlocal)]
    return any(name in node.names for node in declared)


def _scope(function: Function) -> Iterator[ast.AST]:
    """Yield the parts of a function, without those of functions in it."""
    waiting: list[ast.AST] = list(function.body)
    for node in waiting:
        yield node
        if not isinstance(node, Function):
            waiting += ast.iter_child_nodes(node)


def local_start(function: Function, name: str) -> ast.Assign | ast.AnnAssign | None:
    """Return the line of a function that sets its own variable to a number, if it counts it up."""
    numbers = [
        s
        for s in function.body
        if isinstance(s, ast.Assign | ast.AnnAssign) and dict(_numbers([s]))
    ]
    found = [s for s in numbers if name in targets_of(s)]
    set_again = [n for n in ast.walk(function) if name in targets_of(n) and n not in found]
    counted = bool(set_again) or f"self.{name}" in _added(function)
    known = counted and not declares(function, name)
    return found[0] if len(found) == 1 and known and "." not in name else None


def _added(function: Function) -> set[str]:
    """Return the names that a function adds to."""
    added = [n for n in ast.walk(function) if isinstance(n, ast.AugAssign)]
    return {name for node in added for name in targets_of(node)}


def texts_of(function: Function, call: ast.Call) -> list[ast.Assign]:
    """Return the statements that build the text of a log call before it, in order."""
    given = set(names_given(call))
    found = [n for n in ast.walk(function) if isinstance(n, ast.Assign) and n.lineno < call.lineno]
    return [n for n in found if given & {t for t in targets_of(n) if "." not in t}]


def adds_to(statement: ast.AST, name: str) -> bool:
    """Return whether a statement changes a counter: `n += 1`, or `n = n + 1`."""
    if name not in targets_of(statement):
        return False
    if isinstance(statement, ast.AugAssign):
        return True
    return isinstance(statement, ast.Assign) and name in _read_in(statement.value)


def _read_in(value: ast.expr) -> list[str]:
    parts = [n for n in ast.walk(value) if isinstance(n, ast.Name | ast.Attribute)]
    return list(filter(None, map(dotted, parts)))


def logged_counter(source: NodeSource) -> tuple[ast.Call, str] | None:
    """Return the first log call of the callback, and the counter that it shows.

    If it is in none of the callback's own lines, look into the methods that the callback calls.
    """
    found = (_logged_in(source, part) for part in parts_of_callback(source))
    return next(filter(None, found), None)


def parts_of_callback(source: NodeSource) -> list[Function]:
    """Return the callback, and the node's methods that it calls."""
    parts = [source.callback] if source.callback is not None else []
    for part in parts:
        called = [source.method(own_name(call.func)) for call, _ in calls_in(part)]
        parts += [m for m in dict.fromkeys(called) if m is not None and m not in parts]
    return parts


def _texts_made(source: NodeSource, call: ast.Call) -> Iterator[ast.expr]:
    """Yield what the node's own methods return for the arguments of a call."""
    for part in (n for given in call.args for n in ast.walk(given)):
        method = source.method(own_name(part.func)) if isinstance(part, ast.Call) else None
        for node in ast.walk(method) if method is not None else ():
            if isinstance(node, ast.Return) and node.value is not None:
                yield node.value


def _logged_in(source: NodeSource, callback: Function) -> tuple[ast.Call, str] | None:
    calls = [*source.logs(callback), *source.prints(callback)]
    starts = starts_of(source)
    for call in calls:
        names = list(names_given(call))
        known = [n for n in names if n in starts]
        own = [n for n in names if n.startswith("self.") and n.count(".") == 1]
        called = {dotted(n.func) for n in ast.walk(call) if isinstance(n, ast.Call)}
        own = [n for n in own if n not in called]
        for name in (*known, *own):
            if "get_logger" not in name and name not in source.loggers:
                return call, name
        for name in names:
            if local_start(callback, name) is not None:
                return call, name
    for call in calls:
        built = [text.value for text in texts_of(callback, call)]
        for text in [*built, *_texts_made(source, call)]:
            shown = [name for name in _read_in(text) if name in starts]
            if shown:
                return call, shown[0]
    # (the text is built on a line before the call: the incremented name is the counter)
    for call in calls[:1]:
        for node in ast.walk(callback):
            name = dotted(node.target) if isinstance(node, ast.AugAssign) else ""
            if name.startswith("self.") or name in starts:
                return call, name
    return None
