"""What of a node's program runs until Ctrl+C, and what only after that."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from grader.package.source.module import Function, Module
from grader.package.source.names import SPINS, called_name, calls_in, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of

LATER = ("signal", "on_shutdown", "register")


def after_spin(source: NodeSource) -> list[ast.stmt]:
    """Return the statements that run only after spin has ended, in order.

    They are those of the entry function, and of a function of the file that it calls to spin.
    """
    main = source.main
    if main is None:
        return []
    spins = [call for call, name in calls_in(main) if last_part(name) in SPINS]
    found: list[ast.stmt] = []
    if not spins:
        for call, _ in calls_in(main):
            inner = _own_function(source, called_name(call))
            inside = [c for c, name in calls_in(inner) if last_part(name) in SPINS] if inner else []
            if inner is not None and inner is not main and inside:
                spins = [call]
                found += _below(source.module_of(inner), inner, inside[-1])
                break
    return [*found, *(_below(source.module_of(main), main, spins[-1]) if spins else [])]


def parts_until_ctrl_c(source: NodeSource) -> set[ast.AST]:
    """Return the parts of the files that can run before spin has ended.

    What is only called by the lines after spin is not among them, nor what nothing calls.
    """
    late = {node for statement in after_spin(source) for node in ast.walk(statement)}
    functions = [node for node in source.all_nodes if isinstance(node, Function)]
    waiting: list[ast.AST] = [f for f in functions if f.name == "__init__" or f is source.main]
    waiting += [module.tree for module in source.modules]
    found: set[ast.AST] = set()
    reached = {node for node in waiting if isinstance(node, Function)}
    while waiting:
        own = set(_own_nodes(waiting.pop())) - late
        found |= own
        kept = {part for node in own for part in _kept_for_later(node)}
        names = {_name_of(node) for node in own - kept}
        new = [f for f in functions if f.name in names and f not in reached]
        reached |= set(new)
        waiting += new
    return found


def _own_nodes(part: ast.AST) -> Iterator[ast.AST]:
    """Yield the parts of a function or a file, without the functions in it."""
    waiting = list(ast.iter_child_nodes(part))
    for node in waiting:
        yield node
        if not isinstance(node, Function):
            waiting += ast.iter_child_nodes(node)


def _kept_for_later(node: ast.AST) -> list[ast.expr]:
    """Return the arguments of a call that keeps them for the end of the program."""
    return node.args if isinstance(node, ast.Call) and called_name(node) in LATER else []


def _name_of(node: ast.AST) -> str:
    if isinstance(node, ast.Name):
        return node.id
    return node.attr if isinstance(node, ast.Attribute) else ""


def _own_function(source: NodeSource, name: str) -> Function | None:
    """Return the only function or method of the files that has a name."""
    named = [n for n in source.own_nodes if isinstance(n, Function) and n.name == name]
    return named[0] if len(named) == 1 else None


def _below(module: Module, function: Function, spin: ast.Call) -> list[ast.stmt]:
    """Return the statements of a function that run after the statement that spins has ended."""
    found: list[ast.stmt] = []
    chain = [part for part in module.around(spin) if isinstance(part, ast.stmt | ast.ExceptHandler)]
    for part in chain:
        if part is function:
            break
        around = module.parents.get(part)
        if isinstance(part, ast.stmt) and not isinstance(around, ast.While | ast.For):
            block = block_of(module, part)
            found += block[block.index(part) + 1 :] if part in block else []
        if isinstance(around, ast.Try) and part in around.body:
            found += [s for handler in around.handlers for s in handler.body] + around.orelse
        if isinstance(around, ast.Try) and part not in around.finalbody:
            found += around.finalbody
    return sorted(dict.fromkeys(found), key=lambda statement: statement.lineno)
