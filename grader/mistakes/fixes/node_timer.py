"""Fixes of the timer and its callback."""

from __future__ import annotations

import ast

from grader.base.nearest import nearest
from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.node_code import NodeCode, own, read_node
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of

NAMES = ("create_timer", "get_logger")


def misspelt(case: Case) -> Files | None:
    """Correct misspelt create_timer and get_logger."""
    code = read_node(case)
    if code is None:
        return None
    known = {m.name for m in code.methods}
    splices = []
    for node in ast.walk(code.tree):
        written = own(node) if isinstance(node, ast.Attribute) else ""
        if (
            not written
            or written in known
            or written in NAMES
            or not isinstance(node, ast.Attribute)
        ):
            continue
        right = nearest(written, NAMES, cutoff=0.85)
        if right and isinstance(node.ctx, ast.Load):
            end = code.source.span(node)[1]
            splices.append(Splice(end - len(written), end, right))
    return code.changed(*splices)


def arguments(case: Case) -> Files | None:
    """Pass the period first and the callback second to create_timer."""
    code = read_node(case)
    timer = code.timer if code else None
    if code is None or timer is None or timer.keywords:
        return None
    if len(timer.args) == 1 and own(timer.args[0]):
        start = code.source.span(timer.args[0])[0]
        return code.changed(Splice(start, start, f"{case.assignment.output.period!r}, "))
    if len(timer.args) != 2 or not own(timer.args[0]) or not _number(timer.args[1]):
        return None
    first, second = timer.args
    return code.changed(
        code.source.swap(first, code.source.code(second)),
        code.source.swap(second, code.source.code(first)),
    )


def _number(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and type(node.value) in (int, float)


def callback(case: Case) -> Files | None:
    """Pass the callback itself to create_timer: with self., without (), by its right name."""
    code = read_node(case)
    timer = code.timer if code else None
    if code is None or timer is None or len(timer.args) < 2:
        return None
    given = timer.args[1]
    names = {m.name for m in code.methods}
    if isinstance(given, ast.Call) and not given.args and not given.keywords:
        if own(given.func) in names:
            return code.changed(code.source.swap(given, code.source.code(given.func)))
        return None
    if isinstance(given, ast.Name) and given.id in names and not _is_bound(code, given.id):
        start = code.source.span(given)[0]
        return code.changed(Splice(start, start, "self."))
    written = own(given)
    if not written or written in names or written in code.counters():
        return None
    near = nearest(written, names - {"__init__"}, cutoff=0.8)
    if not near:
        return None
    end = code.source.span(given)[1]
    return code.changed(Splice(end - len(written), end, near))


def _is_bound(code: NodeCode, name: str) -> bool:
    """Whether a name is bound outside of the class, or assigned anywhere."""
    inside = {id(n) for n in code.node_class.body}
    for node in ast.walk(code.tree):
        if isinstance(node, ast.FunctionDef) and node.name == name and id(node) not in inside:
            return True
        if isinstance(node, ast.Name) and node.id == name and isinstance(node.ctx, ast.Store):
            return True
    return False


def _timer_method(code: NodeCode) -> ast.FunctionDef | None:
    """Return the method that the timer calls."""
    timer = code.timer
    given = timer.args[1] if timer is not None and len(timer.args) > 1 else None
    return code.method(own(given)) if own(given) else None


def callback_self(case: Case) -> Files | None:
    """Give the callback the single parameter self."""
    code = read_node(case)
    method = _timer_method(code) if code else None
    if code is None or method is None or method.decorator_list:
        return None
    arguments = method.args
    if ast.unparse(arguments) == "":
        line = code.source.line(method.lineno)
        head = f"def {method.name}("
        if line.count(head) != 1:
            return None
        at = code.source.start_of(method.lineno) + line.find(head) + len(head)
        return code.changed(Splice(at, at, "self"))
    names = [a.arg for a in arguments.args]
    plain = len(names) == 2 and names[0] == "self" and not arguments.defaults
    extra = [n for n in ast.walk(method) if isinstance(n, ast.Name) and n.id == names[-1]]
    if not plain or extra or arguments.vararg or arguments.kwonlyargs or arguments.kwarg:
        return None
    start = code.source.at(arguments.args[0].lineno, arguments.args[0].col_offset) + len("self")
    last = arguments.args[1]
    end = code.source.at(last.end_lineno or last.lineno, last.end_col_offset or 0)
    return code.changed(Splice(start, end, ""))


def period(case: Case) -> Files | None:
    """Set the timer's period to the required one."""
    code = read_node(case)
    timer = code.timer if code else None
    if code is None or timer is None or not timer.args:
        return None
    given: ast.expr | None = timer.args[0]
    if isinstance(given, ast.Name):
        found = [
            s.value
            for s in ast.walk(code.tree)
            if isinstance(s, ast.Assign) and [ast.unparse(t) for t in s.targets] == [given.id]
        ]
        given = found[0] if len(found) == 1 else None
    wanted = case.assignment.output.period
    if not isinstance(given, ast.Constant) or given.value == wanted:
        return None
    if not _number(given) and not isinstance(given.value, str):
        return None
    return code.changed(code.source.swap(given, repr(wanted)))


def by_hand(case: Case) -> Files | None:
    """Remove the call of the callback in __init__."""
    code = read_node(case)
    method, init = (_timer_method(code), code.method("__init__")) if code else (None, None)
    if code is None or method is None or init is None:
        return None
    calls = [
        s
        for s in init.body
        if isinstance(s, ast.Expr)
        and isinstance(s.value, ast.Call)
        and own(s.value.func) == method.name
    ]
    if len(calls) != 1 or code.source.line(calls[0].lineno).strip() != code.source.code(calls[0]):
        return None
    return code.changed(code.source.without(calls[0].lineno))


def made(case: Case) -> Files | None:
    """Create the missing timer, if exactly one method can be its callback."""
    code = read_node(case)
    init = code.method("__init__") if code else None
    if code is None or init is None or code.calls("create_timer", "create_rate", "sleep"):
        return None
    log = code.log_call
    found = [m for m in code.methods if log is not None and log in list(ast.walk(m))]
    if len(found) != 1 or found[0] is init or ast.unparse(found[0].args) != "self":
        return None
    used = {own(n) for n in ast.walk(code.tree) if isinstance(n, ast.Attribute)}
    last = init.body[-1]
    if found[0].name in used or last.lineno == init.lineno or isinstance(last, ast.Return):
        return None
    indent = indent_of(code.source.line(init.body[-1].lineno))
    seconds = case.assignment.output.period
    row = f"{indent}self.create_timer({seconds!r}, self.{found[0].name})"
    return code.changed(code.source.before((last.end_lineno or last.lineno) + 1, row))


def cancelled(case: Case) -> Files | None:
    """Remove .cancel() after the creation of the timer."""
    code = read_node(case)
    timer = code.timer if code else None
    cancels = code.calls("cancel") if code else []
    if code is None or timer is None or len(cancels) != 1:
        return None
    function = cancels[0].func
    if not isinstance(function, ast.Attribute) or function.value is not timer:
        return None
    return code.changed(Splice(code.source.span(timer)[1], code.source.span(cancels[0])[1], ""))
