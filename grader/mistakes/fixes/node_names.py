"""Fixes of nearly right names: the module, main, the counter."""

from __future__ import annotations

import ast

from grader.base.nearest import nearest
from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.rename import def_renamed
from grader.package.edit.files import Files
from grader.package.edit.text import indent_of
from grader.package.source.counter import names_given, targets_of
from grader.package.source.names import dotted, last_part, own_name
from grader.package.source.node import NodeSource
from grader.package.source.scopes import bindings

IMPORT = ast.Import | ast.ImportFrom


def missing_import(case: Case) -> Files | None:
    """Add the missing import below the imports at the top of the file."""
    module = case.module
    name, statement = (str(case.finding.params.get(key, "")) for key in ("name", "statement"))
    imports = [s for s in module.tree.body if isinstance(s, IMPORT)] if module is not None else []
    if module is None or not statement or not imports or bindings(module, name):
        return None
    last = imports[-1]
    return case.changed(module, module.text.before((last.end_lineno or last.lineno) + 1, statement))


def only_starter(source: NodeSource, wanted: str) -> ast.FunctionDef | None:
    """Return the only function of the file, if it has another name and calls rclpy.init."""
    found = [s for s in source.entry.tree.body if isinstance(s, ast.FunctionDef)]
    if len(found) != 1 or found[0].name == wanted or not source.calls_of("init", within=found[0]):
        return None
    return found[0]


def main(case: Case) -> Files | None:
    """Rename the only function of the file to main."""
    node = case.node
    wanted = case.assignment.function
    found = only_starter(node, wanted) if node is not None else None
    if node is None or found is None:
        return None
    old, text = found.name, node.entry.text
    head = def_renamed(node.entry, found, wanted)
    names = [n for n in node.entry.nodes if isinstance(n, ast.Name)]
    if any(n.id == wanted or (n.id == old and isinstance(n.ctx, ast.Store)) for n in names):
        return None
    uses = [text.swap(n, wanted) for n in names if n.id == old]
    return case.changed(node.entry, head, *uses) if head is not None else None


def counter(case: Case) -> Files | None:
    """Make __init__ set the counter that the callback logs: with self. and the same name."""
    node = case.node
    call = node.log_call if node else None
    init = node.method("__init__") if node else None
    if node is None or call is None or init is None:
        return None
    logged = {n.removeprefix("self.") for n in names_given(call) if n.startswith("self.")}
    logged = {name.partition(".")[0] for name in logged} - {"get_logger"}
    if len(logged) != 1 or _is_set(node, min(logged)) or not counts(node, min(logged)):
        return None
    own = node.node_class
    bases = [last_part(dotted(base)) for base in own.bases] if own is not None else []
    if min(logged).startswith("__") and bases != ["Node"]:
        return None  # (a base class can have the private name)
    name, text = min(logged), node.module.text
    for statement in init.body:
        target = statement.targets[0] if isinstance(statement, ast.Assign) else None
        written = target.id if isinstance(target, ast.Name) else own_name(target)
        near = written == name or nearest(name, [written], cutoff=0.8) == written
        if target is None or not written or not near or not _is_number(statement):
            continue
        if _is_alone(node, target):
            return case.changed(node.module, text.swap(target, f"self.{name}"))
    lines = [s for s in init.body if "super().__init__(" in ast.unparse(s)]
    if len(lines) != 1 or lines[0].lineno == init.lineno:
        return None
    indent = indent_of(text.line(lines[0].lineno))
    row = f"{indent}self.{name} = {case.assignment.output.start}"
    below = (lines[0].end_lineno or lines[0].lineno) + 1
    return case.changed(node.module, text.before(below, row))


def counts(node: NodeSource, name: str) -> bool:
    """Whether a line of the node's class adds to an attribute: it is a number that needs a start."""
    own = f"self.{name}"
    for part in node.own_nodes:
        if isinstance(part, ast.AugAssign) and dotted(part.target) == own:
            return isinstance(part.op, ast.Add | ast.Sub) and not _is_text(part.value)
        if isinstance(part, ast.Assign) and own in targets_of(part):
            value = part.value
            if isinstance(value, ast.BinOp) and dotted(value.left) == own:
                return not _is_text(value.right)
    return False


def _is_text(value: ast.expr) -> bool:
    return isinstance(value, ast.JoinedStr) or isinstance(getattr(value, "value", None), str)


def _is_number(statement: ast.stmt) -> bool:
    value = statement.value if isinstance(statement, ast.Assign) else None
    return isinstance(value, ast.Constant) and type(value.value) is int


def _is_set(node: NodeSource, name: str) -> bool:
    """Whether anything defines an attribute of self, except `+=`, which needs it beforehand."""
    if name == "self" or any(name == method.name for method in node.own_methods):
        return True
    for part in node.own_nodes:
        if not isinstance(part, ast.AugAssign) and f"self.{name}" in targets_of(part):
            return True
    return any(name in targets_of(s) for s in node.class_body if isinstance(s, ast.Assign))


def _is_alone(node: NodeSource, target: ast.expr) -> bool:
    """Whether a name is used only in the assignment to it."""
    name = dotted(target)
    same = [n for n in node.own_nodes if isinstance(n, type(target)) and dotted(n) == name]
    return same == [target]
