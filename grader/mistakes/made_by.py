"""The lines of a file that make or change the value that a log call shows."""

from __future__ import annotations

import ast

from grader.base.i18n.message import Message, joined, say
from grader.base.shown import shown
from grader.package.source.counter import declares, parts_of_callback
from grader.package.source.module import Function
from grader.package.source.names import called_name
from grader.package.source.node import LOG_METHODS, NodeSource
from grader.report.model import Where

MOST_LINES = 6
MOST_ROUNDS = 8  # steps from the logged value back to what makes it
Named = tuple[Function | str | None, str]
MADE = ast.Assign | ast.AugAssign | ast.AnnAssign | ast.Return
NOT_VALUES = ("self", "cls", "get_logger", "get_clock", *LOG_METHODS)
TEXT_METHODS = (
    *("strip", "lstrip", "rstrip", "replace", "title", "upper", "lower", "capitalize"),
    *("swapcase", "ljust", "rjust", "center", "zfill", "removeprefix", "removesuffix"),
)


def lines_that_make(
    source: NodeSource, where: Where | None, *, only_texts: bool = False
) -> Message | None:
    """Return the lines, with their code, that make or change what is logged at a place.

    If no log call is there, that of the callback is looked at. None if there is none, if no such
    line is known, or if they are too many for a text. With `only_texts`, those without a piece of
    text, and without a method that changes one, are left out.
    """
    call = _log_call(source, where)
    statements = _statements(source, call) if call is not None else set()
    if only_texts:
        statements = {n for n in statements if any(map(_makes_text, ast.walk(n)))}
    places = sorted({(source.module_of(n).path, n.lineno) for n in statements})
    if not 0 < len(places) <= MOST_LINES:
        return None
    here = where.file if where is not None else source.module.path
    alone = {path for path, _ in places} == {here}
    codes = [shown(source.module_at(path).line(line)) for path, line in places]
    texts = [
        say("line {line}: {code}", line=line, code=code)
        if alone
        else say("{path}, line {line}: {code}", path=path, line=line, code=code)
        for (path, line), code in zip(places, codes)
    ]
    return joined(*texts, by="; ")


def _log_call(source: NodeSource, where: Where | None) -> ast.Call | None:
    """Return the log call at a place, else the first one of the callback."""
    calls = [call for part in parts_of_callback(source) for call in source.logs(part)]
    if where is not None and where.line:
        tree = source.module_at(where.file).tree
        calls = [call for call in source.logs(tree) if call.lineno == where.line] or calls
    return calls[0] if calls else None


def _statements(source: NodeSource, call: ast.Call) -> set[ast.stmt]:
    """Return the statements that set what a call reads, and what these read, by their names."""
    nodes = [node for module in source.known_modules for node in module.nodes]
    used = {getattr(n, "attr", getattr(n, "id", "")) for n in nodes} | {"__init__"}
    read, found = _read(source, call), set[ast.stmt]()
    for _ in range(MOST_ROUNDS):
        new = {n for n in nodes if isinstance(n, MADE) and _makes(source, n, read, used)} - found
        if not new:
            break
        found |= new
        read |= {name for statement in new for name in _read(source, statement)}
    return {n for n in found if call not in ast.walk(n)}


def _makes(source: NodeSource, statement: MADE, read: set[Named], used: set[str]) -> bool:
    """Whether a statement sets what is read, or returns it from a function that is called."""
    around = source.function_around(statement)
    if isinstance(statement, ast.Return):
        return around is not None and (".", around.name) in read
    targets = statement.targets if isinstance(statement, ast.Assign) else [statement.target]
    if around is not None and around.name not in used:
        return False
    return any(_read(source, target) & read for target in targets)


def _read(source: NodeSource, part: ast.AST) -> set[Named]:
    """Return what a part names: variables by their function, attributes and functions by "."."""
    names: set[Named] = set()
    for node in ast.walk(part):
        if isinstance(node, ast.Attribute) and node.attr not in NOT_VALUES:
            names.add((".", node.attr))
        elif isinstance(node, ast.Name) and node.id not in NOT_VALUES:
            around = source.function_around(node)
            names.add((around, node.id))
            if around is None or declares(around, node.id) or isinstance(node.ctx, ast.Load):
                names.add((None, node.id))
            if around is None or isinstance(source.module_of(node).parents.get(node), ast.Call):
                names.add((".", node.id))
    return names


def _makes_text(node: ast.AST) -> bool:
    """Whether a part is a text, or a call of a method that makes another text of one."""
    if isinstance(node, ast.Call):
        return called_name(node) in TEXT_METHODS
    return isinstance(node, ast.Constant) and isinstance(node.value, str)
