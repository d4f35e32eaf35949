"""Where a function that an entry point names is only a method of a class."""

from __future__ import annotations

import ast

from grader.package.source.module import Function
from grader.package.source.python import PythonFault, parse_python


def line_in_class(found: bytes, given: str, function: str) -> int:
    """Return the line of the method `Class.function` that `given` names.

    0 if `given` has another form, if there is no such method, or if the file defines the function
    outside of its classes too.
    """
    owner, dot, name = given.partition(".")
    if not dot or name != function:
        return 0
    try:
        body = parse_python(found).tree.body
    except PythonFault:
        return 0
    if any(isinstance(node, Function) and node.name == function for node in body):
        return 0
    classes = [node for node in body if isinstance(node, ast.ClassDef) and node.name == owner]
    methods = [n for cls in classes for n in cls.body if isinstance(n, Function)]
    return next((n.lineno for n in methods if n.name == function), 0)


def uses_its_object(found: bytes, given: str) -> bool:
    """Whether the method `Class.function` uses the object on which it is called."""
    owner, _, name = given.partition(".")
    try:
        body = parse_python(found).tree.body
    except PythonFault:
        return False
    methods = [
        n
        for cls in body
        if isinstance(cls, ast.ClassDef) and cls.name == owner
        for n in cls.body
        if isinstance(n, Function) and n.name == name and n.args.args and not n.decorator_list
    ]
    return any(
        isinstance(part, ast.Name) and part.id == method.args.args[0].arg
        for method in methods
        for statement in method.body
        for part in ast.walk(statement)
    )


def calls_of_method(found: bytes, given: str) -> list[tuple[int, str]]:
    """Return the calls of the method `Class.function` outside of its class: line and what is called.

    As in `Class.function()` and `Class().function()`.
    """
    owner, _, name = given.partition(".")
    try:
        body = parse_python(found).tree.body
    except PythonFault:
        return []
    outside = [n for s in body if not isinstance(s, ast.ClassDef) for n in ast.walk(s)]
    named = [n.func for n in outside if isinstance(n, ast.Call)]
    return [
        (n.lineno, ast.unparse(n))
        for n in named
        if isinstance(n, ast.Attribute) and n.attr == name and _is_of(n.value, owner)
    ]


def _is_of(whole: ast.expr, owner: str) -> bool:
    named = whole.func if isinstance(whole, ast.Call) else whole
    return isinstance(named, ast.Name) and named.id == owner
