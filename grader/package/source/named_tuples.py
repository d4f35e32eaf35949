"""The classes that namedtuple() and NamedTuple make."""

from __future__ import annotations

import ast

from grader.package.source.names import dotted, last_part


def is_named_tuple(found: ast.ClassDef) -> bool:
    """Whether a class is a NamedTuple, or stands for one that namedtuple() makes."""
    return len(found.bases) == 1 and last_part(dotted(found.bases[0])) == "NamedTuple"


def named_tuple(given: list[object]) -> ast.ClassDef | None:
    """Return a class for what namedtuple() makes of a name and its fields; None if these are not known."""
    name, fields = given if len(given) == 2 else (None, None)
    names = fields.replace(",", " ").split() if isinstance(fields, str) else fields
    if not isinstance(name, str) or not isinstance(names, list | tuple):
        return None
    body: list[ast.stmt] = []
    for field in names:
        if not isinstance(field, str):
            return None
        body.append(ast.AnnAssign(ast.Name(field), ast.Name("object"), None, 1))
    return ast.ClassDef(name, [ast.Name("NamedTuple")], [], body, [])
