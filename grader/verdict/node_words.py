"""What the texts call the node in a program that has no class of its own for it."""

from __future__ import annotations

from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource

MAKES = ("create_node", "Node")


def words_for(source: NodeSource) -> tuple[tuple[str, str], ...]:
    """Return pieces of code in the templates, and what to write instead of each.

    The texts speak of a class that inherits from Node. Without one, the node is a variable, and the
    callbacks are functions; a class that has a node as an attribute has callbacks that are methods.
    """
    names = [source.held_node] if source.held_node else sorted(source.node_variables)
    if len(names) != 1 or (source.node_class is not None and not source.held_node):
        return ()
    node, maker = names[0], _maker(source)
    words = [
        ("self.get_logger()", f"{node}.get_logger()"),
        ("self.create_timer", f"{node}.create_timer"),
        ("self.get_clock()", f"{node}.get_clock()"),
        ("super().__init__('{node_name}')", f"{maker}('{{node_name}}')"),
        ("super().__init__('{wanted}')", f"{maker}('{{wanted}}')"),
        ("super().__init__()", f"{maker}()"),
        ("rclpy.spin(node)", f"rclpy.spin({node})"),
        (" node.create_timer", f" {node}.create_timer"),
    ]
    if not source.held_node:
        words += [(" in a method of the node.", "."), ("self.{callback}", "{callback}")]
        words += [("__init__", source.main.name)] if source.main is not None else []
    return tuple(words)


def _maker(source: NodeSource) -> str:
    """Return the code that is called to create the node."""
    for call, name in source.calls:
        if last_part(name) in MAKES:
            return dotted(call.func)
    return "rclpy.create_node"
