"""Which names code can read at a place of the source."""

from __future__ import annotations

import ast

from grader.package.source.counter import starts_of
from grader.package.source.module import Function, Module
from grader.package.source.node import NodeSource


def is_readable(source: NodeSource, module: Module, function: Function | None, code: str) -> bool:
    """Whether a function, or the module outside of all functions, can read what an expression names.

    `self` is known in a method of the node, with the attributes that the node sets, and in one of a
    helper class, with those of the helper.
    """
    try:
        parsed = ast.parse(code, mode="eval").body
    except (SyntaxError, ValueError):
        return False
    names = {n.id for n in ast.walk(parsed) if isinstance(n, ast.Name)}
    own = [
        n.attr
        for n in ast.walk(parsed)
        if isinstance(n, ast.Attribute) and isinstance(n.value, ast.Name) and n.value.id == "self"
    ]
    inside = list(ast.walk(function)) if function is not None else []
    local = {n.id for n in inside if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}
    top = {
        n.id for s in module.tree.body for n in getattr(s, "targets", ()) if isinstance(n, ast.Name)
    }
    given = [a.arg for a in function.args.args] if function is not None else []
    known = {*source.attributes, *(name[5:] for name in starts_of(source)), *source.methods}
    owner = module.parents.get(function) if function is not None else None
    of_node = function in source.methods.values()
    if isinstance(owner, ast.ClassDef) and not of_node and owner not in source.family:
        known = _set_in(owner)  # (a helper)
        of_node = True
    own_method = of_node and given[:1] == ["self"]
    if "self" in names and not (own_method and own and set(own) <= known):
        return False
    return bool(names) and names - {"self", "next"} <= {*local, *given, *top}


def _set_in(owner: ast.ClassDef) -> set[str]:
    """Return the attributes of self that a class sets."""
    return {
        n.attr
        for n in ast.walk(owner)
        if isinstance(n, ast.Attribute)
        and isinstance(n.ctx, ast.Store)
        and isinstance(n.value, ast.Name)
        and n.value.id == "self"
    }
