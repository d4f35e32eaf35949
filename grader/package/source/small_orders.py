"""Small changes of statements: one moved, removed or added, or a block without its head."""

from __future__ import annotations

import ast

from grader.package.edit.text import Splice, indent_of
from grader.package.source.change import Change, of_piece
from grader.package.source.endless import goes_on
from grader.package.source.module import Function, Module, is_text
from grader.package.source.names import SPINS, called_name, dotted
from grader.package.source.node import LOG_METHODS, NodeSource
from grader.package.source.place import block_of, blocks_in, first_row, owns_lines
from grader.package.source.small_values import MOST_NAMES, Found, Goal, Sort, counters_of, is_name

SIMPLE = (
    *(ast.Expr, ast.Assign, ast.AugAssign, ast.AnnAssign, ast.Return, ast.Break, ast.Continue),
    *(ast.Delete, ast.Raise, ast.Assert, ast.Global, ast.Nonlocal),
)
HEADED = ast.If | ast.While | ast.For | ast.With
HEADS: dict[type[ast.stmt], str] = {ast.If: "condition", ast.With: "with"}


ENDS = ("shutdown", "try_shutdown", "destroy_node")


def _blocks(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield the lines of a block without its head, and lines moved out of a block."""
    del source, goal
    for node in module.nodes:
        if not isinstance(node, HEADED | ast.Try) or not owns_lines(module, node):
            continue
        if not module.line(node.lineno).startswith("elif"):
            if isinstance(node, HEADED):
                cost = 4 if isinstance(node, ast.If) else 3
                sort = HEADS.get(type(node), "loop")
                branches = isinstance(node, ast.If) and bool(node.orelse)
                yield cost, _only(module, node, node.body, "branches" if branches else sort)
            rest = [] if isinstance(node, ast.With) else node.orelse
            if isinstance(node, ast.If) and rest and module.line(rest[0].lineno)[:4] != "elif":
                yield 5, _only(module, node, rest, "else")
            for block in (node.body, rest):
                yield from _moved_out(module, node, block)


def _only(module: Module, node: ast.stmt, block: list[ast.stmt], sort: str) -> Change:
    """Return the change that leaves of a statement only one of its blocks."""
    text = module.text
    indent, old = indent_of(text.line(node.lineno)), indent_of(text.line(block[0].lineno))
    rows = []
    for row in range(first_row(block[0]), (block[-1].end_lineno or 0) + 1):
        line = text.lines[row - 1]
        rows.append(indent + line[len(old) :] if line.startswith(old) else line)
    start, end = text.start_of(node.lineno), text.start_of((node.end_lineno or 0) + 1)
    return Change(sort, node, module.line(node.lineno), "", (Splice(start, end, "".join(rows)),))


def _moved_out(module: Module, node: ast.stmt, block: list[ast.stmt]) -> Found:
    """Yield a block's statements, each below the statement that the block belongs to."""
    text = module.text
    indent = indent_of(text.line(node.lineno))
    if isinstance(node, ast.While) and goes_on(node):
        return  # (nothing below such a loop runs before Ctrl+C)
    for moved in block:
        if not isinstance(moved, SIMPLE) or isinstance(moved, ast.Break | ast.Continue):
            continue
        if not owns_lines(module, moved):
            continue
        lines = [indent + text.line(row).strip() for row in _rows(moved)]
        gone = tuple(text.without(row) for row in _rows(moved))
        if len(block) == 1:
            gone = (text.swap(moved, "pass"),)
        put = text.before((node.end_lineno or 0) + 1, *lines)
        head = module.line(node.lineno)
        yield 4, Change("out", moved, module.line(moved.lineno), "", (*gone, put), head)


def _order(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield the statements of a block in another order."""
    del source, goal
    text = module.text
    for block in blocks_in(module.tree):
        own = [s for s in block if owns_lines(module, s) and not is_text(s)]
        for at, moved in enumerate(own):
            if isinstance(moved, ast.ClassDef):
                continue
            sort = "moved_lines" if len(_rows(moved)) > 1 else "moved"
            code = [text.line(row) for row in _rows(moved)]
            gone = tuple(text.without(row) for row in _rows(moved))
            for to, other in enumerate(own):
                if to == at + 2 and _waits_above(moved, own[at + 1]):
                    continue  # (it is the line below that moves)
                if to not in (at, at + 1) and not _hides(moved, own[at + 1 : to]):
                    put = text.before(first_row(other), *code)
                    down = to > at and sort == "moved" and isinstance(own[to - 1], SIMPLE)
                    beside = own[to - 1] if down else other
                    kind = "moved_down" if down else sort
                    if to == at - 1 and _waits_above(other, moved):
                        kind = "before_spin"
                    change = Change(
                        kind,
                        moved,
                        module.line(moved.lineno),
                        module.line(beside.lineno),
                        (*gone, put),
                        str(beside.lineno),
                    )
                    yield 3 + (abs(at - to) > 1), change


def _hides(moved: ast.stmt, above: list[ast.stmt]) -> bool:
    """Whether a statement would come below one that spins, where it may never be reached."""
    return any(map(_spins, above)) and not _ends(moved)


def _waits_above(statement: ast.stmt, below: ast.stmt) -> bool:
    """Whether a statement spins, and so keeps the one below it from running, which it does not need."""
    needed = {n.id for n in ast.walk(statement) if isinstance(n, ast.Name)}
    return _spins(statement) and not _ends(below) and not needed & _stored(below)


def calls_under(statement: ast.stmt) -> list[ast.Call]:
    """Return the calls in a statement, those in its blocks too."""
    return [n for n in ast.walk(statement) if isinstance(n, ast.Call)]


def _spins(statement: ast.stmt) -> bool:
    return any(called_name(call) in SPINS for call in calls_under(statement))


def _ends(statement: ast.stmt) -> bool:
    return any(called_name(call) in ENDS for call in calls_under(statement))


def _added(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield the file with a line more: one that counts, or a name that a function may set."""
    text = module.text
    outside = {name for s in module.tree.body for name in _stored(s)}
    for function in (n for n in module.nodes if isinstance(n, Function)):
        first, last = function.body[0], function.body[-1]
        if not owns_lines(module, function) or first.lineno == function.lineno:
            continue
        indent = indent_of(text.line(first.lineno))
        calls = [n for n in ast.walk(function) if isinstance(n, ast.Call)]
        logs = any(called_name(call) in LOG_METHODS for call in calls)
        counted, read = _added_to(function), {dotted(n) for n in ast.walk(function) if is_name(n)}
        for name in (n for n in counters_of(source) if n not in counted):
            if not logs and (name not in read or function.name == "__init__"):
                continue
            line = f"{name} += {goal.step}"
            put = text.before((last.end_lineno or 0) + 1, indent + line)
            cost = 3 if name in read else 5
            yield cost, Change("below", last, module.line(last.lineno), line, (put,))
        names = _stored(function) & outside - {a.arg for a in function.args.args}
        for name in sorted(names)[:MOST_NAMES]:
            put = text.before(first.lineno, f"{indent}global {name}")
            code = module.line(first.lineno)
            yield 4, Change("above", first, code, f"global {name}", (put,))


def _added_to(function: Function) -> set[str]:
    """Return the names that a function adds to."""
    return {dotted(n.target) for n in ast.walk(function) if isinstance(n, ast.AugAssign)}


def _stored(node: ast.AST) -> set[str]:
    """Return the names that a part of a file sets."""
    names = [n for n in ast.walk(node) if isinstance(n, ast.Name)]
    return {n.id for n in names if isinstance(n.ctx, ast.Store)}


def _removed(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield the file without a statement, a decorator, `async`, or a second definition.

    A timer may be right where its callback is not, so that it costs more to leave it out.
    """
    del source, goal
    text = module.text
    for node in module.nodes:
        if isinstance(node, SIMPLE) and not is_text(node) and owns_lines(module, node):
            makes = any(called_name(c).startswith("create_") for c in calls_under(node))
            if len(block_of(module, node)) > 1:
                cost = 3 if isinstance(node, ast.Assert) else 5 + makes
                yield cost, _without(module, node)
            else:
                yield 5 + makes, of_piece(module, "emptied", node, "pass")
        elif isinstance(node, Function | ast.ClassDef):
            kinds = Function | ast.ClassDef
            names = [n.name for n in block_of(module, node) if isinstance(n, kinds)]
            if names.count(node.name) > 1 and owns_lines(module, node):
                yield 3, _without(module, node)
            for decorator in node.decorator_list:
                rows = range(decorator.lineno, (decorator.end_lineno or 0) + 1)
                gone = tuple(text.without(row) for row in rows)
                yield 4, Change("deleted", decorator, "@" + text.code(decorator), "", gone)
            if isinstance(node, ast.AsyncFunctionDef):
                start, _ = text.span(node)
                splice = Splice(start, text.text.find("def", start), "")
                yield 2, Change("value", node, "async def", "def", (splice,))


def _returned(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield functions that return a value as it was before they change it."""
    del source, goal
    text = module.text
    for function in (n for n in module.nodes if isinstance(n, Function)):
        for at, last in enumerate(function.body):
            if not isinstance(last, ast.Return) or last.value is None or not is_name(last.value):
                continue
            code, own = text.code(last.value), function.body[:at]
            changed = [s for s in own if code in {text.code(t) for t in _targets(s)}]
            if len(changed) == 1 and owns_lines(module, changed[0]):
                indent = indent_of(text.line(changed[0].lineno))
                name = "value" if "value" not in module.names else "value_before"
                put = text.before(changed[0].lineno, f"{indent}{name} = {code}")
                new = f"return {name}"
                splices = (put, text.swap(last.value, name))
                yield 2, Change("returned", last, module.line(last.lineno), new, splices, code)


def _gives_itself(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield methods that return the object, where the value of a call is used and they give none."""
    del goal
    text = module.text
    used = {
        called_name(n)
        for other in source.known_modules
        for n in other.nodes
        if isinstance(n, ast.Call) and not isinstance(other.parents.get(n), ast.Expr)
    }
    for function in (n for found in module.classes for n in found.body if isinstance(n, Function)):
        last = function.body[-1]
        gives = any(isinstance(n, ast.Return | ast.Yield) for n in ast.walk(function))
        if gives or function.name not in used or not owns_lines(module, last):
            continue
        put = text.before(
            (last.end_lineno or 0) + 1, indent_of(text.line(last.lineno)) + "return self"
        )
        yield 2, Change("gives_itself", last, function.name, "return self", (put,))


def _targets(statement: ast.stmt) -> list[ast.expr]:
    if isinstance(statement, ast.AugAssign):
        return [statement.target]
    return statement.targets if isinstance(statement, ast.Assign) else []


def _without(module: Module, node: ast.stmt) -> Change:
    gone = tuple(module.text.without(row) for row in _rows(node))
    return Change(
        "deleted_lines" if len(gone) > 1 else "deleted", node, module.line(node.lineno), "", gone
    )


def _rows(node: ast.stmt) -> range:
    return range(first_row(node), (node.end_lineno or node.lineno) + 1)


SORTS: tuple[Sort, ...] = (_blocks, _added, _returned, _gives_itself, _order, _removed)
