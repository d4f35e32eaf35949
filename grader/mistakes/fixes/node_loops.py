"""Fixes of loops that do what a timer does."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.course.assignment import Assignment
from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source.endless import Loop, calls_of_methods, goes_on, sleeps_in
from grader.package.source.module import Function, Module, is_text
from grader.package.source.names import calls_in, dotted, last_part, own_name
from grader.package.source.node import LOG_METHODS, NodeSource
from grader.package.source.place import block_of, function_at
from grader.package.source.scopes import scope_of

QUICK = ("print", "str", "format", "ok", "int", "get_logger", "get_logger()", *LOG_METHODS)
"""What a loop may call that does not wait."""
FREE = ("counter", "count", "own_counter", "calls_of_callback")  # names for a new counter


def without_loop(case: Case) -> Files | None:
    """Remove the loop of the finding and the sleep in it, and keep its other lines."""
    found = _loop(case)
    if found is None or case.node is None or _counts_itself(found[1], found[2]):
        return None
    unwrapped = lines.unwrapped(case)
    module, _, function = found
    after = replace(case, files=unwrapped) if unwrapped is not None else case
    files = _without_sleep(after, module.path, function.name) if unwrapped is not None else None
    return lines.without_import(replace(case, files=files), "time") if files is not None else None


def timer_for_loop(case: Case) -> Files | None:
    """Create a timer where __init__ calls the method with the loop, and remove the loop."""
    found, node = _loop(case), case.node
    init = node.method("__init__") if node is not None else None
    if found is None or node is None or init is None or node.timers:
        return None
    module, loop, method = found
    calls = [call for call, called in calls_of_methods(node, init) if called is method]
    body = [s for s in method.body if not is_text(s)]
    plain = body == [loop] and ast.unparse(method.args) == "self" and not method.decorator_list
    if len(calls) != 1 or calls[0].args or not plain or not module.has(calls[0]):
        return None
    if not isinstance(module.parents.get(calls[0]), ast.Expr):
        return None
    new = f"self.create_timer({seconds_of(node, loop, case.assignment)}, self.{method.name})"
    made = case.changed(module, module.text.swap(calls[0], new))
    return without_loop(replace(case, files=made)) if made is not None else None


def seconds_of(source: NodeSource, loop: Loop, assignment: Assignment) -> str:
    """Return the period of the timer that replaces a loop, as Python code.

    It is the assignment's; if that names none, what the loop sleeps; "…" if that is unknown too.
    """
    slept = [call.args[0] for call in sleeps_in(source, loop) if len(call.args) == 1]
    if assignment.period is not None or len(slept) != 1:
        return assignment.seconds
    code = source.module_of(loop).text.code(slept[0])
    return code if isinstance(slept[0], ast.Constant) or code.startswith("self.") else "…"


def only_call(source: NodeSource, loop: Loop) -> str:
    """Return the method that a loop calls, if that and a sleep is all it does; "" otherwise."""
    sleeps = sleeps_in(source, loop)
    rest = [s for s in loop.body if not (isinstance(s, ast.Expr) and s.value in sleeps)]
    value = rest[0].value if len(rest) == 1 and isinstance(rest[0], ast.Expr) else None
    if not isinstance(value, ast.Call) or value.args or value.keywords or loop.orelse:
        return ""
    return own_name(value.func) if own_name(value.func) in source.methods else ""


def timer_for_calls(case: Case) -> Files | None:
    """Create a timer in __init__ instead of a loop there that only calls a method.

    If a timer calls it already, only the loop is deleted.
    """
    found, node = _loop(case), case.node
    if found is None or node is None:
        return None
    module, loop, _ = found
    method = only_call(node, loop)
    if node.timers:
        return lines.deleted(case) or lines.passed(case)
    if found[2].name != "__init__":
        return None
    start, end = module.text.span(loop)
    new = f"self.create_timer({seconds_of(node, loop, case.assignment)}, self.{method})"
    return case.changed(module, Splice(start, end, new)) if method else None


def _loop(case: Case) -> tuple[Module, Loop, Function] | None:
    """Return the loop of the finding, its file, and the function around it."""
    module, line = case.module, case.finding.line
    found = [
        n for n in (module.nodes if module else ()) if isinstance(n, Loop) and n.lineno == line
    ]
    function = function_at(module, line) if module is not None else None
    if module is None or len(found) != 1 or function is None:
        return None
    return module, found[0], function


def _counts_itself(loop: Loop, function: Function) -> bool:
    """Whether the loop changes a variable of the function, which the next call does not know."""
    inside = {n.id for n in ast.walk(loop) if isinstance(n, ast.Name) and _is_set(n)}
    before = [n for s in function.body if s.lineno < loop.lineno for n in ast.walk(s)]
    return any(isinstance(n, ast.Name) and n.id in inside and _is_set(n) for n in before)


def _is_set(name: ast.Name) -> bool:
    return isinstance(name.ctx, ast.Store)


def _without_sleep(case: Case, path: str, name: str) -> Files | None:
    """Delete the sleeps of a method, each a statement on its own line."""
    node: NodeSource | None = case.node
    method = node.method(name) if node is not None else None
    if node is None or method is None:
        return None
    module, splices = node.module_at(path), []
    calls = [n for n in ast.walk(method) if isinstance(n, ast.Call)]
    of_rates = [c for c in calls if last_part(dotted(c.func)) == "sleep"]
    for call in {*sleeps_in(node, method), *of_rates}:
        statement = module.parents.get(call)
        if not isinstance(statement, ast.Expr) or len(block_of(module, statement)) == 1:
            return None
        if module.text.line(statement.lineno).strip() != module.text.code(statement):
            return None
        splices.append(module.text.without(statement.lineno))
    return case.changed(module, *splices) if splices else case.files


def counted_by_calls(case: Case) -> Files | None:
    """Log a counter of the node instead of the loop's number, once in each call."""
    found, node = _loop(case), case.node
    init = node.super_init if node is not None else None
    if found is None or node is None or init is None or case.finding.params.get("number"):
        return None
    module, loop, _ = found
    own = dotted(loop.target) if isinstance(loop, ast.For) else ""
    if own.startswith("self."):
        row = loop.body[-1].end_lineno or loop.lineno
        step = f"{indent_of(module.text.line(row))}{own} += {case.assignment.output.step}"
        made = case.changed(module, module.text.before(row + 1, step))
        return lines.unwrapped(replace(case, files=made)) if made is not None else None
    number = (
        loop.target.id if isinstance(loop, ast.For) and isinstance(loop.target, ast.Name) else ""
    )
    text, output = module.text, case.assignment.output
    used = [n for s in loop.body for n in ast.walk(s) if isinstance(n, ast.Name) and n.id == number]
    kept = str(case.finding.params.get("kept", ""))
    if kept:
        made = case.changed(module, *(text.swap(n, kept) for n in used))
        there = replace(case.finding, line=loop.lineno)
        return lines.unwrapped(replace(case, files=made, finding=there)) if made else None
    counter = next(f"self.{name}" for name in FREE if name not in node.attributes | {*node.methods})
    if not used or not module.has(init) or any(text.code(n) != number for n in used):
        return None
    last = loop.body[-1]
    step = f"{indent_of(text.line(last.lineno))}{counter} += {output.step}"
    start = f"{indent_of(text.line(init.lineno))}{counter} = {output.start}"
    made = case.changed(
        module,
        *(text.swap(n, counter) for n in used),
        text.before((last.end_lineno or last.lineno) + 1, step),
        text.before((init.end_lineno or init.lineno) + 1, start),
    )
    if made is None or init.lineno > loop.lineno:
        return None
    there = replace(case.finding, line=loop.lineno + 1)
    return lines.unwrapped(replace(case, files=made, finding=there))


def prints_in(source: NodeSource, part: ast.AST) -> bool:
    """Return whether a part of the source logs or prints, or a method that it calls does."""
    called = [source.methods.get(last_part(name)) for _, name in calls_in(part)]
    parts = [part, *(method for method in called if method is not None)]
    return any(source.logs(each) or source.prints(each) for each in parts)


def printing_loop(source: NodeSource) -> ast.While | None:
    """Return the loop of the entry function that prints or logs, has no end, and never waits."""
    for loop in ast.walk(source.main) if source.main is not None else ():
        if not isinstance(loop, ast.While) or not goes_on(loop) or not prints_in(source, loop):
            continue
        if scope_of(source.module_of(loop), loop) is not source.main:
            continue  # (a thread may run a function inside)
        quick = all(_is_quick(source, name) for _, name in calls_in(loop))
        ends = any(isinstance(n, ast.Raise | ast.Await | ast.Try) for n in ast.walk(loop))
        if quick and not ends:
            return loop
    return None


def _is_quick(source: NodeSource, name: str) -> bool:
    """Whether what is called does not wait: a method of the node only if nothing in it does."""
    method = source.methods.get(last_part(name))
    inside = [last_part(called) for _, called in calls_in(method)] if method is not None else ()
    loops = [n for n in ast.walk(method) if isinstance(n, Loop)] if method is not None else ()
    own = method is not None and not loops and all(called in QUICK for called in inside)
    return last_part(name) in QUICK or own


def spins_after(source: NodeSource, loop: ast.While) -> bool:
    """Return whether the entry function spins below the loop."""
    calls = calls_in(source.main) if source.main is not None else ()
    last = loop.end_lineno or loop.lineno
    return any(last_part(name) == "spin" and call.lineno > last for call, name in calls)


def spin_for_loop(case: Case) -> Files | None:
    """Spin instead of the loop of the entry function that prints."""
    node = case.node
    loop = printing_loop(node) if node is not None else None
    if node is None or loop is None or loop.lineno != case.finding.line or loop.orelse:
        return None
    if spins_after(node, loop):
        return lines.deleted(case)
    variables, module = node.node_variables, node.module_of(loop)
    if len(variables) != 1 or node.calls_of("spin", "spin_once"):
        return None
    return case.changed(module, module.text.swap(loop, f"rclpy.spin({min(variables)})"))
