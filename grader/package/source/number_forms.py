"""What gives the counter another form in the line than that of a plain integer."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass

from grader.package.edit.text import Splice
from grader.package.source.counter import (
    logged_counter,
    names_given,
    parts_of_callback,
    starts_of,
    targets_of,
)
from grader.package.source.module import Module
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource

IN_F_STRING = re.compile(r"(?<!\{)\{(?P<value>[^{}:!]{1,80})(?:![rsa])?(?P<form>:[^{}]{1,20})\}")
IN_FORMAT = re.compile(r"(?<!\{)\{(?P<value>\w{0,40})(?:![rsa])?(?P<form>:[^{}]{1,20})\}")
IN_PERCENT = re.compile(
    r"(?<!%)(?P<form>%(?:[-+ #0]{0,4}\d{1,3}|[-+ #0]{1,4})?(?:\.\d{1,3})?[diufFeEgGxXo])"
)
PLAIN = ("%d", "%i", "%u")
FILLS = ("zfill", "rjust", "ljust", "center")
FORMS = ("float", "hex", "bin", "oct")
MOST = 4  # steps from a logged name back to the counter


@dataclass(frozen=True)
class NumberForm:
    """A piece of code, what to write for it, and what in it sets the form.

    `part` is "form" for a piece of the text, "start" for the first value and "step" for what is
    added.
    """

    part: str
    module: Module
    line: int
    name: str
    written: str
    form: str
    start: int

    @property
    def splice(self) -> Splice:
        """The change of this piece."""
        return Splice(self.start, self.start + len(self.name), self.written)


def number_forms(source: NodeSource, start: int, step: int) -> list[NumberForm]:
    """Return all that gives the counter another form, first what writes it."""
    logged = logged_counter(source)
    if logged is None:
        return []
    names = _names(source, logged[0]) | {logged[1]}
    found = {(f.module.path, f.start): f for f in _in_texts(source, names)}
    written = list(found.values())
    return [*written, *_starts(source, names, start), *_steps(source, names, step)]


def _names(source: NodeSource, call: ast.Call) -> set[str]:
    """Return the names in a line's text, and in the values of its variables."""
    names = set(names_given(call))
    for _ in range(MOST):
        for part in parts_of_callback(source):
            for node in ast.walk(part):
                if isinstance(node, ast.Assign) and names & set(targets_of(node)):
                    inside = {dotted(n) for n in ast.walk(node.value)}
                    names |= {name for name in inside if name and "(" not in name}
    return names - {"self", "str", "float", "format", "int"}


def _in_texts(source: NodeSource, names: set[str]) -> Iterator[NumberForm]:
    for part in parts_of_callback(source):
        module = source.module_of(part)
        for node in ast.walk(part):
            if isinstance(node, ast.JoinedStr):
                yield from _in_f_string(module, node, names)
            elif isinstance(node, ast.BinOp):
                yield from _in_operation(module, node, names)
                yield from _in_named_text(source, node, names)
            elif isinstance(node, ast.Call):
                yield from _in_call(module, node, names)


def _in_f_string(module: Module, node: ast.JoinedStr, names: set[str]) -> Iterator[NumberForm]:
    first, code = module.text.span(node)[0], module.text.code(node)
    for match in IN_F_STRING.finditer(code):
        value = match["value"]
        if match["form"].startswith(":="):
            continue
        if any(re.search(rf"(?<![\w.]){re.escape(n)}(?!\w)", value) for n in names):
            new = f"{{{value.strip()}}}"
            yield _piece(module, node, match[0], new, match["form"], first + match.start())


def _in_operation(module: Module, node: ast.BinOp, names: set[str]) -> Iterator[NumberForm]:
    text = module.text
    if isinstance(node.op, ast.Mod) and _is_text(node.left) and _has(node.right, names):
        for match in IN_PERCENT.finditer(text.code(node.left)):
            if match[0] not in PLAIN:
                at = text.span(node.left)[0] + match.start()
                yield _piece(module, node, match[0], "%d", match["form"], at)
    one = node.right.value if isinstance(node.right, ast.Constant) else None
    same = isinstance(node.op, ast.Div) or (isinstance(node.op, ast.Mult) and type(one) is float)
    if same and one == 1 and dotted(node.left) in names:
        name = text.code(node)
        form = name.removeprefix(text.code(node.left)).strip()
        yield _piece(module, node, name, text.code(node.left), form, text.span(node)[0])


def _in_named_text(source: NodeSource, node: ast.BinOp, names: set[str]) -> Iterator[NumberForm]:
    """Yield the forms in a text that has a name: FORM = '%2d', and FORM % n."""
    name = last_part(dotted(node.left))
    if not isinstance(node.op, ast.Mod) or not name or not _has(node.right, names):
        return
    given = [
        n.value
        for n in source.all_nodes
        if isinstance(n, ast.Assign) and name in [last_part(dotted(t)) for t in n.targets]
    ]
    if len(given) != 1 or not _is_text(given[0]):
        return
    module = source.module_of(given[0])
    for match in IN_PERCENT.finditer(module.text.code(given[0])):
        if match[0] not in PLAIN:
            at = module.text.span(given[0])[0] + match.start()
            yield _piece(module, given[0], match[0], "%d", match["form"], at)


def _in_call(module: Module, call: ast.Call, names: set[str]) -> Iterator[NumberForm]:
    text, function = module.text, call.func
    name, start = text.code(call), text.span(call)[0]
    if isinstance(function, ast.Attribute) and _has(function.value, names):
        if function.attr in FILLS:
            form = name[len(text.code(function.value)) :].strip()
            yield _piece(module, call, name, text.code(function.value), form, start)
    elif isinstance(function, ast.Attribute) and function.attr == "format":
        if _is_text(function.value) and any(_has(given, names) for given in _given(call)):
            first = text.span(function.value)[0]
            for match in IN_FORMAT.finditer(text.code(function.value)):
                new = f"{{{match['value']}}}"
                yield _piece(module, call, match[0], new, match["form"], first + match.start())
    elif isinstance(function, ast.Name) and call.args and _has(call.args[0], names):
        value = text.code(call.args[0])
        if function.id == "float" and len(call.args) == 1:
            yield _piece(module, call, name, value, "float()", start)
        elif function.id in FORMS and len(call.args) == 1:
            yield _piece(module, call, name, f"str({value})", f"{function.id}()", start)
        elif function.id == "format" and len(call.args) == 2:
            form = text.code(call.args[1])
            yield _piece(module, call, name, f"str({value})", form, start)


def widths_in(module: Module, part: ast.AST) -> Iterator[NumberForm]:
    """Yield what sets a width in a piece of syntax: a place of a text, or a method such as rjust()."""
    for node in ast.walk(part):
        called = node.func if isinstance(node, ast.Call) else None
        if (
            isinstance(node, ast.Call)
            and isinstance(called, ast.Attribute)
            and called.attr in FILLS
        ):
            name, value = module.text.code(node), module.text.code(called.value)
            form, start = name[len(value) :].strip(), module.text.span(node)[0]
            yield _piece(module, node, name, value, form, start)
        inside = isinstance(module.parents.get(node), ast.JoinedStr)
        if not isinstance(node, ast.Constant | ast.JoinedStr) or inside:
            continue
        first, code = module.text.span(node)[0], module.text.code(node)
        if isinstance(node, ast.JoinedStr):
            for match in IN_F_STRING.finditer(code):
                new = f"{{{match['value'].strip()}}}"
                yield _piece(module, node, match[0], new, match["form"], first + match.start())
        if not _is_text(node):
            continue
        for match in IN_FORMAT.finditer(code):
            new = f"{{{match['value']}}}"
            yield _piece(module, node, match[0], new, match["form"], first + match.start())
        for match in IN_PERCENT.finditer(code):
            if match[0] not in PLAIN:
                yield _piece(module, node, match[0], "%d", match["form"], first + match.start())


def _starts(source: NodeSource, names: set[str], start: int) -> Iterator[NumberForm]:
    """Yield the counter's first value if it is a float; only the required one."""
    literals = list(starts_of(source, float).values())
    for node in source.own_nodes:
        if not isinstance(node, ast.Assign | ast.AnnAssign) or node.value is None:
            continue
        made = isinstance(node.value, ast.Call) and _is_float(node.value, start)
        known = any(node.value is value for value in literals) and _is_float(node.value, start)
        function = source.function_around(node)
        of_init = function is source.methods.get("__init__") and names & set(targets_of(node))
        if known or (made and of_init):
            yield _of_statement(source.module_of(node), node, node.value, str(start), "start")


def _is_float(value: ast.AST, number: int) -> bool:
    """Whether an expression is a float of this number: 1.0, float(1), float() for 0."""
    if isinstance(value, ast.Call):
        given = value.args[0] if len(value.args) == 1 else None
        same = isinstance(given, ast.Constant) and given.value == number
        return dotted(value.func) == "float" and (same if value.args else number == 0)
    return isinstance(value, ast.Constant) and type(value.value) is float and value.value == number


def _steps(source: NodeSource, names: set[str], step: int) -> Iterator[NumberForm]:
    """Yield the steps that are floats: n += 1.0, n = n + 1.0."""
    for part in parts_of_callback(source):
        module = source.module_of(part)
        for node in ast.walk(part):
            if not isinstance(node, ast.AugAssign | ast.Assign) or not names & set(
                targets_of(node)
            ):
                continue
            added: ast.expr | None = node.value
            if isinstance(node, ast.Assign):
                total = node.value if isinstance(node.value, ast.BinOp) else None
                is_sum = total is not None and dotted(total.left) in targets_of(node)
                added = total.right if total is not None and is_sum else None
            if added is not None and (_is_float(added, step) or _is_named(source, added, step)):
                yield _of_statement(module, node, added, str(step), "step")


def _is_named(source: NodeSource, value: ast.expr, number: int) -> bool:
    """Whether a value is a name that is set to a float of this number, and to nothing else."""
    name = dotted(value)
    given = [
        node.value
        for node in source.own_nodes
        if isinstance(node, ast.Assign | ast.AnnAssign) and name and name in targets_of(node)
    ]
    return bool(given) and all(v is not None and _is_float(v, number) for v in given)


def _of_statement(
    module: Module, statement: ast.stmt, value: ast.expr, new: str, part: str
) -> NumberForm:
    """Return the piece that is a whole statement with another value."""
    text = module.text
    start, end = text.span(statement)
    first, last = text.span(value)
    written = text.text[start:first] + new + text.text[last:end]
    name, form = text.code(statement), text.code(value)
    return NumberForm(part, module, statement.lineno, name, written, form, start)


def _piece(
    module: Module, node: ast.expr, name: str, written: str, form: str, start: int
) -> NumberForm:
    text = module.text
    last = node.end_lineno or node.lineno
    rows = range(node.lineno, last + 1)
    line = next((row for row in reversed(rows) if text.start_of(row) <= start), node.lineno)
    return NumberForm("form", module, line, name, written, form, start)


def _given(call: ast.Call) -> list[ast.expr]:
    return [*call.args, *(keyword.value for keyword in call.keywords)]


def _is_text(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def _has(node: ast.expr, names: set[str]) -> bool:
    """Whether one of the names is in an expression."""
    return bool(names & {dotted(n) for n in ast.walk(node)})
