"""Fixes of an executor: the node that it gets, and what spins it."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.lines import own_lines
from grader.mistakes.fixes.node_order import always_run
from grader.package.edit.files import Files
from grader.package.edit.text import indent_of
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of


@dataclass(frozen=True)
class AddedLate:
    """A statement that spins an executor, and those below it that give it nodes."""

    spin: ast.Expr
    adds: list[ast.Expr]


def executors_of(source: NodeSource) -> set[str]:
    """Return the variables of executors."""
    made = [(n.value, n.targets) for n in source.all_nodes if isinstance(n, ast.Assign)]
    items = [item for n in source.all_nodes if isinstance(n, ast.With) for item in n.items]
    made += [(i.context_expr, [i.optional_vars]) for i in items if i.optional_vars is not None]
    return {
        dotted(target)
        for value, targets in made
        if isinstance(value, ast.Call) and dotted(value.func).endswith("Executor")
        for target in targets
    }


def is_passed(source: NodeSource, name: str) -> bool:
    """Return whether an executor is an argument of a call, which may add nodes to it."""
    given = (a for call, _ in source.calls for a in (*call.args, *(k.value for k in call.keywords)))
    return any(dotted(argument) == name for argument in given)


def called(statement: ast.stmt) -> str:
    """Return the name of the function that a statement only calls."""
    value = statement.value if isinstance(statement, ast.Expr) else None
    return dotted(value.func) if isinstance(value, ast.Call) else ""


def added_late(source: NodeSource) -> AddedLate | None:
    """Return the executor of the entry function that is spun before it gets the node.

    Both are statements that always run, also in a try.
    """
    body = list(always_run(source.main.body)) if source.main is not None else []
    alone = [s for s in body if isinstance(s, ast.Expr)]
    for at, spin in enumerate(alone):
        owner, _, method = called(spin).rpartition(".")
        if method != "spin" or owner not in executors_of(source):
            continue
        adds = [s for s in alone if called(s) == f"{owner}.add_node" and _is_own(source, s)]
        late = [s for s in adds if s in alone[at:]]
        if adds and late == adds and all(_can_move(source, s) for s in adds):
            return AddedLate(spin, adds)
    return None


def _is_own(source: NodeSource, statement: ast.Expr) -> bool:
    """Whether a statement gives the executor the node, or a node that nothing else is known of."""
    given = statement.value.args if isinstance(statement.value, ast.Call) else []
    known = source.node_variables
    return bool(given) and (len(known) != 1 or dotted(given[0]) in known)


def _can_move(source: NodeSource, statement: ast.Expr) -> bool:
    module = source.module_of(statement)
    return len(block_of(module, statement)) > 1 and own_lines(module, statement) is not None


def added_first(case: Case) -> Files | None:
    """Give the executor its nodes above the line that spins it."""
    found = added_late(case.node) if case.node is not None else None
    if case.node is None or found is None or found.spin.lineno != case.finding.line:
        return None
    module = case.node.module_of(found.spin)
    text, indent = module.text, indent_of(module.text.line(found.spin.lineno))
    if any(s.lineno != s.end_lineno for s in found.adds):
        return None
    rows = [indent + text.line(s.lineno).strip() for s in found.adds]
    gone = [text.without(s.lineno) for s in found.adds]
    return case.changed(module, text.before(found.spin.lineno, *rows), *gone)


def spun_by(source: NodeSource, node: str, call: str) -> str:
    """Return the call that spins what another call of spin or spin_once is about."""
    owner = call.rpartition(".")[0]
    own = owner in executors_of(source) and last_part(call) in ("spin", "spin_once")
    return f"{owner}.spin()" if own else f"rclpy.spin({node})"
