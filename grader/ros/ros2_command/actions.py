"""The actions on the ROS graph."""

from __future__ import annotations

from typing import Any

PART = "_action"  # a part of the names of an action's topics and services


def names_and_types(node: Any) -> list[tuple[str, list[str]]]:
    """Return the actions that have a client or a server, sorted by name."""
    from rclpy.action import get_action_names_and_types  # noqa: PLC0415 (slow to import)

    return sorted(get_action_names_and_types(node))


def servers(node: Any, action: str) -> list[tuple[str, list[str]]]:
    """Return the nodes that have a server of an action, and its types there."""
    from rclpy.action import get_action_server_names_and_types_by_node  # noqa: PLC0415

    return _nodes(node, action, get_action_server_names_and_types_by_node)


def clients(node: Any, action: str) -> list[tuple[str, list[str]]]:
    """Return the nodes that have a client of an action, and its types there."""
    from rclpy.action import get_action_client_names_and_types_by_node  # noqa: PLC0415

    return _nodes(node, action, get_action_client_names_and_types_by_node)


def _nodes(node: Any, action: str, of_node: Any) -> list[tuple[str, list[str]]]:
    found = []
    for name, namespace in node.get_node_names_and_namespaces():
        types = dict(of_node(node, name, namespace)).get(action)
        if types:
            found.append((f"{namespace.rstrip('/')}/{name}", types))
    return sorted(found)
