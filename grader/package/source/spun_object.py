"""An object of the student's own class that is given to rclpy.spin, and the node that it has."""

from __future__ import annotations

import ast
from collections.abc import Collection

from grader.package.source.names import called_name, dotted, last_part, own_name

TAKE_A_NODE = ("spin", "spin_once", "spin_until_future_complete", "add_node")
MAKE_A_NODE = ("Node", "create_node", "LifecycleNode")


def given_to_spin(tree: ast.AST, line: int | None, made_by: str) -> ast.expr | None:
    """Return the object of a class that a call on a line spins, or adds to the executor.

    A call of spin without a node spins those of add_node, wherever it is.
    """
    calls = [n for n in ast.walk(tree) if isinstance(n, ast.Call) and called_name(n) in TAKE_A_NODE]
    here = [c for c in calls if line and c.lineno <= line <= (c.end_lineno or c.lineno)]
    if any(not call.args and not call.keywords for call in here):
        here = [call for call in calls if called_name(call) == "add_node"]
    for call in here:
        named = {keyword.arg: keyword.value for keyword in call.keywords}
        given = call.args[0] if call.args else named.get("node")
        if given is not None and _is_made_by(given, made_by, tree):
            return given
    return None


def _is_made_by(given: ast.expr, made_by: str, tree: ast.AST) -> bool:
    """Whether an expression is a new object of a class, or a variable that only gets such ones."""
    if isinstance(given, ast.Call):
        return last_part(dotted(given.func)) == made_by
    if not isinstance(given, ast.Name):
        return False
    if given.id == "self":
        owners = [n for n in ast.walk(tree) if isinstance(n, ast.ClassDef) and n.name == made_by]
        return any(given in ast.walk(owner) for owner in owners)
    made = [
        n.value
        for n in ast.walk(tree)
        if isinstance(n, ast.Assign) and given.id in map(dotted, n.targets)
    ]
    return bool(made) and all(
        isinstance(m, ast.Call) and _is_made_by(m, made_by, tree) for m in made
    )


def node_of_class(found: ast.ClassDef, classes: Collection[str] = ()) -> str:
    """Return the only attribute of self that gets a new node; "" if there is none, or several.

    `classes` are the student's own classes of nodes.
    """
    names: set[str] = set()
    for node in ast.walk(found):
        value = node.value if isinstance(node, ast.Assign | ast.AnnAssign) else None
        if not isinstance(value, ast.Call) or called_name(value) not in (*MAKE_A_NODE, *classes):
            continue
        targets = node.targets if isinstance(node, ast.Assign) else [getattr(node, "target", None)]
        names |= {own_name(target) for target in targets}
    names.discard("")
    return min(names) if len(names) == 1 else ""
