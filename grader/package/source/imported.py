"""The names that a module imports, and what they stand for."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from grader.package.source.module import Module
from grader.package.source.names import dotted


def imports(module: Module) -> Iterator[tuple[str, str, ast.stmt]]:
    """Yield the name that each import binds, the full name behind it, and the statement."""
    for node in module.nodes:
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield alias.asname or alias.name, alias.name, node
        elif isinstance(node, ast.ImportFrom) and not node.level:
            for alias in node.names:
                yield alias.asname or alias.name, f"{node.module}.{alias.name}", node


def full_name(module: Module, named: ast.AST) -> str:
    """Return the imported name of what is named: threading.Timer; "" if it is not imported."""
    written = dotted(named)
    for bound, full, _ in imports(module):
        if written == bound or written.startswith((f"{bound}.", f"{bound}()")):
            return full + written.removeprefix(bound)
    return ""


NODE = "rclpy.node.Node"


def name_of_node(module: Module) -> str:
    """Return the name by which a file knows the class Node; "" if it does not import it."""
    found = [(bound, full) for bound, full, _ in imports(module)]
    names = [bound for bound, full in found if full == NODE]
    names += [f"{bound}.Node" for bound, full in found if full == "rclpy.node"]
    return names[0] if names else ""
