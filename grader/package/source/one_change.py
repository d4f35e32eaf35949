"""The one change of a node's file after which it logs the required lines, worked out from its code."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterator, Sequence

from grader.package.edit.text import Splice, indent_of
from grader.package.source.change import Change, Wanted, additions, of_piece
from grader.package.source.change_fallbacks import FALLBACK_SORTS
from grader.package.source.change_sorts import MORE_SORTS
from grader.package.source.counter import targets_of
from grader.package.source.module import Function, Module
from grader.package.source.names import called_name, calls_in, dotted
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of
from grader.package.source.played import played

TICKS = 12
MOST_TRIED = 150
PLACES = re.compile(r"%[-+ 0-9.]*[a-zA-Z]|\{[^{}]*\}")
SEVERAL = re.compile(r"(?:'[^'\\\n]*'|\"[^\"\\\n]*\")(?: +(?:'[^'\\\n]*'|\"[^\"\\\n]*\"))+")
SHORTEST = 3  # characters of a part of an f-string that is looked for in a line
LETTER_METHODS = ("capitalize", "lower", "lstrip", "rstrip", "strip", "title", "upper")
FILL_METHODS = ("center", "ljust", "rjust", "zfill")
AS_CODE = ("repr", "ascii")
SUM = ast.Add | ast.Sub


def wanted_lines(line: Callable[[int], str], start: int, step: int) -> Wanted:
    """Return what an output wants, for as many callbacks as are worked out."""
    return Wanted([line(k) for k in range(TICKS)], start, step)


def logged_lines(source: NodeSource) -> list[str] | None:
    """Return the lines of the first callbacks; None if they cannot be worked out."""
    if source.module is not source.entry or source.main is None:
        return None
    found = played(source.module.tree, source.main.name, TICKS)
    return [line.text for line in found] if found is not None else None


def changes(source: NodeSource, wanted: Wanted, *sorts: str) -> list[Change]:
    """Return the changes of these sorts that give the required lines, in the order of the sorts."""
    before = logged_lines(source)
    if not before or source.main is None or before == wanted.lines:
        return []
    module, main = source.module, source.main.name
    found: list[Change] = []
    tried = 0
    for sort in sorts:
        for change in SORTS[sort](module, wanted, before):
            tried += 1
            if tried > MOST_TRIED:
                return found
            if _gives(module, main, change, wanted):
                found.append(change)
    return found


def _gives(module: Module, main: str, change: Change, wanted: Wanted) -> bool:
    spliced = module.text.spliced(change.splices)
    try:
        tree = ast.parse(spliced) if spliced is not None else None
    except (SyntaxError, ValueError):
        return False
    lines = played(tree, main, TICKS) if tree is not None else None
    return lines is not None and [line.text for line in lines] == list(wanted.lines)


def _within(
    module: Module, sort: str, whole: ast.stmt | ast.expr, part: ast.expr, new: str
) -> Change:
    """Return the change of a part of a piece of syntax, where the whole piece is shown."""
    text = module.text
    (start, end), (first, last) = text.span(whole), text.span(part)
    written = text.text[start:first] + new + text.text[last:end]
    return Change(sort, whole, text.code(whole), written, (text.swap(part, new),))


# the sorts ---------------------------------------------------------------------------------------


def _texts(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield other texts for the strings of the file, the one that has most of the text first."""
    old, new = before[0], wanted.lines[0]
    strings = [n for n in module.nodes if isinstance(n, ast.Constant) and isinstance(n.value, str)]
    for node in sorted(strings, key=lambda n: -len(str(n.value))):
        if isinstance(module.parents.get(node), ast.JoinedStr):
            yield from _in_f_string(module, node, old, new)
            continue
        value = str(node.value)
        at = old.find(value)
        if value.endswith("\n") and module.text.code(node).count("\\n") == 1:
            yield of_piece(module, "text", node, module.text.code(node).replace("\\n", ""))
        plain = module.text.plain_string(node) is not None
        if not value or not (plain or SEVERAL.fullmatch(module.text.code(node))):
            continue
        for part in PLACES.split(value) if PLACES.search(value) else ():
            yield from _in_format(module, node, part, old, new)
        if old.count(value) != 1:
            continue
        if isinstance(module.parents.get(node), ast.Expr):
            continue
        for start, end, put in _differences(old, new):
            if at <= start and end <= at + len(value):
                text = value[: start - at] + put + value[end - at :]
                quote = module.text.code(node)[-1]
                if quote not in text and "\\" not in text and text.isprintable():
                    yield of_piece(module, "text", node, f"{quote}{text}{quote}")


def _in_format(
    module: Module, node: ast.Constant, part: str, old: str, new: str
) -> Iterator[Change]:
    """Yield other texts for a part of a string with places for values."""
    code, at = module.text.code(node), old.find(part)
    if len(part) < SHORTEST or old.count(part) != 1 or code.count(part) != 1:
        return
    for start, end, put in _differences(old, new):
        text = part[: max(start - at, 0)] + put + part[end - at :]
        fits = at <= start and end <= at + len(part)
        if fits and not set(text) & set("'\"{}%\\") and text.isprintable():
            yield of_piece(module, "text", node, code.replace(part, text))


def _in_f_string(module: Module, part: ast.Constant, old: str, new: str) -> Iterator[Change]:
    """Yield other texts for a part of an f-string."""
    whole, value = module.parents.get(part), str(part.value)
    if not isinstance(whole, ast.JoinedStr):
        return
    code, at = module.text.code(whole), old.find(value)
    if value.endswith("\n") and code.count("\\n") == 1:
        yield of_piece(module, "text", whole, code.replace("\\n", ""))
    if len(value) < SHORTEST or old.count(value) != 1:
        return
    if code.count(value) != 1 or "\\" in code:
        return
    for start, end, put in _differences(old, new):
        text = value[: max(start - at, 0)] + put + value[end - at :]
        fits = at <= start and end <= at + len(value)
        if fits and not set(text) & set("'\"{}\\") and text.isprintable():
            yield of_piece(module, "text", whole, code.replace(value, text))


def _differences(old: str, new: str) -> list[tuple[int, int, str]]:
    """Return what to put in place of which characters, as far back and as far in front as possible."""
    head, tail = _same(old, new), _same(old[::-1], new[::-1])
    short = min(len(old), len(new))
    found = []
    for first, last in ((head, min(tail, short - head)), (min(head, short - tail), tail)):
        found.append((first, len(old) - last, new[first : len(new) - last]))
    return list(dict.fromkeys(found))


def _same(one: str, other: str) -> int:
    """Return the number of characters with which both texts begin."""
    differ = (at for at, (a, b) in enumerate(zip(one, other)) if a != b)
    return next(differ, min(len(one), len(other)))


def _code_forms(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield values without repr(), !r, %r and =."""
    del wanted, before
    text = module.text
    for node in module.nodes:
        if isinstance(node, ast.Call) and dotted(node.func) in AS_CODE and len(node.args) == 1:
            inside, form = text.code(node.args[0]), f"{dotted(node.func)}()"
            yield of_piece(module, "code", node, inside, form)
            yield of_piece(module, "code", node, f"str({inside})", form)
        elif isinstance(node, ast.JoinedStr):
            code, first = text.code(node), text.span(node)[0]
            for match in re.finditer(r"\{([^{}=!]{1,60}?)(\s*=\s*)?(![ra])?\}", code):
                form = (match[2] or match[3] or "").strip()
                new = f"{{{match[1]}}}"
                splice = Splice(first + match.start(), first + match.end(), new)
                if form:
                    yield Change("code", node, match[0], new, (splice,), form)
        elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mod):
            left = node.left if isinstance(node.left, ast.Constant) else None
            if left is not None and "%r" in text.code(left):
                start = text.span(node.left)[0] + text.code(node.left).index("%r")
                yield Change("code", node, "%r", "%s", (Splice(start, start + 2, "%s"),), "%r")


def _firsts(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield the required first number in place of others that a name gets, or that count() gets."""
    del before
    for node in module.nodes:
        if isinstance(node, ast.Assign | ast.AnnAssign) and node.value is not None:
            inside = node.value.values if isinstance(node.value, ast.Dict) else [node.value]
            inside = node.value.elts if isinstance(node.value, ast.List) else inside
            if isinstance(node.value, ast.Call) and dotted(node.value.func) == "dict":
                inside = [keyword.value for keyword in node.value.keywords]
            if isinstance(node.value, ast.List) and wanted.start == 0 and node.value.elts:
                yield _within(module, "first", node, node.value, "[]")
            for part in (part for part in inside if _number(part) is not None):
                yield _within(module, "first", node, part, str(wanted.start))
        elif isinstance(node, ast.Return) and node.value is not None:
            if _number(node.value) is not None:
                yield _within(module, "first", node, node.value, str(wanted.start))
        elif isinstance(node, ast.Call) and called_name(node) == "declare_parameter":
            for part in (part for part in node.args[1:2] if _number(part) is not None):
                yield _within(module, "first", node, part, str(wanted.start))
        elif isinstance(node, ast.Call) and called_name(node) == "count":
            for part in [*node.args[:1], *(k.value for k in node.keywords if k.arg == "start")]:
                yield _within(module, "first", node, part, str(wanted.start))


def _steps(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield the required step in place of others."""
    del before
    for node in module.nodes:
        if isinstance(node, ast.AugAssign) and isinstance(node.op, SUM):
            code = f"{module.text.code(node.target)} += {wanted.step}"
            yield of_piece(module, "step", node, code)
        elif isinstance(node, ast.Assign) and len(node.targets) == 1:
            name, value = dotted(node.targets[0]), node.value
            total = isinstance(value, ast.BinOp) and isinstance(value.op, SUM)
            old = value.left if isinstance(value, ast.BinOp) and total else value
            if name and dotted(old) == name:
                code = module.text.code(node.targets[0])
                new = f"{code} = {code} + {wanted.step}"
                yield of_piece(module, "step", node, new)
        elif isinstance(node, ast.Call) and called_name(node) == "count":
            for part in [*node.args[1:2], *(k.value for k in node.keywords if k.arg == "step")]:
                yield _within(module, "step", node, part, str(wanted.step))


def _number(value: ast.AST) -> int | None:
    """Return the integer that an expression writes: 1, -1, int(1)."""
    if isinstance(value, ast.Call) and dotted(value.func) == "int" and len(value.args) == 1:
        return _number(value.args[0])
    if isinstance(value, ast.UnaryOp) and isinstance(value.op, ast.USub):
        inside = _number(value.operand)
        return -inside if inside is not None else None
    number = value.value if isinstance(value, ast.Constant) else None
    return number if type(number) is int else None


def _doubled(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield the file without one of the statements that add."""
    del wanted, before
    for node in additions(module):
        yield from _without(module, "doubled", node)


def _without(module: Module, sort: str, node: ast.stmt) -> Iterator[Change]:
    text = module.text
    row = text.line(node.lineno).partition("#")[0].strip()
    if len(block_of(module, node)) > 1 and row == text.code(node):
        yield Change(sort, node, text.code(node), "", (text.without(node.lineno),))


def _before(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield the file with an addition below each of the calls that follow it in its block."""
    del wanted, before
    text = module.text
    for node in additions(module):
        block = block_of(module, node)
        row = text.line(node.lineno)
        if row.partition("#")[0].strip() != text.code(node):
            continue
        for other in block[block.index(node) + 1 :]:
            if isinstance(other, ast.Expr) and isinstance(other.value, ast.Call | ast.Yield):
                below = text.before((other.end_lineno or other.lineno) + 1, row)
                splices = (text.without(node.lineno), below)
                yield Change("before", node, text.code(node), str(other.lineno), splices)


def _returned(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield the old value in place of the new one, where a function adds and returns the sum."""
    del wanted, before
    text = module.text
    for node in additions(module):
        block, name = block_of(module, node), next(targets_of(node), "")
        after = block[block.index(node) + 1 :]
        back = after[0] if len(after) == 1 and isinstance(after[0], ast.Return) else None
        value = back.value if isinstance(back, ast.Return) else None
        if back is None or value is None or text.line(back.lineno).strip() != text.code(back):
            continue
        if text.line(node.lineno).partition("#")[0].strip() != text.code(node):
            continue
        kept = "number" if "number" not in module.names else "before"
        target = node.target if isinstance(node, ast.AugAssign) else None
        name = text.code(target) if isinstance(target, ast.Subscript) else name
        spans = [
            text.span(n)
            for n in ast.walk(value)
            if isinstance(n, ast.expr) and text.code(n) == name
        ]
        code, first = text.code(value), text.span(value)[0]
        if (
            len(spans) != 1
            or kept in module.names
            or code[slice(*(s - first for s in spans[0]))] != name
        ):
            continue
        new = code[: spans[0][0] - first] + kept + code[spans[0][1] - first :]
        indent = indent_of(text.line(node.lineno))
        rows = (f"{indent}{kept} = {name}", text.line(node.lineno), f"{indent}return {new}")
        splices = (
            text.without(node.lineno),
            text.before(back.lineno + 1, *rows),
            text.without(back.lineno),
        )
        written = "; ".join([rows[0].strip(), text.code(node), rows[2].strip()])
        yield Change("returned", node, name, written, splices)


def _operations(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield a value in place of a sum, a product or another operation with a number."""
    del wanted, before
    for node in module.nodes:
        if isinstance(node, ast.BinOp) and not isinstance(node.op, ast.Mod):
            counts = _number(node.right) is not None and not _is_in_addition(module, node)
            left, right = module.text.code(node.left), module.text.code(node.right)
            if counts:
                yield of_piece(module, "operation", node, left)
            if isinstance(node.op, ast.Div):
                yield of_piece(module, "operation", node, f"{left} // {right}")


def _is_in_addition(module: Module, node: ast.BinOp) -> bool:
    around = module.parents.get(node)
    return isinstance(around, ast.Assign) and dotted(node.left) in set(targets_of(around))


def _methods(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield a text in place of what a method makes of it, and another method for its letters."""
    del wanted, before
    text = module.text
    for node in module.nodes:
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            whole, form = text.code(node), f".{node.func.attr}()"
            if node.func.attr in (*LETTER_METHODS, *FILL_METHODS):
                inside = text.text[text.span(node)[0] : text.span(node.func.value)[1]]
                inside += ")" * (inside.count("(") - inside.count(")"))
                swap = text.swap(node, inside)
                yield Change("method", node, whole, inside, (swap,), form)
            for other in LETTER_METHODS if node.func.attr in LETTER_METHODS else ():
                made = f"{text.code(node.func.value)}.{other}()"
                if other != node.func.attr and not node.args:
                    yield of_piece(module, "method", node, made, form)


def _digits(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield str(n) in place of chr(ord('0') + n), which is right only for one digit."""
    del wanted, before
    text = module.text
    for node in module.nodes:
        given = node.args[0] if isinstance(node, ast.Call) and len(node.args) == 1 else None
        if not isinstance(node, ast.Call) or dotted(node.func) != "chr":
            continue
        if isinstance(given, ast.BinOp) and isinstance(given.op, ast.Add):
            for part in (given.left, given.right):
                yield of_piece(module, "digit", node, f"str({text.code(part)})")


def _conditions(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield the lines below an `if` without it."""
    del wanted, before
    text = module.text
    for node in module.nodes:
        if not isinstance(node, ast.If) or node.orelse or node.body[0].lineno == node.lineno:
            continue
        old = indent_of(text.line(node.body[0].lineno))
        new = indent_of(text.line(node.lineno))
        starts = [
            text.start_of(number)
            for number in range(node.body[0].lineno, (node.end_lineno or node.lineno) + 1)
            if text.line(number).startswith(old)
        ]
        rows = [text.without(n) for n in range(node.lineno, node.body[0].lineno)]
        splices = (*rows, *(Splice(at, at + len(old), new) for at in starts))
        yield Change("condition", node, ast.unparse(node.test), "", splices)


def _modulos(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield a value in place of its rest of a division."""
    del wanted, before
    text = module.text
    for node in module.nodes:
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mod):
            if isinstance(node.right, ast.Constant | ast.Name | ast.Attribute):
                form = text.code(node.right)
                yield of_piece(module, "modulo", node, text.code(node.left), form)
        elif isinstance(node, ast.AugAssign) and isinstance(node.op, ast.Mod):
            for change in _without(module, "modulo", node):
                form = text.code(node.value)
                yield Change("modulo", node, change.name, "", change.splices, form)


def _logged_twice(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield the file without one of its calls that stand alone in a function."""
    del wanted, before
    for node in module.nodes:
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Call):
            around = module.parents.get(node)
            if isinstance(around, Function) and node.end_lineno == node.lineno:
                yield from _without(module, "logged", node)


def _both_twice(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield the file without a call that stands alone and the addition below it."""
    del wanted, before
    text, added = module.text, set(additions(module))
    for node in module.nodes:
        if not isinstance(node, ast.Expr) or not isinstance(node.value, ast.Call):
            continue
        block = block_of(module, node)
        after = block[block.index(node) + 1 :]
        if not after or after[0] not in added or len(block) == 2 or after[0].lineno <= node.lineno:
            continue
        rows = range(node.lineno, (after[0].end_lineno or 0) + 1)
        splices = tuple(text.without(row) for row in rows)
        lines = f"{rows[0]}-{rows[-1]}"
        yield Change("logged_and_counted", node, text.code(node), "", splices, lines)


def _kept(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield an assignment in place of a call whose result is dropped: `x = x.next()`."""
    del wanted, before
    for node in module.nodes:
        call = node.value if isinstance(node, ast.Expr) else None
        if not isinstance(node, ast.Expr) or not isinstance(call, ast.Call):
            continue
        on = [call.func.value] if isinstance(call.func, ast.Attribute) else []
        for part in (*on, *call.args[:1]):
            name = dotted(part)
            if name and name != "self" and "(" not in name and called_name(call) != "__init__":
                code = module.text.code(node)
                yield of_piece(module, "kept", node, f"{name} = {code}")


def _next_once(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield one call of next() for all those of a function with the same iterator."""
    del wanted, before
    text = module.text
    for function in (n for n in module.nodes if isinstance(n, Function)):
        calls: dict[str, list[ast.Call]] = {}
        for call, name in calls_in(function):
            if name == "next" and len(call.args) == 1 and dotted(call.args[0]):
                calls.setdefault(text.code(call), []).append(call)
        for code, found in calls.items():
            if len(found) < 2 or "number" in module.names or not code.startswith("next("):
                continue
            begin = next(
                s for s in function.body if s.end_lineno and s.end_lineno >= found[0].lineno
            )
            row = f"{indent_of(text.line(begin.lineno))}number = {code}"
            swaps = (text.swap(call, "number") for call in found)
            rows = ", ".join(dict.fromkeys(str(call.lineno) for call in found))
            splices = (text.before(begin.lineno, row), *swaps)
            yield Change("next", found[0], code, f"number = {code}", splices, rows)


def _next_lines(module: Module, wanted: Wanted, before: Sequence[str]) -> Iterator[Change]:
    """Yield the file without a statement that only calls next()."""
    del wanted, before
    for node in module.nodes:
        call = node.value if isinstance(node, ast.Expr) else None
        called = dotted(call.func) if isinstance(call, ast.Call) else ""
        if isinstance(node, ast.Expr) and called == "next":
            yield from _without(module, "next_line", node)


SORTS: dict[str, Callable[[Module, Wanted, Sequence[str]], Iterator[Change]]] = {
    "text": _texts,
    "code": _code_forms,
    "first": _firsts,
    "step": _steps,
    "doubled": _doubled,
    "before": _before,
    "returned": _returned,
    "operation": _operations,
    "modulo": _modulos,
    "method": _methods,
    "digit": _digits,
    "condition": _conditions,
    "logged": _logged_twice,
    "logged_and_counted": _both_twice,
    "kept": _kept,
    "next": _next_once,
    "next_line": _next_lines,
    **MORE_SORTS,
    **FALLBACK_SORTS,
}
