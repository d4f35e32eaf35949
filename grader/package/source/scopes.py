"""Where a file gives a name its value, and from which places that value is visible."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterator
from dataclasses import dataclass

from grader.package.source.module import Function, Module

Scope = ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda | ast.ClassDef | ast.expr
"""What has names of its own; a comprehension too."""
COMPREHENSIONS = (ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)


@dataclass(frozen=True)
class Bound:
    """A part of a file that gives a name its value, its line, and the scope; None is the file."""

    part: ast.AST
    line: int
    scope: Scope | None


def scope_of(module: Module, part: ast.AST) -> Scope | None:
    """Return the innermost scope in which a part of the file is evaluated; None for the file.

    What the line of a def or a class evaluates (defaults, types, decorators, bases) is outside of it.
    """
    inner = part
    for around in module.around(part):
        if isinstance(around, Function | ast.ClassDef) and inner in around.body:
            return around
        if isinstance(around, ast.Lambda) and inner is around.body:
            return around
        if isinstance(around, COMPREHENSIONS):
            return around
        inner = around
    return None


def bindings(module: Module, name: str) -> list[Bound]:
    """Return all parts of a file that give a name its value, in the order of the lines."""
    found: list[Bound] = []
    for part in module.nodes:
        if name not in _binds(part):
            continue
        scope = scope_of(module, part)
        if isinstance(part, ast.arg):
            scope = _owner_of(module, part)
        elif isinstance(scope, Function) and _is_global(scope, name):
            scope = None
        found.append(Bound(part, getattr(part, "lineno", 0), scope))
    return sorted(found, key=lambda bound: bound.line)


def _binds(part: ast.AST) -> set[str]:
    """Return the names that a part of a file, without what is in it, gives a value to."""
    if isinstance(part, ast.Name):
        return {part.id} if isinstance(part.ctx, ast.Store) else set()
    if isinstance(part, Function | ast.ClassDef):
        return {part.name}
    if isinstance(part, ast.Import):
        return {alias.asname or alias.name.partition(".")[0] for alias in part.names}
    if isinstance(part, ast.ImportFrom):
        return {alias.asname or alias.name for alias in part.names}
    if isinstance(part, ast.arg):
        return {part.arg}
    return {part.name} if isinstance(part, ast.ExceptHandler) and part.name else set()


def _owner_of(module: Module, argument: ast.arg) -> Scope | None:
    around = (n for n in module.around(argument) if isinstance(n, Function | ast.Lambda))
    return next(around, None)


def _is_global(function: Function, name: str) -> bool:
    return any(isinstance(n, ast.Global) and name in n.names for n in ast.walk(function))


def seen_from(module: Module, scope: Scope | None) -> Iterator[Scope | None]:
    """Yield the scopes whose names are visible in a scope: a class only in its own lines."""
    yield scope
    found = scope
    while found is not None:
        found = scope_of(module, found)
        if not isinstance(found, ast.ClassDef):
            yield found


def use_of(module: Module, line: int | None, name: str) -> ast.Name | None:
    """Return where a line reads a name."""
    for part in module.nodes:
        reads = isinstance(part, ast.Name) and part.id == name and isinstance(part.ctx, ast.Load)
        if isinstance(part, ast.Name) and reads and part.lineno <= (line or 0) <= _end(part):
            return part
    return None


def _end(part: ast.Name) -> int:
    return part.end_lineno or part.lineno


def visible_names(module: Module, line: int | None, name: str) -> set[str]:
    """Return the names that can stand where a line reads a name; all if the place is not known."""
    use = use_of(module, line, name)
    if use is None:
        return {*module.names, *dir(builtins)}
    here = scope_of(module, use)
    scopes = set(seen_from(module, here))
    known = {other for other in module.names if _is_seen(module, other, scopes, use.lineno, here)}
    return known | set(dir(builtins))


def _is_seen(
    module: Module, name: str, scopes: set[Scope | None], line: int, here: Scope | None
) -> bool:
    later = here is None or isinstance(here, ast.ClassDef)
    return any(
        bound.scope in scopes and not (later and bound.scope is here and bound.line > line)
        for bound in bindings(module, name)
    )


def class_of(module: Module, scope: Scope | None) -> tuple[ast.ClassDef, Function] | None:
    """Return the class and the method that a scope belongs to; None if it is in no method."""
    found = scope
    while found is not None:
        around = scope_of(module, found)
        if isinstance(found, Function) and isinstance(around, ast.ClassDef):
            return around, found
        found = around
    return None


def has_self(method: Function) -> bool:
    """Whether the first parameter of a method is self."""
    return [argument.arg for argument in method.args.args[:1]] == ["self"]


def local_of_init(owner: ast.ClassDef | None, name: str) -> ast.Name | None:
    """Return where __init__ of a class sets a variable of its own of that name, and uses it nowhere."""
    body = owner.body if owner is not None else []
    for init in (s for s in body if isinstance(s, Function) and s.name == "__init__"):
        names = [n for n in ast.walk(init) if isinstance(n, ast.Name) and n.id == name]
        if len(names) == 1 and isinstance(names[0].ctx, ast.Store):
            return names[0]
    return None
