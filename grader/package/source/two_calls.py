"""Two calls of the logger, of print or of a helper that each write a part of one line."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.package.edit.text import Splice
from grader.package.source.module import Function, Module
from grader.package.source.names import called_name, dotted
from grader.package.source.node import NodeSource
from grader.package.source.place import blocks_in

LONGEST = 120  # characters of the code that a text shows


@dataclass(frozen=True)
class TwoCalls:
    """The statements that write the text and the number, and the one to write instead."""

    module: Module
    text: ast.Expr
    number: ast.Expr
    written: str
    whole: bool  # / becomes //

    @property
    def splices(self) -> list[Splice]:
        """The change: the line of the text is deleted, the other one logs both."""
        return [
            self.module.text.without(self.text.lineno),
            self.module.text.swap(self.number, self.written),
        ]


def two_calls(source: NodeSource, head: str) -> TwoCalls | None:
    """Return the only two statements of a block that write the text `head` and then a number."""
    found = [
        (source.module, one, other)
        for function in source.own_functions
        if source.module.has(function)
        for block in blocks_in(function)
        for one in block
        for other in block
        if _writes(source, one, head) and _number_of(source, other) is not None
    ]
    if len(found) != 1 or not head.strip():
        return None
    module, text, number = found[0]
    if not isinstance(text, ast.Expr) or not isinstance(number, ast.Expr):
        return None
    return _joined(source, module, text, number, head)


def _joined(
    source: NodeSource, module: Module, text: ast.Expr, number: ast.Expr, head: str
) -> TwoCalls | None:
    code = module.text.code
    value = _number_of(source, number)
    calls = [s.value for s in (number, text) if isinstance(s.value, ast.Call)]
    logs = [call for call in calls if _logs(source, call)]
    row = module.text.line(text.lineno).partition("#")[0].strip()
    alone = text.lineno == text.end_lineno and row == code(text)
    if value is None or not logs or not alone or number.lineno == text.lineno:
        return None
    whole = isinstance(value, ast.BinOp) and isinstance(value.op, ast.Div)
    shown = code(value)
    if isinstance(value, ast.BinOp) and whole:
        shown = f"{code(value.left)} // {code(value.right)}"
    quote = "'" if "'" in code(_given(calls[-1])[0])[:1] else '"'
    written = f"{code(logs[0].func)}({quote}{head}{quote} + str({shown}))"
    if len(written) > LONGEST or "\n" in written or set(head) & set("'\"\\"):
        return None
    return TwoCalls(module, text, number, written, whole)


def _given(call: ast.Call) -> list[ast.expr]:
    """Return the arguments of a call that writes; none if they can mean something else."""
    named = {keyword.arg for keyword in call.keywords}
    return call.args if len(call.args) == 1 and named <= {"end", "flush"} else []


def _call(source: NodeSource, statement: ast.stmt) -> ast.Call | None:
    call = statement.value if isinstance(statement, ast.Expr) else None
    if not isinstance(call, ast.Call) or not _given(call):
        return None
    return call if _logs(source, call) or dotted(call.func) == "print" else None


def _logs(source: NodeSource, call: ast.Call) -> bool:
    """Whether a call is one of the logger, or of a function that logs only what it is given."""
    if source.is_log(call):
        return True
    name = called_name(call)
    found = [n for n in source.all_nodes if isinstance(n, Function) and n.name == name]
    logs = source.logs(found[0]) if len(found) == 1 else []
    names = [a.arg for a in found[0].args.args if a.arg not in ("self", "cls")] if logs else []
    if len(logs) != 1 or not names or len(logs[0].args) != 1:
        return False
    shown = logs[0].args[0]
    if isinstance(shown, ast.Call) and dotted(shown.func) == "str" and len(shown.args) == 1:
        shown = shown.args[0]
    elif isinstance(shown, ast.JoinedStr) and len(shown.values) == 1:
        shown = getattr(shown.values[0], "value", shown)
    alone = len(found[0].body) == len([s for s in found[0].body if not _is_branch(s)])
    return alone and dotted(shown) == names[0]


def _is_branch(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.If | ast.For | ast.While | ast.Try)


def _writes(source: NodeSource, statement: ast.stmt, head: str) -> bool:
    """Whether a statement writes only the text before the number."""
    call = _call(source, statement)
    given = _given(call)[0] if call is not None else None
    value = given.value if isinstance(given, ast.Constant) else None
    return isinstance(value, str) and value.strip().lower() == head.strip().lower()


def _number_of(source: NodeSource, statement: ast.stmt) -> ast.expr | None:
    """Return the value that a statement writes without any text: str(n), f'{n}', '%d' % n, n."""
    call = _call(source, statement)
    given: ast.expr | None = _given(call)[0] if call is not None else None
    if isinstance(given, ast.Call) and dotted(given.func) == "str" and len(given.args) == 1:
        given = given.args[0]
    elif isinstance(given, ast.JoinedStr):
        part = given.values[0] if len(given.values) == 1 else None
        plain = isinstance(part, ast.FormattedValue) and part.conversion == -1
        given = part.value if isinstance(part, ast.FormattedValue) and plain else None
    elif isinstance(given, ast.BinOp) and isinstance(given.op, ast.Mod):
        form = given.left.value if isinstance(given.left, ast.Constant) else None
        given = given.right if form in ("%d", "%i", "%s") else given
    if isinstance(given, ast.Name | ast.Attribute | ast.Subscript):
        return given
    return given if isinstance(given, ast.BinOp) and not _has_text(given) else None


def _has_text(value: ast.expr) -> bool:
    texts = (ast.JoinedStr,)
    return any(
        isinstance(n, texts) or (isinstance(n, ast.Constant) and isinstance(n.value, str))
        for n in ast.walk(value)
    )
