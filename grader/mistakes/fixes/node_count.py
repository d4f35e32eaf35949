"""Fixes of the counter."""

from __future__ import annotations

import ast

from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source.counter import (
    adds_to,
    changes_of,
    declares,
    logged_counter,
    names_given,
    outer_start,
    starts_of,
    targets_of,
)
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of, statement_at


def plus(case: Case) -> Files | None:
    """Replace =+ with +=."""
    node = case.node
    found: list[tuple[ast.Assign, ast.UnaryOp]] = []
    changes = [s for name in starts_of(node) for s in changes_of(node, name)] if node else []
    for change in changes:
        value = change.value if isinstance(change, ast.Assign) else None
        if isinstance(value, ast.UnaryOp) and isinstance(change, ast.Assign):
            found += [(change, value)] if isinstance(value.op, ast.UAdd) else []
    if node is None or len(found) != 1:
        return None
    statement, signed = found[0]
    module = node.module_of(statement)
    start = module.text.span(statement.targets[0])[1]
    end = module.text.span(signed)[0]
    if "".join(module.text.text[start:end].split()) != "=":
        return None
    return case.changed(module, Splice(start, module.text.span(signed.operand)[0], " += "))


def step(case: Case) -> Files | None:
    """Increment the counter after the log line, if nothing ever changes it."""
    node = case.node
    call = node.log_call if node else None
    name = _counted(node, call) if node and call else ""
    function = node.function_around(call) if node and call else None
    if node is None or call is None or function is None or not name:
        return None
    lines = [s for s in function.body if isinstance(s, ast.Expr) and s.value is call]
    if len(lines) != 1 or changes_of(node, name):
        return None
    module = node.module_of(call)
    line = lines[0].end_lineno or lines[0].lineno
    indent = indent_of(module.text.line(lines[0].lineno))
    row = f"{indent}{name} += {case.assignment.output.step}"
    return case.changed(module, *_declared(node, name), module.text.before(line + 1, row))


def _declared(node: NodeSource, name: str) -> list[Splice]:
    """Return the splices that declare a variable in the callback, if it needs that."""
    callback = node.callback
    start = outer_start(node, name)
    if callback is None or start is None or declares(callback, name):
        return []
    module = node.module_of(callback)
    first = callback.body[0]
    documented = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant)
    line = (first.end_lineno or first.lineno) + 1 if documented else first.lineno
    word = "global" if node.function_around(start) is None else "nonlocal"
    indent = indent_of(module.text.line(first.lineno))
    return [module.text.before(line, f"{indent}{word} {name}")]


def start(case: Case) -> Files | None:
    """Correct the first number: change the initial value, or increment after the log line."""
    node = case.node
    call = node.log_call if node else None
    name = _counted(node, call) if node and call else ""
    changes = changes_of(node, name) if node and name else []
    if node is None or call is None or len(changes) != 1:
        return None
    change, first = changes[0], starts_of(node)[name]
    if not adds_to(change, name):
        return None
    wanted = case.assignment.output.start
    if change.lineno > call.lineno:
        module = node.module_of(first)
        return (
            case.changed(module, module.text.swap(first, repr(wanted)))
            if (first.value != wanted)
            else None
        )
    return _after_log(case, change, call, name) if first.value == wanted else None


def _after_log(case: Case, change: ast.stmt, call: ast.Call, name: str) -> Files | None:
    """Move the line that counts from before the log line, and what builds its text, to after it."""
    node = case.node
    function = node.function_around(change) if node else None
    body = function.body if function is not None and change in function.body else []
    log = next((s for s in body if isinstance(s, ast.Expr) and s.value is call), None)
    if node is None or log is None or body.index(log) < body.index(change):
        return None
    between = body[body.index(change) + 1 : body.index(log)]
    if any(not isinstance(s, ast.Assign) or name in targets_of(s) for s in between):
        return None
    module = node.module_of(change)
    code = module.text.line(change.lineno).partition("#")[0].strip()
    if code != module.text.code(change):
        return None
    row = module.text.line(change.lineno)
    below = (log.end_lineno or log.lineno) + 1
    return case.changed(module, module.text.without(change.lineno), module.text.before(below, row))


def _counted(node: NodeSource, call: ast.Call) -> str:
    """Return the name of the counter that is logged; "" if there is not exactly one."""
    starts = set(starts_of(node))
    named = set(names_given(call)) & starts
    logged = logged_counter(node)
    if not named and logged is not None and logged[0] is call:
        named = {logged[1]} & starts  # (the text is built on a line before)
    return min(named) if len(named) == 1 else ""


def by(case: Case) -> Files | None:
    """Increment the counter by the required step."""
    node = case.node
    call = node.log_call if node else None
    name = _counted(node, call) if node and call else ""
    changes = changes_of(node, name) if node and name else []
    change = changes[0] if len(changes) == 1 else None
    wanted = case.assignment.output.step
    if node is None or not isinstance(change, ast.AugAssign) or wanted < 0:
        return None
    value = change.value
    if not isinstance(value, ast.Constant) or type(value.value) is not int:
        return None
    if not isinstance(change.op, ast.Add | ast.Sub):
        return None
    if (type(change.op), value.value) == (ast.Add, wanted):
        return None
    module = node.module_of(change)
    code_of = module.text.code(change.target)
    return case.changed(module, module.text.swap(change, f"{code_of} += {wanted}"))


def twice(case: Case) -> Files | None:
    """Remove the second of two identical lines in a row in a function of the node."""
    node = case.node
    if node is None:
        return None
    text = node.module.text
    splices = []
    for function in node.own_functions:
        for one, other in zip(function.body, function.body[1:]):
            rows = [text.line(s.lineno).strip() for s in (one, other)]
            if rows[0] == rows[1] == text.code(other) and ast.unparse(one) == rows[0]:
                splices.append(text.without(other.lineno))
    return case.changed(node.module, *splices) if len(splices) == 1 else None


def self_dot(case: Case) -> Files | None:
    """Put the missing self. before the counter."""
    node = case.node
    starts = starts_of(node) if node else {}
    own = {name.removeprefix("self.") for name in starts if name.startswith("self.")}
    if node is None or not own:
        return None
    bound = {a.arg for n in node.own_nodes if isinstance(n, ast.arguments) for a in n.args}
    splices = []
    for method in node.own_methods:
        for part in ast.walk(method):
            if isinstance(part, ast.Name) and part.id in own and part.id not in bound:
                has_self = [a.arg for a in method.args.args[:1]] == ["self"]
                if method.name == "__init__" or node.module.text.code(part) != part.id:
                    return None
                if not has_self:
                    return None
                at = node.module.text.span(part)[0]
                splices.append(Splice(at, at, "self."))
    return case.changed(node.module, *splices)


def outer(case: Case) -> Files | None:
    """Declare the counter, a variable outside the callback that it changes."""
    node = case.node
    callback = node.callback if node else None
    if node is None or callback is None:
        return None
    changed = {n for part in ast.walk(callback) for n in targets_of(part)}
    names = {name for name in changed if outer_start(node, name) and not declares(callback, name)}
    return case.changed(node.module, *_declared(node, min(names))) if len(names) == 1 else None


def moved(case: Case) -> Files | None:
    """Move the line of the callback that resets an attribute to __init__, or delete it.

    It is deleted if __init__ or the class gives the attribute its start.
    """
    node, name = case.node, str(case.finding.params.get("name", ""))
    init, module = node.method("__init__") if node else None, case.module
    if node is None or module is None or init is None or not name.startswith("self."):
        return None
    statement = statement_at(module, case.finding.line)
    if statement is None or node.function_around(statement) is not node.callback:
        return None  # (__init__ can call the same method)
    if name in starts_of(node):
        return lines.deleted(case)
    base = node.super_init
    row = module.text.line(statement.lineno) if statement is not None else ""
    if statement is None or base is None or row.strip() != module.text.code(statement):
        return None
    if node.module is not module or len(block_of(module, statement)) == 1:
        return None
    indent = indent_of(module.text.line(base.lineno))
    after = module.text.before((base.end_lineno or base.lineno) + 1, f"{indent}{row.strip()}")
    return case.changed(module, after, module.text.without(statement.lineno))


def number_step(case: Case) -> Files | None:
    """Remove the quotes of the number that is added to the counter on the finding's line."""
    module = case.module
    found = [
        n
        for s in (module.nodes if module is not None else ())
        if isinstance(s, ast.AugAssign | ast.Assign) and s.lineno == case.finding.line
        for n in ast.walk(s.value)
        if isinstance(n, ast.Constant) and isinstance(n.value, str)
    ]
    text = module.text.plain_string(found[0]) if module is not None and len(found) == 1 else None
    if module is None or text is None or not text.isascii() or not text.isdigit():
        return None
    return case.changed(module, module.text.swap(found[0], str(int(text))))
