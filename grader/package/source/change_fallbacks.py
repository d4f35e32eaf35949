"""Changes of any statement of a node's file, for mistakes of which no other sort of change knows."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Sequence

from grader.package.source.change import Change, Wanted, of_piece
from grader.package.source.module import Module
from grader.package.source.names import called_name
from grader.package.source.place import block_of

LEVELS = ("debug", "info", "warn", "warning", "error", "fatal")


def _of_functions(module: Module) -> Iterator[ast.stmt]:
    """Yield the statements in functions that begin and end on one line of their own."""
    for node in module.nodes:
        simple = isinstance(node, ast.Assign | ast.AugAssign | ast.Expr)
        if not isinstance(node, ast.stmt) or not simple or node.lineno != node.end_lineno:
            continue
        inside = any(isinstance(n, ast.FunctionDef) for n in module.around(node))
        if inside and module.line(node.lineno).strip() == module.text.code(node):
            yield node


def _places(node: ast.stmt) -> list[ast.expr]:
    if isinstance(node, ast.AugAssign):
        return [node.target]
    return list(node.targets) if isinstance(node, ast.Assign) else []


def _counted(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield an addition of the step in place of each statement that gives a name a value."""
    del before
    for node in _of_functions(module):
        places = _places(node)
        if len(places) == 1 and isinstance(places[0], ast.Name | ast.Attribute | ast.Subscript):
            code = f"{module.text.code(places[0])} += {wanted.step}"
            yield of_piece(module, "counted", node, code)


def _removed(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield the file without each of its statements."""
    del wanted, before
    for node in _of_functions(module):
        if len(block_of(module, node)) > 1:
            code = module.text.code(node)
            yield Change("removed", node, code, "", (module.text.without(node.lineno),))


def _shown(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield an f-string with each name that gets a value, in place of what is logged."""
    del before
    number = str(wanted.start)
    if wanted.lines[0].count(number) != 1 or any(sign in wanted.lines[0] for sign in "{}\\'\""):
        return
    names = {module.text.code(place) for n in _of_functions(module) for place in _places(n)}
    names = {name for name in names if not any(sign in name for sign in "'\"\\{}")}
    for call in module.nodes:
        if not isinstance(call, ast.Call) or called_name(call) not in LEVELS or not call.args:
            continue
        for name in sorted(names):
            text = wanted.lines[0].replace(number, f"{{{name}}}")
            yield of_piece(module, "shown", call.args[0], f"f'{text}'")


FALLBACK_SORTS: dict[str, Callable[[Module, Wanted, Sequence[str]], Iterator[Change]]] = {
    "counted": _counted,
    "removed": _removed,
    "shown": _shown,
}
