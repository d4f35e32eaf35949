"""How the lines of a function reach the node: as self, or by a variable."""

from __future__ import annotations

from grader.package.source.module import Function, Module
from grader.package.source.node import NodeSource
from grader.package.source.place import function_at
from grader.package.source.scopes import has_self


def node_here(source: NodeSource, module: Module, line: int | None) -> str:
    """Return `self` in a method of the node's class, else the only variable that has the node.

    In a class that has a node instead of being one, it is the attribute.

    "" if there is no such variable, or more than one.
    """
    own = [statement for family in source.family for statement in family.body]
    function = function_at(module, line)
    around = [function, *module.around(function)] if function is not None else []
    for found in around:
        if isinstance(found, Function) and found in own and has_self(found):
            return source.held_node or "self"
    if source.held_node:
        return ""
    names = sorted(source.node_variables)
    return names[0] if len(names) == 1 else ""
