"""Fixes of the counter."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.node_code import NodeCode, own, read_node
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of


def plus(case: Case) -> Files | None:
    """Replace =+ with +=."""
    code = read_node(case)
    found: list[tuple[ast.Assign, ast.UnaryOp]] = []
    changes = [s for name in code.counters() for s in code.changes_of(name)] if code else []
    for change in changes:
        value = change.value if isinstance(change, ast.Assign) else None
        if isinstance(value, ast.UnaryOp) and isinstance(change, ast.Assign):
            found += [(change, value)] if isinstance(value.op, ast.UAdd) else []
    if code is None or len(found) != 1:
        return None
    statement, signed = found[0]
    start = code.source.span(statement.targets[0])[1]
    end = code.source.span(signed)[0]
    if "".join(code.source.text[start:end].split()) != "=":
        return None
    return code.changed(Splice(start, code.source.span(signed.operand)[0], " += "))


def step(case: Case) -> Files | None:
    """Increment the counter after the log line, if nothing ever changes it."""
    code = read_node(case)
    call = code.log_call if code else None
    if code is None or call is None:
        return None
    named = {own(n) for n in ast.walk(call) if isinstance(n, ast.Attribute)} & set(code.counters())
    lines = [s for m in code.methods for s in m.body if isinstance(s, ast.Expr) and s.value is call]
    if len(named) != 1 or len(lines) != 1 or code.changes_of(min(named)):
        return None
    line = lines[0].end_lineno or lines[0].lineno
    indent = indent_of(code.source.line(lines[0].lineno))
    row = f"{indent}self.{min(named)} += {case.assignment.output.step}"
    return code.changed(code.source.before(line + 1, row))


def start(case: Case) -> Files | None:
    """Correct the first number: change the initial value, or increment after the log line."""
    code = read_node(case)
    call = code.log_call if code else None
    name = _counted(code, call) if code and call else ""
    changes = code.changes_of(name) if code and name else []
    if code is None or call is None or len(changes) != 1:
        return None
    change, first = changes[0], code.counters()[name]
    if not isinstance(change, ast.AugAssign):
        return None
    if change.lineno > call.lineno:
        wanted = case.assignment.output.start
        return (
            code.changed(code.source.swap(first, repr(wanted))) if first.value != wanted else None
        )
    return _after_log(code, change, call) if first.value == case.assignment.output.start else None


def _after_log(code: NodeCode, change: ast.stmt, call: ast.Call) -> Files | None:
    """Move the line directly before the log line to directly after it."""
    body = next((m.body for m in code.methods if change in m.body), [])
    at = body.index(change) if body else 0
    log = body[at + 1] if at + 1 < len(body) else None
    if not isinstance(log, ast.Expr) or log.value is not call:
        return None
    if change.end_lineno != change.lineno or change.lineno + 1 != log.lineno:
        return None
    row = code.source.line(change.lineno)
    below = (log.end_lineno or log.lineno) + 1
    return code.changed(code.source.without(change.lineno), code.source.before(below, row))


def _counted(code: NodeCode, call: ast.Call) -> str:
    """Return the name of the counter that is logged; "" if there is not exactly one."""
    named = {own(n) for n in ast.walk(call) if isinstance(n, ast.Attribute)} & set(code.counters())
    return min(named) if len(named) == 1 else ""


def by(case: Case) -> Files | None:
    """Increment the counter by the required step."""
    code = read_node(case)
    call = code.log_call if code else None
    name = _counted(code, call) if code and call else ""
    changes = code.changes_of(name) if code and name else []
    change = changes[0] if len(changes) == 1 else None
    wanted = case.assignment.output.step
    if code is None or not isinstance(change, ast.AugAssign) or wanted < 0:
        return None
    value = change.value
    if not isinstance(value, ast.Constant) or type(value.value) is not int:
        return None
    if not isinstance(change.op, ast.Add | ast.Sub):
        return None
    if (type(change.op), value.value) == (ast.Add, wanted):
        return None
    code_of = code.source.code(change.target)
    return code.changed(code.source.swap(change, f"{code_of} += {wanted}"))


def twice(case: Case) -> Files | None:
    """Remove the second of two identical lines in a row in a method."""
    code = read_node(case)
    if code is None:
        return None
    splices = []
    for method in code.methods:
        for one, other in zip(method.body, method.body[1:]):
            rows = [code.source.line(s.lineno).strip() for s in (one, other)]
            if rows[0] == rows[1] == code.source.code(other) and ast.unparse(one) == rows[0]:
                splices.append(code.source.without(other.lineno))
    return code.changed(*splices) if len(splices) == 1 else None


def self_dot(case: Case) -> Files | None:
    """Put the missing self. before the counter."""
    code = read_node(case)
    if code is None or not code.counters():
        return None
    bound = {a.arg for n in ast.walk(code.tree) if isinstance(n, ast.arguments) for a in n.args}
    splices = []
    for method in code.methods:
        for node in ast.walk(method):
            if isinstance(node, ast.Name) and node.id in code.counters() and node.id not in bound:
                if method.name == "__init__":
                    return None
                at = code.source.span(node)[0]
                splices.append(Splice(at, at, "self."))
    return code.changed(*splices)


def kept(case: Case) -> Files | None:
    """Remove the line of the callback that resets the counter to its start."""
    code = read_node(case)
    call = code.log_call if code else None
    name = _counted(code, call) if code and call else ""
    changes = code.changes_of(name) if code and name else []
    resets = [s for s in changes if isinstance(s, ast.Assign)]
    if code is None or len(changes) != 2 or len(resets) != 1:
        return None
    value = resets[0].value
    plain = isinstance(value, ast.Constant) and value.value == case.assignment.output.start
    in_method = any(resets[0] in method.body for method in code.methods)
    row = code.source.line(resets[0].lineno).strip()
    if not plain or not in_method or row != code.source.code(resets[0]):
        return None
    return code.changed(code.source.without(resets[0].lineno))
