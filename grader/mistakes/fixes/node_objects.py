"""Fixes of what stands at a place: the base class, an own name, a sign."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.node_life import IMPORT
from grader.mistakes.fixes.rename import def_renamed, splices_of
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.source.module import Module
from grader.package.source.names import dotted, own_name

NEW_CALLBACK = "on_timer"
"""The name for a callback whose own name is one of Node's methods."""

METHODS = (
    *("create_timer", "get_logger", "get_clock", "get_name", "create_publisher", "destroy_node"),
    *("create_subscription", "create_service", "create_client", "declare_parameter"),
    *("get_parameter", "destroy_timer", "create_rate", "get_namespace", "add_waitable"),
)
"""Methods of Node that a node needs itself, or that a beginner calls."""


def import_of_class(module: Module) -> Splice | None:
    """Return the splice that imports the class Node; None if it is not certain where.

    An import of the module `node` that nothing else uses is replaced.
    """
    statements = [s for s in module.tree.body if isinstance(s, ast.Import | ast.ImportFrom)]
    for statement in statements:
        names = [(a.asname or a.name) for a in statement.names]
        of_rclpy = isinstance(statement, ast.ImportFrom) and statement.module == "rclpy"
        if of_rclpy and names in (["node"], ["Node"]):
            return module.text.swap(statement, IMPORT)
    plain = [s for s in statements if isinstance(s, ast.Import) and s.names[0].name == "rclpy"]
    return module.text.before(plain[0].lineno + 1, IMPORT) if len(plain) == 1 else None


def base(case: Case) -> Files | None:
    """Derive the class from Node, and import it if the file does not."""
    module, name = case.module, str(case.finding.params.get("name", ""))
    bases = [b for c in module.classes for b in c.bases if dotted(b) == name] if module else []
    if module is None or len(bases) != 1:
        return None
    splices = [module.text.swap(bases[0], "Node")]
    used = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    imports = _imports_module(module) and name == "node"
    if "Node" in module.imports:
        return case.changed(module, *splices)
    if imports and any(isinstance(n.ctx, ast.Load) and n is not bases[0] for n in used):
        stored = {
            n.id for n in module.nodes if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)
        }
        if name not in stored:
            return None
    new = import_of_class(module)
    return case.changed(module, *splices, new) if new is not None else None


def _imports_module(module: Module) -> bool:
    found = [n for n in module.nodes if isinstance(n, ast.ImportFrom) and n.module == "rclpy"]
    return any(alias.name == "node" for statement in found for alias in statement.names)


def class_import(case: Case) -> Files | None:
    """Import the class Node instead of its module, or below the import of rclpy."""
    module = case.module
    if module is None or case.finding.params.get("name") != "Node" or not _imports_module(module):
        return None
    new = import_of_class(module)
    return case.changed(module, new) if new is not None else None


def other_attribute(case: Case) -> Files | None:
    """Give an attribute another name; calls keep the old one, which is Node's."""
    node, name = case.node, str(case.finding.params.get("name", ""))
    new = str(case.finding.params.get("written", ""))
    if node is None or not new or new in node.attributes or name in node.methods:
        return None
    parts = [n for n in node.own_nodes if isinstance(n, ast.Attribute) and own_name(n) == name]
    module = node.module
    own = [p for p in parts if getattr(module.parents.get(p), "func", None) is not p]
    if not own or not all(module.has(part) for part in own):
        return None
    splices = splices_of(module, own, new)
    return case.changed(module, *splices) if splices else None


def other_method(case: Case) -> Files | None:
    """Give the timer's callback a name of its own; calls of Node's method keep theirs."""
    node, name = case.node, str(case.finding.params.get("name", ""))
    method = node.method(name) if node is not None else None
    new = NEW_CALLBACK
    timers = [t.callback for t in node.timers] if node is not None else []
    if node is None or method is None or new in node.methods or len(timers) != 1:
        return None
    given, module = timers[0], node.module
    if not isinstance(given, ast.Attribute) or own_name(given) != name:
        return None
    splices, head = splices_of(module, [given], new), def_renamed(module, method, new)
    return case.changed(module, head, *splices) if splices and head is not None else None


def shared_method(case: Case) -> Files | None:
    """Give the timer's callback another name than an attribute has; nothing else calls it."""
    node, name = case.node, str(case.finding.params.get("name", ""))
    if node is None or any(own_name(call.func) == name for call in node.calls_of(name)):
        return None
    return other_method(case)
