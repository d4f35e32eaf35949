"""Fixes of a list in the place of a number, and of a number in the place of a list."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.source.counter import changes_of, logged_counter, targets_of
from grader.package.source.module import Module
from grader.package.source.names import dotted
from grader.package.source.node import NodeSource
from grader.package.source.other_values import adds_plainly
from grader.package.source.place import statement_at


def len_call(module: Module, line: int | None) -> ast.Call | None:
    """Return the only call of len() on a line that gets a name."""
    found = [
        n
        for n in module.nodes
        if isinstance(n, ast.Call)
        and dotted(n.func) == "len"
        and n.lineno <= (line or 0) <= (n.end_lineno or n.lineno)
        and len(n.args) == 1
        and dotted(n.args[0])
    ]
    return found[0] if len(found) == 1 else None


def without_len(module: Module, call: ast.Call) -> str:
    """Return what to write instead of len(): the name, as text where it is added to a text."""
    name, around = dotted(call.args[0]), module.parents.get(call)
    added = isinstance(around, ast.BinOp) and isinstance(around.op, ast.Add)
    other = None
    if isinstance(around, ast.BinOp):
        other = around.left if around.right is call else around.right
    text = isinstance(other, ast.JoinedStr) or module.text.plain_string(other) is not None
    return f"str({name})" if added and text else name


def name_alone(case: Case) -> Files | None:
    """Write the number instead of len() of it."""
    module = case.module
    call = len_call(module, case.finding.line) if module is not None else None
    if module is None or call is None:
        return None
    return case.changed(module, module.text.swap(call, without_len(module, call)))


@dataclass(frozen=True)
class ListCounter:
    """A list that is logged: its name, the statement that sets it, and those that change it."""

    name: str
    start: ast.Assign
    changes: list[ast.stmt]


def list_counter(source: NodeSource) -> ListCounter | None:
    """Return the list that the callback logs as the counter."""
    logged = logged_counter(source)
    if logged is None or source.callback is None:
        return None
    name = logged[1]
    sets = [n for n in source.own_nodes if isinstance(n, ast.Assign) and name in targets_of(n)]
    init = source.methods.get("__init__")
    starts = [n for n in sets if source.function_around(n) is init and _is_list(n.value)]
    if len(starts) != 1 or init is None:
        return None
    changes = [
        n
        for n in ast.walk(source.callback)
        if isinstance(n, ast.Expr | ast.Assign | ast.AugAssign) and _changes(n, name)
    ]
    return ListCounter(name, starts[0], list(changes))


def _is_list(value: ast.expr) -> bool:
    made = isinstance(value, ast.Call) and dotted(value.func) == "list"
    return made or isinstance(value, ast.List)


def _changes(statement: ast.Expr | ast.Assign | ast.AugAssign, name: str) -> bool:
    """Whether a statement appends to the list, or adds to it or to its element."""
    if isinstance(statement, ast.Expr):
        called = dotted(statement.value.func) if isinstance(statement.value, ast.Call) else ""
        return called in (f"{name}.append", f"{name}.extend", f"{name}.insert")
    targets = statement.targets if isinstance(statement, ast.Assign) else [statement.target]
    return any(_base(target) == name for target in targets)


def _base(target: ast.expr) -> str:
    return dotted(target.value if isinstance(target, ast.Subscript) else target)


def number_for_list(case: Case) -> Files | None:
    """Count with a number instead of a list that only grows and is only logged."""
    node = case.node
    found = list_counter(node) if node is not None else None
    if node is None or found is None or len(found.changes) != 1:
        return None
    change, output = found.changes[0], case.assignment.output
    module, parts = node.module_of(found.start), list(ast.walk(change))
    logged = logged_counter(node)
    own = [*parts, *ast.walk(found.start), *(ast.walk(logged[0]) if logged else ())]
    uses = [n for n in node.all_nodes if dotted(n) == found.name and isinstance(n, ast.Attribute)]
    if any(use not in own for use in uses) or not module.has(change):
        return None
    if any(isinstance(n, ast.Subscript) for n in ast.walk(logged[0])) if logged else True:
        return None
    text = module.text
    return case.changed(
        module,
        text.swap(found.start.value, repr(output.start)),
        text.swap(change, f"{found.name} += {output.step}"),
    )


def plain_start(case: Case) -> Files | None:
    """Let the counter begin with the plain number, if each change of it only adds to it."""
    module, written = case.module, str(case.finding.params.get("written", ""))
    statement = statement_at(module, case.finding.line) if module is not None else None
    if module is None or case.node is None or not isinstance(statement, ast.Assign | ast.AnnAssign):
        return None
    name = written.partition(" = ")[0]
    adds = [node for node in changes_of(case.node, name) if node is not statement]
    if name not in targets_of(statement) or not all(adds_plainly(node, name) for node in adds):
        return None
    return case.changed(module, module.text.swap(statement, written)) if adds else None
