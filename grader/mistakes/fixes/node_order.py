"""Fixes of the order of lines in a function."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import indent_of
from grader.package.source.counter import targets_of
from grader.package.source.module import Function, Module
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of, function_at

CLEANUP = ("shutdown", "try_shutdown", "destroy_node")
SPINS = ("spin", "spin_once", "spin_until_future_complete")


def first_use(function: Function, name: str) -> ast.Name | None:
    """Return the first place of a function that reads a variable."""
    uses = [n for n in ast.walk(function) if isinstance(n, ast.Name) and n.id == name]
    reads = [n for n in uses if isinstance(n.ctx, ast.Load)]
    return min(reads, key=lambda n: (n.lineno, n.col_offset), default=None)


def set_after_use(function: Function, name: str) -> ast.Assign | None:
    """Return the line that gives a variable its value, if that is after the first use.

    A line that needs the old value (`n = n + 1`) gives no first value.
    """
    use = first_use(function, name)
    found = [n for n in ast.walk(function) if isinstance(n, ast.Assign) and name in targets_of(n)]
    first = min(found, key=lambda n: n.lineno, default=None)
    if use is None or first is None or first.lineno <= use.lineno:
        return None
    own = [n for n in ast.walk(first.value) if isinstance(n, ast.Name) and n.id == name]
    return None if own else first


def moved_up(case: Case) -> Files | None:
    """Move the line that gives a variable its value to before the statement that uses it."""
    module = case.module
    name = str(case.finding.params.get("name", ""))
    function = function_at(module, case.finding.line) if module is not None else None
    first = set_after_use(function, name) if function is not None else None
    use = first_use(function, name) if function is not None else None
    if module is None or function is None or first is None or use is None:
        return None
    block = block_of(module, first)
    user = next((s for s in function.body if _has(s, use)), None)
    if block is not function.body or user is None or not _is_own_line(module, first):
        return None
    between = function.body[function.body.index(user) : function.body.index(first)]
    needed = {n.id for n in ast.walk(first.value) if isinstance(n, ast.Name)}
    if needed & {target for s in between for n in ast.walk(s) for target in targets_of(n)}:
        return None
    row = module.text.line(first.lineno)
    return case.changed(
        module, module.text.without(first.lineno), module.text.before(user.lineno, row)
    )


def _has(statement: ast.stmt, part: ast.AST) -> bool:
    return any(node is part for node in ast.walk(statement))


def _is_own_line(module: Module, statement: ast.stmt) -> bool:
    """Whether a statement is one whole line, without a comment."""
    return module.text.line(statement.lineno).strip() == module.text.code(statement)


def early_cleanup(source: NodeSource) -> tuple[ast.Expr, ast.stmt] | None:
    """Return the statement of the entry function that cleans up before a later one spins, and that.

    Only statements that always run count; a program that calls rclpy.init() again is right.
    """
    body = list(always_run(source.main.body)) if source.main is not None else []
    spins = [s for s in body if _calls(s, SPINS)]
    for statement in body if spins else []:
        if statement is spins[0]:
            return None
        other = _destroys_other_node(source, statement)
        if isinstance(statement, ast.Expr) and _calls(statement, CLEANUP) and not other:
            between = body[body.index(statement) : body.index(spins[0])]
            return None if any(_calls(s, ("init",)) for s in between) else (statement, spins[0])
    return None


def _destroys_other_node(source: NodeSource, statement: ast.stmt) -> bool:
    """Whether a statement destroys only a node that no executor and no call of spin gets."""
    names = [name for _, name in calls_in(statement) if last_part(name) in CLEANUP]
    owners = {name.rpartition(".")[0] for name in names if last_part(name) == "destroy_node"}
    spun = {dotted(a) for call in source.calls_of(*SPINS, "add_node") for a in call.args}
    known = spun | source.node_variables | {"self", "super()", ""}
    return bool(owners) and len(owners) == len(names) and not owners & known


def always_run(body: list[ast.stmt]) -> Iterator[ast.stmt]:
    """Yield the statements of a block in their order, with those in a try and in its finally."""
    for statement in body:
        if isinstance(statement, ast.Try):
            yield from always_run(statement.body + statement.orelse + statement.finalbody)
        else:
            yield statement


def _calls(statement: ast.stmt, names: tuple[str, ...]) -> bool:
    return any(last_part(name) in names for _, name in calls_in(statement))


def cleaned_up_later(source: NodeSource) -> ast.stmt | None:
    """Return the statement after spin that does the same as the early clean-up."""
    found = early_cleanup(source)
    if found is None or source.main is None or not isinstance(found[0].value, ast.Call):
        return None
    name = dotted(found[0].value.func)
    kind = ("destroy_node",) if name.endswith("destroy_node") else ("shutdown", "try_shutdown")
    body = list(always_run(source.main.body))
    return next((s for s in body[body.index(found[1]) :] if _calls(s, kind)), None)


def cleanup_last(case: Case) -> Files | None:
    """Move the early clean-up behind the statement that spins; remove it if it is there already."""
    node = case.node
    found = early_cleanup(node) if node is not None else None
    if node is None or node.main is None or found is None:
        return None
    early, spin = found
    module, body = node.module_of(early), node.main.body
    text, alone = module.text, len(block_of(module, early)) == 1
    if not _is_own_line(module, early) or not isinstance(early.value, ast.Call):
        return None
    removed = text.swap(early, "pass") if alone else text.without(early.lineno)
    if cleaned_up_later(node) is not None:
        return case.changed(module, removed)
    around = next(s for s in body if _has(s, spin))
    last = around if dotted(early.value.func).endswith("destroy_node") else body[-1]
    row = indent_of(text.line(last.lineno)) + text.code(early)
    below = text.before((last.end_lineno or last.lineno) + 1, row)
    return case.changed(module, removed, below)
