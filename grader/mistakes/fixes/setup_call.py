"""The call of setup() in a setup.py: finds its arguments and adds new ones."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.mistakes.fixes.case import Case
from grader.package.edit.text import SourceText, Splice, indent_of, read_source
from grader.package.source.python import PythonFault, parse_python
from grader.package.source.setup_py import is_setup_call

FILE = "setup.py"


@dataclass(frozen=True)
class SetupCall:
    """The only call of setup() in a file that Python can parse."""

    source: SourceText
    tree: ast.Module
    call: ast.Call

    def argument(self, name: str) -> ast.expr | None:
        """Return the value of a keyword argument, or None."""
        return next((k.value for k in self.call.keywords if k.arg == name), None)

    @property
    def unpacks(self) -> bool:
        """Whether arguments come from elsewhere: setup(**settings), setup(*list)."""
        return bool(self.call.args) or any(k.arg is None for k in self.call.keywords)

    def literal(self, node: ast.expr | None) -> ast.Constant | None:
        """Return the string literal of an expression: in place, or assigned once to a name."""
        if isinstance(node, ast.Name):
            node = self.constant(node.id)
        plain = isinstance(node, ast.Constant) and self.source.literal(node) is not None
        return node if plain and isinstance(node, ast.Constant) else None

    def constant(self, name: str) -> ast.expr | None:
        """Return the value of a name at module level, if it is assigned exactly once."""
        stores = [
            node
            for node in ast.walk(self.tree)
            if isinstance(node, ast.Name) and node.id == name and isinstance(node.ctx, ast.Store)
        ]
        for statement in self.tree.body:
            if isinstance(statement, ast.Assign) and statement.targets == stores:
                return statement.value
        return None

    def text(self, old: ast.Constant, new: str) -> Splice:
        """Return the splice that changes a literal and keeps its quotes."""
        quote = self.source.code(old)[0]
        return self.source.swap(old, f"{quote}{new}{quote}")

    def into_list(self, node: ast.List | ast.Tuple, new: str) -> list[Splice]:
        """Return the splices that append an item to a list, on its own line if the others are."""
        source = self.source
        start, end = source.span(node)
        inner = source.text[start + 1 : end - 1]
        if not node.elts:
            if "\n" not in inner and "\r" not in inner:
                return [Splice(end - 1, end - 1, new)] if not inner.strip() else []
            return self._own_line(node.end_lineno or node.lineno, new, "    ")
        last = node.elts[-1]
        last_end = source.span(last)[1]
        comma = _comma(source.text, last_end, end - 1)
        if comma is None:
            return []
        add_comma = [] if comma else [Splice(last_end, last_end, ",")]
        last_line, close_line = last.end_lineno or last.lineno, node.end_lineno or node.lineno
        if last_line == close_line:
            at = comma + 1 if comma else last_end
            return [Splice(at, at, f" {new}," if comma else f", {new}")]
        indent = indent_of(source.line(node.elts[-1].lineno))
        return [*add_comma, source.before(last_line + 1, f"{indent}{new},")]

    def _own_line(self, close_line: int, new: str, more: str) -> list[Splice]:
        indent = indent_of(self.source.line(close_line))
        if not self.source.line(close_line).lstrip().startswith(("]", ")")):
            return []
        return [self.source.before(close_line, f"{indent}{more}{new},")]

    def new_argument(self, name: str, rows: list[str]) -> list[Splice]:
        """Return the splices that add an argument of several lines to setup()."""
        source, call = self.source, self.call
        close, last = call.end_lineno or call.lineno, call.keywords[-1:] or None
        if self.unpacks or last is None or not source.line(close).lstrip().startswith(")"):
            return []
        value = last[0].value
        comma = _comma(source.text, source.span(value)[1], source.span(call)[1] - 1)
        if comma is None:
            return []
        at = source.span(value)[1]
        indent = indent_of(source.line(last[0].value.lineno)) or "    "
        indent = indent if last[0].lineno != call.lineno else "    "
        written = [f"{indent}{name}={rows[0]}", *(indent + row for row in rows[1:])]
        return [
            *([] if comma else [Splice(at, at, ",")]),
            source.before(close, *written),
        ]


def _comma(text: str, start: int, end: int) -> int | None:
    """Return the position of the comma in a range, 0 if there is none, None if it is unclear."""
    between = text[start:end]
    code = "\n".join(row.partition("#")[0] for row in between.splitlines())
    if code.strip() not in ("", ","):
        return None
    if not code.strip():
        return 0
    first = between.find(",")
    return start + first if "#" not in between[:first] else None


def read_setup_call(case: Case) -> SetupCall | None:
    """Return the call in setup.py; None if there is not exactly one or Python cannot parse it."""
    found = case.files.data(FILE)
    source = read_source(found)
    if found is None or source is None:
        return None
    try:
        tree = parse_python(found).tree
    except PythonFault:
        return None
    calls = [n for n in ast.walk(tree) if isinstance(n, ast.Call) and is_setup_call(n)]
    return SetupCall(source, tree, calls[0]) if len(calls) == 1 else None
