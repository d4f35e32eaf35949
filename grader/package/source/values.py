"""The value of an expression in setup.py, if it is known without running the file.

Literal strings, lists, tuples and dicts, names assigned once, and `+`, f-strings, `%`,
`str.format` and `os.path.join` of these: anything else is `Computed`, never guessed.
"""

from __future__ import annotations

import ast
import io
import posixpath
import tokenize
from collections import Counter
from dataclasses import dataclass

MOST_STEPS = 20_000
LONGEST = 20_000


@dataclass(frozen=True)
class Text:
    """A string, the line on which it begins, and its literals if it has several.

    Python joins adjacent literals into one string: that is what a missing comma causes.
    """

    value: str
    line: int
    pieces: tuple[tuple[str, int], ...] = ()


@dataclass(frozen=True)
class Listing:
    """A list, tuple or set."""

    items: tuple[Value, ...]
    line: int


@dataclass(frozen=True)
class Table:
    """A dict, in source order."""

    pairs: tuple[tuple[Value, Value], ...]
    line: int

    def get(self, key: str) -> Value | None:
        """Return the value of a key (the last one counts), or None."""
        for name, value in reversed(self.pairs):
            if isinstance(name, Text) and name.value == key:
                return value
        return None

    @property
    def complete(self) -> bool:
        """Whether every key is known."""
        return all(isinstance(name, Text) for name, _ in self.pairs)


@dataclass(frozen=True)
class Computed:
    """A value that is known only by running the code."""

    line: int


Value = Text | Listing | Table | Computed


class Evaluator:
    """Evaluates expressions of one module."""

    def __init__(self, tree: ast.Module, text: str) -> None:
        self._text = text
        self._steps = 0
        self._open: set[str] = set()
        self._known = _constants(tree)

    def value(self, node: ast.expr) -> Value:
        """Return the value of an expression."""
        self._steps += 1
        computed = Computed(node.lineno)
        if self._steps > MOST_STEPS:
            return computed
        found: Value | None = None
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            found = Text(node.value, node.lineno, self._pieces(node))
        elif isinstance(node, ast.Name):
            found = self._name(node)
        elif isinstance(node, ast.List | ast.Tuple | ast.Set):
            found = Listing(tuple(self._items(node.elts)), node.lineno)
        elif isinstance(node, ast.Dict):
            keys = (self.value(k) if k else Computed(node.lineno) for k in node.keys)
            found = Table(tuple(zip(keys, map(self.value, node.values), strict=True)), node.lineno)
        elif isinstance(node, ast.JoinedStr):
            found = self._join("", node.values, node.lineno)
        elif isinstance(node, ast.FormattedValue):
            plain = node.conversion in (-1, ord("s")) and node.format_spec is None
            found = self.value(node.value) if plain else None
        elif isinstance(node, ast.BinOp):
            found = self._operation(node)
        elif isinstance(node, ast.Call):
            found = self._call(node)
        if isinstance(found, Text) and len(found.value) > LONGEST:
            return computed
        return computed if found is None else found

    def _items(self, nodes: list[ast.expr]) -> list[Value]:
        items: list[Value] = []
        for node in nodes:
            if isinstance(node, ast.Starred):
                inner = self.value(node.value)
                items += inner.items if isinstance(inner, Listing) else [Computed(node.lineno)]
            else:
                items.append(self.value(node))
        return items[:LONGEST]

    def _name(self, node: ast.Name) -> Value | None:
        expression = self._known.get(node.id)
        if expression is None or node.id in self._open:
            return None
        self._open.add(node.id)
        found = self.value(expression)
        self._open.remove(node.id)
        return found

    def _operation(self, node: ast.BinOp) -> Value | None:
        left, right = self.value(node.left), self.value(node.right)
        if isinstance(node.op, ast.Add):
            if isinstance(left, Text) and isinstance(right, Text):
                return Text(left.value + right.value, node.lineno)
            if isinstance(left, Listing) and isinstance(right, Listing):
                return Listing((left.items + right.items)[:LONGEST], left.line)
        if isinstance(node.op, ast.Mod) and isinstance(left, Text):
            given = right.items if isinstance(right, Listing) else (right,)
            return _fill(left, "%s", list(given))
        return None

    def _call(self, node: ast.Call) -> Value | None:
        if isinstance(node.func, ast.Name) and node.func.id == "dict" and not node.args:
            pairs = [(k.arg, k.value) for k in node.keywords]
            keys = (Text(a, v.lineno) if a is not None else Computed(v.lineno) for a, v in pairs)
            values_of = (self.value(value) for _, value in pairs)
            return Table(tuple(zip(keys, values_of, strict=True)), node.lineno)
        if node.keywords or not isinstance(node.func, ast.Attribute):
            return None
        values = self._items(node.args)
        if ast.unparse(node.func) in ("os.path.join", "path.join"):
            if values and all(isinstance(v, Text) for v in values):
                joined = posixpath.join(*(v.value for v in values if isinstance(v, Text)))
                return Text(joined, node.lineno)
            return None
        if node.func.attr == "format":
            start = self.value(node.func.value)
            return _fill(start, "{}", values) if isinstance(start, Text) else None
        return None

    def _join(self, start: str, nodes: list[ast.expr], line: int) -> Value | None:
        parts = [self.value(node) for node in nodes]
        if not all(isinstance(part, Text) for part in parts):
            return None
        return Text(start + "".join(p.value for p in parts if isinstance(p, Text)), line)

    def _pieces(self, node: ast.Constant) -> tuple[tuple[str, int], ...]:
        """Return the adjacent literals of a string, if there are several."""
        width = (node.end_col_offset or 0) - node.col_offset
        plain = len(str(node.value).encode("utf-8", "surrogatepass"))
        if node.end_lineno == node.lineno and width == plain + 2:
            return ()  # one literal and its quotes, as most are
        segment = ast.get_source_segment(self._text, node)
        self._steps += 200
        pieces = []
        try:
            for token in tokenize.generate_tokens(io.StringIO(f"({segment})").readline):
                if token.type == tokenize.STRING:
                    literal = ast.literal_eval(token.string)
                    pieces.append((str(literal), node.lineno + token.start[0] - 1))
        except (tokenize.TokenError, SyntaxError, ValueError):
            return ()
        return tuple(pieces) if len(pieces) > 1 else ()


def _fill(start: Text, place: str, values: list[Value]) -> Value | None:
    parts = start.value.split(place)
    texts = [value.value for value in values if isinstance(value, Text)]
    mark = place[0]
    if len(texts) != len(values) or len(parts) != len(texts) + 1 or mark in "".join(parts):
        return None
    filled = "".join(part + text for part, text in zip(parts, [*texts, ""], strict=True))
    return Text(filled, start.line)


def _constants(tree: ast.Module) -> dict[str, ast.expr]:
    """Return the names that are assigned once, at module level, and never changed later."""
    bound = Counter(name for node in ast.walk(tree) for name in _binds(node))
    found = {}
    for statement in tree.body:
        if isinstance(statement, ast.Assign) and len(statement.targets) == 1:
            target, value = statement.targets[0], statement.value
        elif isinstance(statement, ast.AnnAssign) and statement.value is not None:
            target, value = statement.target, statement.value
        else:
            continue
        if isinstance(target, ast.Name) and bound[target.id] == 1:
            found[target.id] = value
    return found


def _binds(node: ast.AST) -> list[str]:
    """Return the names that a node assigns, or whose value it changes."""
    if isinstance(node, ast.Name):
        return [] if isinstance(node.ctx, ast.Load) else [node.id]
    if isinstance(node, ast.arg):
        return [node.arg]
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        return [node.name]
    if isinstance(node, ast.alias):
        return [(node.asname or node.name).partition(".")[0]]
    if isinstance(node, ast.ExceptHandler) and node.name:
        return [node.name]
    if isinstance(node, ast.Subscript | ast.Attribute):
        changed = _changed(node)
        return [changed] if changed else []
    return []


def _changed(node: ast.Subscript | ast.Attribute) -> str:
    """Return the name whose value this changes: `name[…] = `, or `name.append` and the like."""
    changes = ("append", "extend", "insert", "update", "pop", "remove", "clear", "setdefault")
    if not isinstance(node.value, ast.Name):
        return ""
    if isinstance(node, ast.Attribute):
        return node.value.id if node.attr in changes else ""
    return "" if isinstance(node.ctx, ast.Load) else node.value.id
