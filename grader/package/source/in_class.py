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
