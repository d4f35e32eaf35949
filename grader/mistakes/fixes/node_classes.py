"""Fixes of what the code does with a class instead of its object, or the other way around."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.rename import def_renamed
from grader.package.edit.files import Files
from grader.package.source.module import Function
from grader.package.source.names import dotted
from grader.package.source.node import NodeSource
from grader.package.source.parameters import needed_besides_self


def has_self(function: Function) -> bool:
    """Return whether the first parameter of a function is self."""
    return [given.arg for given in function.args.args[:1]] == ["self"]


def own_object(case: Case) -> Files | None:
    """Write self instead of the variable of another function, in all methods."""
    node, module = case.node, case.module
    name = str(case.finding.params.get("name", ""))
    if node is None or module is None or not name:
        return None
    inside = [
        n
        for method in node.own_methods
        for n in ast.walk(method)
        if has_self(method) and isinstance(n, ast.Name) and n.id == name and module.has(n)
    ]
    if any(not isinstance(n.ctx, ast.Load) or module.text.code(n) != name for n in inside):
        return None
    return case.changed(module, *(module.text.swap(n, "self") for n in inside))


def definitions(methods: list[ast.FunctionDef], name: str) -> list[ast.FunctionDef]:
    """Return the methods of a name that no decorator changes, in their order."""
    return [m for m in methods if m.name == name and not m.decorator_list]


def defined_twice(source: NodeSource) -> Iterator[list[ast.FunctionDef]]:
    """Yield the definitions of each method that is defined more than once."""
    for name in dict.fromkeys(method.name for method in source.own_methods):
        found = definitions(source.own_methods, name)
        if len(found) > 1:
            yield found


def second_renamed(case: Case) -> Files | None:
    """Give the second of two overloaded methods a name of its own, also where it is called."""
    node, module = case.node, case.module
    twice = list(defined_twice(node)) if node is not None else []
    if module is None or len(twice) != 1 or len(twice[0]) != 2:
        return None
    first, second = twice[0]
    given = [argument.arg for argument in needed_besides_self(second)]
    calls = [
        c
        for c in module.nodes
        if isinstance(c, ast.Call) and dotted(c.func) == f"self.{first.name}"
    ]
    with_values = [c for c in calls if c.args or c.keywords]
    if needed_besides_self(first) or not given or not with_values or not module.has(second):
        return None
    new, text = f"{second.name}_{given[0]}", module.text
    head = def_renamed(module, second, new)
    if head is None or new in text.text:
        return None
    return case.changed(module, head, *(text.swap(c.func, f"self.{new}") for c in with_values))


def own_callback(case: Case) -> Files | None:
    """Pass the method of the node to the timer instead of that of the class."""
    node = case.node
    name = case.finding.params.get("name", "")
    timers = [t for t in node.timers if dotted(t.callback or t.call) == name] if node else []
    if node is None or len(timers) != 1 or timers[0].function is None:
        return None
    callback, module = timers[0].callback, node.module_of(timers[0].call)
    if callback is None or not has_self(timers[0].function):
        return None
    return case.changed(module, module.text.swap(callback, f"self.{timers[0].method}"))


def plain_node(source: NodeSource) -> ast.Call | None:
    """Return where the entry function creates a node of no class, if nothing uses the class."""
    if source.main is None or source.node_class is None or source.makes_node():
        return None
    if not any(isinstance(s, Function) for s in source.class_body):
        return None
    calls = source.calls_of("Node", "create_node", within=source.main)
    return calls[0] if len(calls) == 1 else None


def made(case: Case) -> Files | None:
    """Create an object of the node's class instead of a plain node."""
    node = case.node
    call = plain_node(node) if node is not None else None
    init = node.method("__init__") if node is not None else None
    if node is None or call is None or init is None or node.node_class is None:
        return None
    if len(init.args.args) - len(init.args.defaults) > 1 or node.main not in node.module.tree.body:
        return None
    module = node.module_of(call)
    return case.changed(module, module.text.swap(call, f"{node.node_class.name}()"))


def without_lambda(case: Case) -> Files | None:
    """Pass the callback itself to the timer instead of a lambda that returns it."""
    node = case.node
    found = [t.callback for t in node.timers if isinstance(t.callback, ast.Lambda)] if node else []
    if node is None or len(found) != 1 or found[0] is None or found[0].args.args:
        return None
    module = node.module_of(found[0])
    return case.changed(module, module.text.swap(found[0], module.text.code(found[0].body)))
