"""Fixes of nearly right names: the module, main, the counter."""

from __future__ import annotations

import ast

from grader.base.nearest import nearest
from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.node_code import NodeCode, own, read_node
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of


def rclpy(case: Case) -> Files | None:
    """Import rclpy by its right name, if the code uses that name."""
    code = read_node(case)
    if code is None:
        return None
    splices = []
    for statement in code.tree.body:
        line = code.source.line(statement.lineno)
        if isinstance(statement, ast.Import) and len(statement.names) == 1:
            written = statement.names[0].name
        elif isinstance(statement, ast.ImportFrom) and not statement.level:
            written = (statement.module or "").partition(".")[0]
        else:
            continue
        if nearest("rclpy", [written], cutoff=0.75) != written or line.count(written) != 1:
            continue
        at = code.source.start_of(statement.lineno) + line.find(written)
        splices.append(Splice(at, at + len(written), "rclpy"))
    used = any(isinstance(n, ast.Name) and n.id == "rclpy" for n in ast.walk(code.tree))
    return code.changed(*splices) if used else None


def main(case: Case) -> Files | None:
    """Rename the only function of the file to main."""
    code = read_node(case)
    wanted = case.assignment.target.partition(":")[2]
    found = [s for s in code.tree.body if isinstance(s, ast.FunctionDef)] if code else []
    if code is None or len(found) != 1 or found[0].name == wanted:
        return None
    old = found[0].name
    head = code.source.at(found[0].lineno, found[0].col_offset) + len("def ")
    names = [n for n in ast.walk(code.tree) if isinstance(n, ast.Name)]
    if any(n.id == wanted or (n.id == old and isinstance(n.ctx, ast.Store)) for n in names):
        return None
    if code.source.text[head : head + len(old)] != old or not code.calls("init", within=found[0]):
        return None
    uses = [code.source.swap(n, wanted) for n in names if n.id == old]
    return code.changed(Splice(head, head + len(old), wanted), *uses)


def counter(case: Case) -> Files | None:
    """Make __init__ set the counter that the callback logs: with self. and the same name."""
    code = read_node(case)
    call = code.log_call if code else None
    init = code.method("__init__") if code else None
    if code is None or call is None or init is None:
        return None
    logged = {own(n) for n in ast.walk(call) if isinstance(n, ast.Attribute)} - {"", "get_logger"}
    if len(logged) != 1 or _is_set(code, min(logged)):
        return None
    name = min(logged)
    for statement in init.body:
        target = statement.targets[0] if isinstance(statement, ast.Assign) else None
        written = target.id if isinstance(target, ast.Name) else own(target)
        near = written == name or nearest(name, [written], cutoff=0.8) == written
        if target is None or not near or not _is_number(statement):
            continue
        if _is_alone(code, target, written):
            return code.changed(code.source.swap(target, f"self.{name}"))
    lines = [s for s in init.body if "super().__init__(" in ast.unparse(s)]
    if len(lines) != 1 or lines[0].lineno == init.lineno:
        return None
    indent = indent_of(code.source.line(lines[0].lineno))
    row = f"{indent}self.{name} = {case.assignment.output.start}"
    return code.changed(code.source.before((lines[0].end_lineno or lines[0].lineno) + 1, row))


def _is_number(statement: ast.stmt) -> bool:
    value = statement.value if isinstance(statement, ast.Assign) else None
    return isinstance(value, ast.Constant) and type(value.value) is int


def _is_set(code: NodeCode, name: str) -> bool:
    """Whether anything defines an attribute of self, except `+=`, which needs it beforehand."""
    if any(name in (m.name, "self") for m in code.methods):
        return True
    for node in ast.walk(code.tree):
        if isinstance(node, ast.Assign) and any(own(t) == name for t in node.targets):
            return True
        if isinstance(node, ast.AnnAssign) and own(node.target) == name:
            return True
    return any(
        isinstance(s, ast.Assign) and any(ast.unparse(t) == name for t in s.targets)
        for s in code.node_class.body
    )


def _is_alone(code: NodeCode, target: ast.expr, written: str) -> bool:
    """Whether a name is used only in the assignment to it."""
    same = [
        n
        for n in ast.walk(code.tree)
        if n is not target
        and (
            (isinstance(n, ast.Name) and n.id == written and isinstance(target, ast.Name))
            or (isinstance(n, ast.Attribute) and own(n) == written and own(target) == written)
        )
    ]
    return not same
