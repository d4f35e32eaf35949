"""The ROS packages that a file of Python imports from."""

from __future__ import annotations

import ast
from collections.abc import Iterator

INTERFACES = ("msg", "srv", "action")
"""The modules by which a package of interfaces is known: geometry_msgs.msg."""

CLIENT = "rclpy"


def ros_packages(tree: ast.Module) -> dict[str, int]:
    """Return the ROS packages that a file imports from, each with the line of its first import.

    An import in an `except` is the second choice, which a machine may not need: it is left out.
    """
    fallbacks = {
        inner
        for node in ast.walk(tree)
        if isinstance(node, ast.ExceptHandler)
        for inner in ast.walk(node)
    }
    found: dict[str, int] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import | ast.ImportFrom) and node not in fallbacks:
            for parts in _modules(node):
                if parts[0] == CLIENT or (len(parts) > 1 and parts[1] in INTERFACES):
                    found[parts[0]] = min(node.lineno, found.get(parts[0], node.lineno))
    return found


def _modules(node: ast.Import | ast.ImportFrom) -> Iterator[list[str]]:
    """Yield the names of the modules that an import may bring, in parts."""
    if isinstance(node, ast.Import):
        yield from (alias.name.split(".") for alias in node.names)
    elif node.module and not node.level:
        yield from ([*node.module.split("."), alias.name] for alias in node.names)
