"""Sorts of changes: taken numbers, parts that join() gets, arguments left out, and other names."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Sequence

from grader.package.edit.text import Splice, indent_of
from grader.package.source.change import Change, Wanted, additions, of_piece
from grader.package.source.counter import targets_of
from grader.package.source.module import Function, Module
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import LOG_METHODS
from grader.package.source.place import block_of

NAMES = ("self.counter", "self.count", "self.count_of_lines")
ITERATORS = ("self.numbers", "self.numbers_", "self.count_up")
LINES = ("next", "__next__")


def _taken(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield the file without a line that takes a number from an iterator, and what uses that number."""
    del wanted, before
    text = module.text
    for node in (n for n in module.nodes if isinstance(n, ast.stmt)):
        if isinstance(node, Function | ast.ClassDef | ast.Return):
            continue
        head = [n for n in _head(node) if isinstance(n, ast.Call)]
        if not any(last_part(dotted(call.func)) in LINES for call in head):
            continue
        names = set(targets_of(node))
        block, gone = block_of(module, node), [node]
        for other in block[block.index(node) + 1 :]:
            if names and names & {dotted(n) for n in ast.walk(other) if isinstance(n, ast.expr)}:
                gone.append(other)
        inside = {n for s in gone for n in ast.walk(s)}
        if any(n not in inside and dotted(n) in names for n in module.nodes if _is_read(n)):
            continue
        rows = [n for s in gone for n in range(s.lineno, (s.end_lineno or s.lineno) + 1)]
        plain = len(gone) < len(block) and len(rows) <= len(set(rows))
        if plain and text.line(node.lineno).strip().startswith(text.code(node).split("\n")[0]):
            lines = f"{rows[0]}-{rows[-1]}" if len(rows) > 1 else ""
            if len(gone) > 1 and rows != list(range(rows[0], rows[-1] + 1)):
                lines = ", ".join(map(str, rows))
            splices = tuple(text.without(row) for row in rows)
            yield Change("taken", node, text.line(node.lineno).strip(), "", splices, lines)


def _is_read(node: ast.AST) -> bool:
    return isinstance(node, ast.Name | ast.Attribute) and isinstance(node.ctx, ast.Load)


def _head(statement: ast.stmt) -> Iterator[ast.AST]:
    """Yield the parts of a statement, without the statements in its blocks and lambdas."""
    waiting: list[ast.AST] = [statement]
    for node in waiting:
        yield node
        waiting += [
            n for n in ast.iter_child_nodes(node) if not isinstance(n, ast.stmt | ast.Lambda)
        ]


def _joined(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield two parts of a list or a tuple as one, and another text between the parts of join()."""
    del wanted, before
    text = module.text
    for node in module.nodes:
        if isinstance(node, ast.List | ast.Tuple):
            for one, other in zip(node.elts, node.elts[1:]):
                both = text.plain_string(one), text.plain_string(other)
                if both[0] is None or both[1] is None or "\n" in text.code_between(one, other):
                    continue
                quote, whole = text.code(one)[-1], both[0] + both[1]
                if quote in whole or "\\" in whole or not whole.isprintable():
                    continue
                start, end = text.span(one)[0], text.span(other)[1]
                new, old = f"{quote}{whole}{quote}", text.code_between(one, other)
                yield Change("joined", one, old, new, (Splice(start, end, new),), text.code(other))
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            made = node.func.value
            if node.func.attr == "join" and text.plain_string(made) is not None:
                quote = text.code(made)[-1]
                for between in ("", " ", ": "):
                    yield _separator(module, node.func, made, f"{quote}{between}{quote}")


def _separator(module: Module, whole: ast.expr, made: ast.expr, new: str) -> Change:
    text = module.text
    rest = text.code(whole)[len(text.code(made)) :]
    splices = (text.swap(made, new),)
    return Change("joined", whole, text.code(whole), f"{new}{rest}", splices)


def _unused(module: Module, names: Sequence[str]) -> str:
    """Return the first of some attributes that the file does not use; "" if it uses them all."""
    used = {dotted(n) for n in module.nodes if isinstance(n, ast.Attribute)}
    return next((name for name in names if name not in used), "")


def _fresh(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield an attribute in place of a call without arguments, whose function counts in a parameter."""
    del before
    text, name = module.text, _unused(module, NAMES)
    functions = {n.name: n for n in module.nodes if isinstance(n, Function)}
    for method in (n for n in module.nodes if isinstance(n, Function)):
        init = _init_beside(module, method)
        for call, called in calls_in(method) if name and init is not None else ():
            function = functions.get(last_part(called))
            if function is None or call.args or call.keywords or init is None:
                continue
            parameter = _counted_parameter(function)
            statement = next((s for s in method.body if call in ast.walk(s)), None)
            if parameter is None or statement is None or not isinstance(statement, ast.Expr):
                continue
            row = text.line(statement.lineno)
            below = f"{indent_of(row)}{name} += {wanted.step}"
            first = init.body[-1]
            start = f"{indent_of(text.line(init.body[0].lineno))}{name} = {wanted.start}"
            splices = (
                text.swap(call, name),
                text.before((statement.end_lineno or statement.lineno) + 1, below),
                text.before(_first_own(init, first), start),
            )
            yield Change("fresh", call, text.code(call), name, splices, parameter)


def _first_own(init: Function, last: ast.stmt) -> int:
    """Return the line below the call of the base's __init__, or of the last statement."""
    for statement in init.body:
        if "super().__init__" in ast.unparse(statement):
            return (statement.end_lineno or statement.lineno) + 1
    return last.lineno


def _init_beside(module: Module, method: Function) -> Function | None:
    """Return __init__ of the class of a method with self."""
    around = module.parents.get(method)
    given = method.args.args
    if not isinstance(around, ast.ClassDef) or not given or given[0].arg != "self":
        return None
    found = [s for s in around.body if isinstance(s, Function) and s.name == "__init__"]
    return found[0] if len(found) == 1 and found[0] is not method else None


def _counted_parameter(function: Function) -> str | None:
    """Return the only parameter with a default, if the function adds to it."""
    given = function.args
    if len(given.defaults) != 1 or given.kwonlyargs or given.vararg or given.kwarg:
        return None
    name = given.args[-1].arg if given.args else ""
    value = given.defaults[0]
    if not isinstance(value, ast.Constant) or type(value.value) is not int:
        return None
    for node in ast.walk(function):
        if name in targets_of(node) and isinstance(node, ast.Assign | ast.AugAssign):
            return name
    return None


def _anew(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield an attribute that is set once in place of an iterator that each call of next() makes."""
    del wanted, before
    text, name = module.text, _unused(module, ITERATORS)
    for method in (n for n in module.nodes if isinstance(n, Function)):
        init = _init_beside(module, method)
        for call, called in calls_in(method) if init is not None else ():
            made = call.args[0] if called == "next" and len(call.args) == 1 else None
            if init is None or not name or not isinstance(made, ast.Call):
                continue
            row = f"{indent_of(text.line(init.body[0].lineno))}{name} = {text.code(made)}"
            splices = (text.swap(made, name), text.before(_first_own(init, init.body[-1]), row))
            yield Change("anew", made, text.code(made), name, splices)


def _given(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield the counter as the argument of a call that leaves out a parameter with a default."""
    del wanted, before
    text = module.text
    functions = {n.name: n for n in module.nodes if isinstance(n, Function)}
    counted = dict.fromkeys(name for n in additions(module) for name in targets_of(n))
    for node in module.nodes:
        if not isinstance(node, ast.Call) or node.args or node.keywords:
            continue
        function = functions.get(last_part(dotted(node.func)))
        if function is None or not function.args.defaults:
            continue
        left_out = function.args.args[-len(function.args.defaults)].arg
        code = text.code(node)
        around = module.parents.get(node)
        kept = set(targets_of(around)) if isinstance(around, ast.Assign) else set()
        for name in [*kept, *counted]:
            if code.endswith("()") and name.startswith("self."):
                yield of_piece(module, "given", node, f"{code[:-1]}{name})", left_out)


def _other_names(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield the name of what counts in place of another name."""
    del wanted, before
    counted = {name: n for n in additions(module) for name in targets_of(n)}
    for node in module.nodes:
        if not isinstance(node, ast.Attribute | ast.Name) or not isinstance(node.ctx, ast.Load):
            continue
        read, around = dotted(node), module.parents.get(node)
        if any(isinstance(n, ast.Call) and _is_unseen(n) for n in module.around(node)):
            continue
        shown = isinstance(around, ast.FormattedValue | ast.BinOp | ast.Tuple | ast.List)
        shown = shown or (isinstance(around, ast.Call) and node in around.args)
        if not read or not shown or read in counted or module.text.code(node) != read:
            continue
        for name in (name for name in counted if name.startswith("self.")):
            yield of_piece(module, "name", node, name, str(counted[name].lineno))


def _is_unseen(call: ast.Call) -> bool:
    """Whether a call logs what the terminal does not show."""
    return last_part(dotted(call.func)) == "debug"


def _one_character(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield a value in place of one of its characters or of a part of it."""
    del wanted, before
    for node in module.nodes:
        if isinstance(node, ast.Subscript) and isinstance(node.value, ast.Call | ast.JoinedStr):
            form = module.text.code(node)[len(module.text.code(node.value)) :]
            yield of_piece(module, "character", node, module.text.code(node.value), form)


def _keys(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield another key of the file in place of one that is read or set."""
    del wanted, before
    found = []
    for node in module.nodes:
        key = node.slice if isinstance(node, ast.Subscript) else None
        if isinstance(node, ast.Call) and last_part(dotted(node.func)) == "get" and node.args:
            key = node.args[0]
        if isinstance(key, ast.Constant) and module.text.plain_string(key) is not None:
            found.append(key)
    codes = dict.fromkeys(map(module.text.code, found))
    for node in sorted(found, key=lambda n: -n.lineno):
        for other in codes:
            if ast.literal_eval(other) != node.value:
                yield of_piece(module, "key", node, other)


def _whole(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield an f-string with the required text and one value in place of all that a logger gets."""
    del before
    text = module.text
    head, found, tail = wanted.lines[0].rpartition(str(wanted.start))
    if not found or set(head + tail) & set("{}'\\"):
        return
    for call, called in calls_in(module.tree):
        given = call.args[0] if len(call.args) == 1 and not call.keywords else None
        made = isinstance(given, ast.JoinedStr | ast.BinOp | ast.Call)
        if last_part(called) not in LOG_METHODS or given is None or not made:
            continue
        if "\n" in text.code(given):
            continue
        values = [
            n for n in ast.walk(given) if isinstance(n, ast.Attribute | ast.Name | ast.Subscript)
        ]
        values = [n for n in values if isinstance(n.ctx, ast.Load)]
        for code in dict.fromkeys(text.code(n) for n in values):
            if code and not set(code) & set("'\"{}\\") and code != "self":
                yield of_piece(module, "whole", given, f"f'{head}{{{code}}}{tail}'")


def _branches(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield one part of a condition without the condition and its other part."""
    del wanted, before
    text = module.text
    for node in module.nodes:
        if isinstance(node, ast.IfExp):
            for part in (node.body, node.orelse):
                yield of_piece(module, "branch", node, text.code(part), text.code(node.test))
        elif isinstance(node, ast.If) and not text.line(node.lineno).lstrip().startswith("elif"):
            last = node.end_lineno or node.lineno
            ends = text.start_of(node.lineno), text.start_of(last) + len(text.line(last))
            indent = indent_of(text.line(node.lineno))
            for block in (node.body, node.orelse) if node.orelse else ():
                kept = block[0]
                if len(block) == 1 and kept.lineno == kept.end_lineno != node.lineno:
                    code = text.code(kept)
                    swap = Splice(*ends, f"{indent}{code}")
                    yield Change("branch", node, "if", code, (swap,), text.code(node.test))


def _repeated(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield a text and a number joined by + in place of a text that * repeats."""
    del wanted, before
    text = module.text
    for node in module.nodes:
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult):
            one, other = text.code(node.left), text.code(node.right)
            yield of_piece(module, "repeated", node, f"{one} + str({other})")


def _list_behind_percent(module: Module, node: ast.BinOp) -> Iterator[Change]:
    """Yield the elements of a list behind % as a tuple, or the only one alone."""
    text, given = module.text, node.right
    if isinstance(given, ast.List) and given.elts and "\n" not in text.code(node):
        parts = [text.code(part) for part in given.elts]
        new = f"({', '.join(parts)})" if len(parts) > 1 else parts[0]
        yield of_piece(module, "listed", given, new, text.code(given))


def _listed(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield the elements of a list or tuple as a text, in place of the list as a text."""
    del wanted, before
    text = module.text
    for node in module.nodes:
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mod):
            yield from _list_behind_percent(module, node)
        if not isinstance(node, ast.Call) or len(node.args) != 1 or node.keywords:
            continue
        given = node.args[0]
        if dotted(node.func) != "str" or not isinstance(given, ast.List | ast.Tuple | ast.Set):
            continue
        strings = [text.plain_string(part) is not None for part in given.elts]
        parts = [
            text.code(part) if plain else f"str({text.code(part)})"
            for part, plain in zip(given.elts, strings)
        ]
        if parts and "\n" not in text.code(node):
            yield of_piece(module, "listed", node, " + ".join(parts), text.code(given))


MORE_SORTS: dict[str, Callable[[Module, Wanted, Sequence[str]], Iterator[Change]]] = {
    "taken": _taken,
    "joined": _joined,
    "fresh": _fresh,
    "anew": _anew,
    "given": _given,
    "name": _other_names,
    "key": _keys,
    "whole": _whole,
    "character": _one_character,
    "branch": _branches,
    "repeated": _repeated,
    "listed": _listed,
}
