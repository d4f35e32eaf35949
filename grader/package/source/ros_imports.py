"""The ROS packages that a file of Python imports from, and what it takes from them."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass

INTERFACES = ("msg", "srv", "action")
"""The modules by which a package of interfaces is known: geometry_msgs.msg."""

CLIENT = "rclpy"
TYPE_PARTS = 3  # of std_msgs/msg/Int32


@dataclass(frozen=True)
class RosImport:
    """An import from a ROS package: `type` is such as std_msgs/msg/Int32, "" if it names none."""

    package: str
    line: int
    type: str = ""


def ros_imports(tree: ast.Module) -> list[RosImport]:
    """Return what a file imports from ROS packages, in the order of the lines.

    An import in an `except` is the second choice, which a machine may not need: it is left out.
    """
    fallbacks = {
        inner
        for node in ast.walk(tree)
        if isinstance(node, ast.ExceptHandler)
        for inner in ast.walk(node)
    }
    found: list[RosImport] = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import | ast.ImportFrom) and node not in fallbacks:
            for parts in _modules(node):
                if parts[0] == CLIENT:
                    found.append(RosImport(CLIENT, node.lineno))
                elif len(parts) > 1 and parts[1] in INTERFACES:
                    name = "/".join(parts) if len(parts) == TYPE_PARTS and parts[2] != "*" else ""
                    found.append(RosImport(parts[0], node.lineno, name))
    return sorted(found, key=lambda one: one.line)


def _modules(node: ast.Import | ast.ImportFrom) -> Iterator[list[str]]:
    """Yield the names of the modules that an import may bring, in parts."""
    if isinstance(node, ast.Import):
        yield from (alias.name.split(".") for alias in node.names)
    elif node.module and not node.level:
        yield from ([*node.module.split("."), alias.name] for alias in node.names)
