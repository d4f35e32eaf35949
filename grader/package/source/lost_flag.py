"""A flag that the handler of a signal sets as a variable of its own, beside the one that a loop reads."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.package.source.counter import declares, targets_of
from grader.package.source.imported import full_name
from grader.package.source.module import Function, Module
from grader.package.source.scopes import Scope, bindings, scope_of


@dataclass(frozen=True)
class LostFlag:
    """The handler, the name that it sets, the loop that reads another one, and the word that is missing."""

    handler: Function
    name: str
    loop: ast.While
    word: str


def lost_flag(module: Module) -> LostFlag | None:
    """Return the flag that the only handler of a signal sets in vain; None if there is none."""
    named = [
        call.args[1].id
        for call in module.nodes
        if isinstance(call, ast.Call)
        and full_name(module, call.func) == "signal.signal"
        and len(call.args) == 2
        and isinstance(call.args[1], ast.Name)
    ]
    handlers = [n for n in module.nodes if isinstance(n, Function) and n.name in named]
    if len({*named}) != 1 or len(handlers) != 1:
        return None
    found = (_of_loop(module, handlers[0], loop) for loop in module.nodes)
    return next(filter(None, found), None)


def _of_loop(module: Module, handler: Function, loop: ast.AST) -> LostFlag | None:
    """Look for a flag in the condition of a loop that the handler sets as its own variable."""
    if not isinstance(loop, ast.While):
        return None
    for read in ast.walk(loop.test):
        if not isinstance(read, ast.Name) or declares(handler, read.id):
            continue
        bound = bindings(module, read.id)
        scopes = {one.scope for one in bound if one.scope is not handler}
        own = [one for one in bound if one.scope is handler]
        sets = [s for s in ast.walk(handler) if read.id in targets_of(s)]
        owner = next(iter(scopes)) if len(scopes) == 1 else handler
        if own and sets and _sees(module, loop, owner) and _sees(module, handler, owner):
            word = "global" if owner is None else "nonlocal"
            return LostFlag(handler, read.id, loop, word)
    return None


def _sees(module: Module, part: ast.AST, owner: Scope | None) -> bool:
    """Whether a part of the file is in the scope that has the variable, or the file has it."""
    return owner is None or (isinstance(owner, Function) and scope_of(module, part) is owner)
