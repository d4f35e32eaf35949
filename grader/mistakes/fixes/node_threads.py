"""Fixes of threads and of asyncio in a node, which does the same with a timer."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.mistakes.fixes import lines, node_loops
from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source.endless import endless_loop
from grader.package.source.module import Module
from grader.package.source.names import dotted, last_part
from grader.package.source.place import function_at
from grader.package.source.thread_timers import thread_timer
from grader.package.source.threads import OwnThread, own_threads, variables_of


def timer(case: Case) -> Files | None:
    """Create a timer instead of the thread, and remove the loop of the method that it runs."""
    node, thread = case.node, _thread(case)
    if node is None or thread is None or node.timers or thread.call.args:
        return None
    module, name = node.module_of(thread.call), thread.target.name
    variables = variables_of(node, thread.call)
    made = _statement(module, thread.call)
    used = [
        _statement(module, n)
        for n in module.nodes
        if isinstance(n, ast.Attribute) and dotted(n.value) in variables
    ]
    if not isinstance(made, ast.Assign | ast.Expr) or not module.has(thread.target):
        return None
    if any(not isinstance(statement, ast.Assign | ast.Expr) for statement in used):
        return None
    loop = endless_loop(node, thread.target)
    seconds = node_loops.seconds_of(node, loop, case.assignment) if loop is not None else ""
    rows = sorted({s.lineno for s in used if s is not None and s is not made})
    if any(s is not None and s.lineno != s.end_lineno for s in used):
        return None
    first = case.changed(
        module,
        module.text.swap(made, f"self.create_timer({seconds}, self.{name})"),
        *(module.text.without(row) for row in rows),
    )
    return _without_loop(replace(case, files=first), name) if first is not None else None


def _without_loop(case: Case, name: str) -> Files | None:
    node = case.node
    method = node.method(name) if node is not None else None
    loop = endless_loop(node, method) if node is not None and method is not None else None
    if node is None or loop is None:
        return None
    there = replace(case.finding, file=node.module_of(loop).path, line=loop.lineno)
    files = node_loops.without_loop(replace(case, finding=there))
    if files is None:
        return None
    for unused in ("threading", "time"):
        files = lines.without_import(replace(case, files=files), unused)
    return files


def timer_of_node(case: Case) -> Files | None:
    """Create a timer of the node instead of Python's, and delete what belongs to the old one."""
    node = case.node
    found = thread_timer(node) if node is not None else None
    init = node.method("__init__") if node is not None else None
    if node is None or found is None or init is None or not found.is_certain:
        return None
    module, text = node.module, node.module.text
    made = f"{found.kept} = " if found.kept else ""
    new = f"{made}self.create_timer({case.assignment.seconds}, self.{found.method})"
    rows = set(found.rows)
    # the empty line above a method goes with it
    rows |= {n - 1 for n in rows if n - 1 not in rows and _begins_method(module, n)}
    splices = [text.without(row) for row in rows]
    if found.first is not None:
        return case.changed(module, text.swap(found.first, new), *splices)
    last = init.body[-1]
    row = indent_of(text.line(last.lineno)) + new
    if last.lineno == init.lineno or isinstance(last, ast.Return):
        return None
    return case.changed(module, text.before((last.end_lineno or last.lineno) + 1, row), *splices)


def _begins_method(module: Module, line: int) -> bool:
    above = module.text.line(line - 1).strip()
    return not above and module.line(line).startswith("def ")


def daemon(case: Case) -> Files | None:
    """Make a daemon of the thread."""
    node, thread = case.node, _thread(case)
    if node is None or thread is None or any(k.arg == "daemon" for k in thread.call.keywords):
        return None
    module = node.module_of(thread.call)
    last = max((k.value for k in thread.call.keywords), key=module.text.span)
    end = module.text.span(last)[1]
    return case.changed(module, Splice(end, end, ", daemon=True"))


def without_asyncio(case: Case) -> Files | None:
    """Delete the line that sleeps with asyncio, and what it alone needs."""
    module = case.module
    function = function_at(module, case.finding.line) if module is not None else None
    if module is None or not isinstance(function, ast.AsyncFunctionDef):
        return None
    line = module.line(case.finding.line).partition("#")[0].strip()
    looped = any(isinstance(n, ast.While | ast.For) for n in ast.walk(function))
    awaited = any(
        isinstance(n, ast.Await)
        and isinstance(n.value, ast.Call)
        and last_part(dotted(n.value.func)) == function.name
        for n in module.nodes
    )
    if looped or awaited or not (line.startswith("await ") and "sleep(" in line):
        return None
    deleted = lines.deleted(case)
    if deleted is None:
        return None
    after = replace(case, files=deleted)
    awaits = [
        n for n in ast.walk(function) if isinstance(n, ast.Await | ast.AsyncFor | ast.AsyncWith)
    ]
    if len(awaits) == 1 and after.module is not None:
        start = after.module.text.span(function)[0]
        plain = Splice(start, start + len("async "), "")
        if after.module.text.text[start:].startswith("async def "):
            after = replace(case, files=after.changed(after.module, plain) or deleted)
    return lines.without_import(after, "asyncio")


def _thread(case: Case) -> OwnThread | None:
    node = case.node
    found = own_threads(node) if node is not None else []
    return next((t for t in found if t.call.lineno == case.finding.line), None)


def _statement(module: Module, part: ast.AST) -> ast.stmt | None:
    return next((n for n in module.around(part) if isinstance(n, ast.stmt)), None)
