"""Fixes of what the node logs."""

from __future__ import annotations

import ast
import difflib
import re

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.source.counter import starts_of
from grader.package.source.module import Module
from grader.package.source.names import called_name, dotted, own_name
from grader.package.source.node import NodeSource
from grader.package.source.place import statement_at

PLACE = re.compile(r"\{((?:[A-Za-z_]\w*\.)?[A-Za-z_]\w*)\}")
ALIKE = 0.7


def f_prefix(case: Case) -> Files | None:
    """Add the f prefix to a string with the counter in braces."""
    node = case.node
    call = node.log_call if node else None
    if node is None or call is None:
        return None
    module = node.module_of(call)
    given = call.args[0]
    logged = module.text.plain_string(given) or ""
    names = PLACE.findall(logged)
    if not names or logged.count("{") != len(names) or not set(names) <= set(starts_of(node)):
        return None
    start = module.text.span(given)[0]
    return case.changed(module, Splice(start, start, "f"))


def text(case: Case) -> Files | None:
    """Correct the text before the number if it is nearly the required one."""
    node = case.node
    call = node.log_call if node else None
    before, _, after = case.assignment.output.text.partition("{n}")
    if node is None or call is None or after:
        return None
    logged, module = call.args[0], node.module_of(call)
    if isinstance(logged, ast.BinOp) and isinstance(logged.op, ast.Add):
        start, end = module.text.span(logged.left)[1], module.text.span(logged)[1]
        if isinstance(logged.left, ast.BinOp) and module.text.plain_string(logged.right):
            return case.changed(module, Splice(start, end, ""))
        literal = module.text.plain_string(logged.left)
        if literal is None or not _near(literal, before):
            return None
        if isinstance(logged.right, ast.Constant | ast.BinOp):
            return None
        quote = module.text.code(logged.left)[0]
        return case.changed(module, module.text.swap(logged.left, f"{quote}{before}{quote}"))
    return _formatted(case, module, logged, before)


def _formatted(case: Case, module: Module, logged: ast.expr, before: str) -> Files | None:
    """Correct the text before the only replacement field of an f-string."""
    written = module.text.code(logged)
    match = re.fullmatch(r"([fF])(['\"])([^{}'\"\\]+)(\{[^{}'\"\\]+\})\2", written)
    if not isinstance(logged, ast.JoinedStr) or match is None or not _near(match[3], before):
        return None
    new = f"{match[1]}{match[2]}{before}{match[4]}{match[2]}"
    return case.changed(module, module.text.swap(logged, new))


def _near(found: str, wanted: str) -> bool:
    if found == wanted or "'" in wanted or '"' in wanted:
        return False
    ratio = difflib.SequenceMatcher(None, found.lower(), wanted.lower(), autojunk=False).ratio()
    return len(found) <= 2 * len(wanted) and ratio >= ALIKE


def logger(case: Case) -> Files | None:
    """Replace print() with the logger in a method of the node."""
    node = case.node
    prints = node.calls_of("print") if node else []
    if node is None or len(prints) != 1 or len(prints[0].args) != 1 or prints[0].keywords:
        return None
    methods = node.own_methods
    inside = [m for m in methods if prints[0] in ast.walk(m) and m.name != "__init__"]
    takes_self = all(m.args.args and m.args.args[0].arg == "self" for m in methods)
    kept = node.loggers_at(prints[0])
    asked = len([n for n in node.own_nodes if getattr(n, "attr", "") == "get_logger"])
    if not inside or not takes_self or asked != len(node.loggers) or node.own_logs:
        return None
    logger = kept[0] if kept else "self.get_logger()"
    return case.changed(node.module, node.module.text.swap(prints[0].func, f"{logger}.info"))


def without_print(case: Case) -> Files | None:
    """Give the logger the text instead of what print() returns."""
    node = case.node
    call = node.log_call if node else None
    given = call.args[0] if call is not None else None
    if node is None or not isinstance(given, ast.Call) or dotted(given.func) != "print":
        return None
    if len(given.args) != 1 or given.keywords:
        return None
    module = node.module_of(given)
    return case.changed(module, module.text.swap(given, module.text.code(given.args[0])))


def text_outside(
    node: NodeSource, module: Module, line: int | None
) -> tuple[ast.Call, ast.expr] | None:
    """Return the call of the logger or of print at a line, and what is written behind its bracket."""
    statement = statement_at(module, line)
    after = statement.value if isinstance(statement, ast.Expr) else None
    part: ast.expr | None = after
    while part is not None:
        if isinstance(part, ast.Call) and (node.is_log(part) or dotted(part.func) == "print"):
            return (part, after) if after is not None and part is not after else None
        if isinstance(part, ast.BinOp) and isinstance(part.op, ast.Add | ast.Mod):
            part = part.left
        elif isinstance(part, ast.Call) and isinstance(part.func, ast.Attribute):
            part = part.func.value
        else:
            return None
    return None


def text_inside(module: Module, call: ast.Call, after: ast.expr) -> str | None:
    """Return the call with what is behind it in its brackets; None if it can mean something else."""
    given = call.args[0] if len(call.args) == 1 and not call.keywords else None
    if given is None or not isinstance(given, ast.Constant | ast.JoinedStr):
        return None
    text = module.text
    start, end = text.span(after)
    close, last = text.span(call)[1] - 1, text.span(given)[1]
    if text.span(call)[0] != start or text.text[last:close].strip():
        return None
    number = isinstance(after, ast.BinOp) and isinstance(after.op, ast.Add) and after.right
    if number and isinstance(number, ast.Name | ast.Attribute):
        end = text.span(number)[0]
        return f"{text.text[start:last]}{text.text[close + 1 : end]}str({text.code(number)}))"
    return f"{text.text[start:last]}{text.text[close + 1 : end]})"


def moved_inside(case: Case) -> Files | None:
    """Write what is behind the closing bracket of the logger into its brackets."""
    node, module = case.node, case.module
    found = text_outside(node, module, case.finding.line) if node and module else None
    if module is None or found is None:
        return None
    new = text_inside(module, *found)
    return case.changed(module, module.text.swap(found[1], new)) if new is not None else None


def in_braces(case: Case) -> Files | None:
    """Put the name of the counter in one pair of braces in the f-string."""
    node, name = case.node, str(case.finding.params.get("name", ""))
    call = node.log_call if node else None
    if node is None or call is None or not name or not isinstance(call.args[0], ast.JoinedStr):
        return None
    module = node.module_of(call)
    code = module.text.code(call.args[0])
    for written in (f"{{{{{name}}}}}", f"({name})", f"[{name}]"):
        if code.count(name) == 1 and code.count(written) == 1:
            new = code.replace(written, f"{{{name}}}")
            return case.changed(module, module.text.swap(call.args[0], new))
    return None


def level(case: Case) -> Files | None:
    """Log at level INFO."""
    node = case.node
    call = node.log_call if node else None
    if node is None or call is None or called_name(call) == "info":
        return None
    module = node.module_of(call)
    end = module.text.span(call.func)[1]
    return case.changed(module, Splice(end - len(called_name(call)), end, "info"))


def logger_call(case: Case) -> Files | None:
    """Add the missing () to get_logger."""
    node = case.node
    if node is None:
        return None
    used = [n.value for n in node.own_nodes if isinstance(n, ast.Attribute)]
    lacking = [part for part in used if own_name(part) == "get_logger"]
    ends = {node.module.text.span(part)[1] for part in lacking if node.module.has(part)}
    return case.changed(node.module, *(Splice(end, end, "()") for end in sorted(ends)))


def comma(case: Case) -> Files | None:
    """Join text and number with + instead of a comma, which only print accepts."""
    node = case.node
    calls = [c for c in node.calls_of("info") if node.is_own_log(c)] if node else []
    if node is None or len(calls) != 1 or len(calls[0].args) != 2 or calls[0].keywords:
        return None
    first, second = calls[0].args
    text = node.module_of(first).text
    to_text = isinstance(second, ast.Call) and called_name(second) == "str"
    literal = text.plain_string(first)
    formats = literal is not None and re.findall(r"%.?", literal) in (["%d"], ["%s"], ["%i"])
    start, end = text.span(first)[1], text.span(second)[0]
    if literal is None or text.text[start:end].strip() != ",":
        return None
    before = case.assignment.output.text.partition("{n}")[0]
    if "%" not in literal and literal in (before, before.rstrip()) and dotted(second):
        q = text.code(first)[0]
        number = text.code(second) if to_text else f"str({text.code(second)})"
        new = Splice(text.span(first)[0], text.span(second)[1], f"{q}{before}{q} + {number}")
        return case.changed(node.module_of(first), new)
    if not (to_text or formats):
        return None
    return case.changed(node.module_of(first), Splice(start, end, " % " if formats else " + "))


def number(case: Case) -> Files | None:
    """Append the counter if only the text is logged."""
    node = case.node
    call = node.log_call if node else None
    counters = list(starts_of(node)) if node else []
    before, _, after = case.assignment.output.text.partition("{n}")
    if node is None or call is None or after or len(counters) != 1:
        return None
    module = node.module_of(call)
    output = case.assignment.output
    written = module.text.plain_string(call.args[0]) or ""
    if written.rstrip() != before.rstrip() and written != output.line(output.start):
        return None
    q = module.text.code(call.args[0])[0]
    new = f"{q}{before}{q} + str({counters[0]})"
    return case.changed(module, module.text.swap(call.args[0], new))


def only_logged(case: Case) -> Files | None:
    """Remove a print() of the text that is logged as well."""
    node = case.node
    call = node.log_call if node else None
    if node is None or call is None or called_name(call) == "debug":
        return None
    text = node.module.text
    logged = node.module_of(call).text.code(call.args[0])
    for function in node.own_functions:
        for statement in function.body:
            row = text.line(statement.lineno).strip()
            if row == f"print({logged})" == text.code(statement) and len(function.body) > 1:
                return case.changed(node.module, text.without(statement.lineno))
    return None
