"""Timers of Python (threading.Timer) that repeat because they are started again and again."""

from __future__ import annotations

import ast
from collections.abc import Iterable
from dataclasses import dataclass

from grader.package.source.counter import targets_of
from grader.package.source.imported import full_name, imports
from grader.package.source.module import Function, Module, is_text
from grader.package.source.names import dotted, own_name
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of

TIMER = "threading.Timer"
SET_UP = ("start", "daemon", "setDaemon", "name", "setName")
"""What starts a timer of Python, or sets it up."""


@dataclass(frozen=True)
class ThreadTimer:
    """A timer of Python that repeats, and what a timer of the node makes useless.

    `first` is the statement of __init__ that starts it, None if another function does. `kept` is
    the attribute that other code still uses. `is_certain` says that nothing else has to change.
    """

    call: ast.Call
    method: str
    first: ast.stmt | None
    rows: tuple[int, ...]
    kept: str
    is_certain: bool


def thread_timer(source: NodeSource) -> ThreadTimer | None:
    """Return the timer of Python that repeats; None if there is none."""
    calls = [(call, _method(source, call)) for call in source.calls_of(*_names(source))]
    calls = [(call, name) for call, name in calls if name in source.methods]
    again = [(c, name) for c, name in calls if _is_repeated(source, c, name)]
    if not again or "__init__" not in source.methods:
        return None
    module, name = source.module_of(again[0][0]), again[0][1]
    one = all(method == name for _, method in calls) and len(source.modules) == 1
    useless = _Useless(source, module, name)
    for call, _ in calls:
        useless.add_timer(call)
    useless.add_classes()
    useless.spread()
    first = useless.first
    rows = useless.rows - ({first.lineno} if first is not None else set())
    sure = one and useless.is_certain and not source.timers
    return ThreadTimer(again[0][0], name, first, tuple(sorted(rows)), useless.kept, sure)


def _classes(source: NodeSource) -> list[ast.ClassDef]:
    """Return the classes that are derived from Python's timer."""
    return [
        found
        for module in source.modules
        for found in module.classes
        if any(full_name(module, base) == TIMER for base in found.bases)
    ]


def _names(source: NodeSource) -> set[str]:
    names = {found.name for found in _classes(source)}
    for module in source.modules:
        names |= {bound for bound, full, _ in imports(module) if full == TIMER}
    return names | {"Timer"}


def _method(source: NodeSource, call: ast.Call) -> str:
    """Return the method of the node that a timer of Python calls without arguments; "" if none."""
    derived = dotted(call.func) in {found.name for found in _classes(source)}
    if not derived and full_name(source.module_of(call), call.func) != TIMER:
        return ""
    named = [keyword.value for keyword in call.keywords if keyword.arg == "function"]
    given = call.args[1] if len(call.args) == 2 else named[0] if named else None
    if isinstance(given, ast.Lambda) and isinstance(given.body, ast.Call):
        given = given.body.func if not given.body.args else None
    return own_name(given) if len(call.args) + len(call.keywords) == 2 else ""


def _is_repeated(source: NodeSource, call: ast.Call, name: str) -> bool:
    """Whether the called method starts the timer again, or the timer's own class repeats."""
    if dotted(call.func) in {found.name for found in _classes(source)}:
        return True
    around = source.function_around(call)
    waiting = [name]
    for method in waiting:
        function = source.methods[method]
        if function is around:
            return True
        called = [own_name(n.func) for n in ast.walk(function) if isinstance(n, ast.Call)]
        waiting += [c for c in called if c in source.methods and c not in waiting]
    return False


class _Useless:
    """Collects the statements that are useless with a timer of the node."""

    def __init__(self, source: NodeSource, module: Module, name: str) -> None:
        self.source, self.module, self.name = source, module, name
        self.statements: list[ast.stmt] = []
        self.kept = ""
        self.is_certain = True
        self.init: Function | None = source.methods.get("__init__")

    def add(self, statement: ast.AST | None) -> None:
        """Add a statement of which nothing else is on its lines."""
        if not isinstance(statement, ast.stmt):
            self.is_certain = False
            return
        text, last = self.module.text, statement.end_lineno or statement.lineno
        start, end = text.span(statement)
        before = text.text[text.start_of(statement.lineno) : start].strip()
        after = text.text[end : text.end_of(last)].strip()
        if before or (after and not after.startswith("#")) or not self.module.has(statement):
            self.is_certain = False
        elif statement not in self.statements:
            self.statements.append(statement)

    def add_timer(self, call: ast.Call) -> None:
        """Add what makes, sets up and starts a timer."""
        made = self.module.parents.get(call)
        if isinstance(made, ast.Attribute) and made.attr == "start":
            self.add(self._statement(made))
            return
        names = set(targets_of(made)) if isinstance(made, ast.Assign | ast.AnnAssign) else set()
        self.add(made if names else None)
        function = self.source.function_around(call)
        for name in names:
            for use in self._uses(name, function):
                if not isinstance(use, ast.Attribute):
                    self.is_certain = False
                elif use.attr in SET_UP:
                    self.add(self._statement(use))
                elif use.attr == "cancel" and "." in name:
                    self.kept = name
                else:
                    self.is_certain = False

    def _uses(self, name: str, function: Function | None) -> list[ast.AST | None]:
        """Return what is done with a variable of the function, or with an attribute."""
        within = self.module.nodes if "." in name else list(ast.walk(function or self.module.tree))
        attribute = own_name(ast.parse(name, mode="eval").body)
        found = [
            n
            for n in within
            if isinstance(n, ast.Name | ast.Attribute)
            and isinstance(n.ctx, ast.Load)
            and (
                dotted(n) == name
                or (isinstance(n, ast.Attribute) and attribute and n.attr == attribute)
            )
        ]
        return [self.module.parents.get(n) for n in found]

    def _statement(self, part: ast.AST) -> ast.AST | None:
        """Return the statement that a use is: an assignment to it, or the call of it."""
        around = self.module.parents.get(part)
        if isinstance(around, ast.Call):
            around = self.module.parents.get(around)
        return around if isinstance(around, ast.Expr | ast.Assign) else None

    def add_classes(self) -> None:
        """Add the classes that are derived from Python's timer."""
        for found in _classes(self.source):
            self.add(found)

    def spread(self) -> None:
        """Add the conditions and methods of which nothing is left, and the calls of the latter."""
        for statement in self.statements:
            block = [s for s in block_of(self.module, statement) if not is_text(s)]
            around = self.module.parents.get(statement)
            if any(s not in self.statements for s in block) or around in self.statements:
                continue
            if isinstance(around, ast.If) and not around.orelse:
                self.add(around)
            elif isinstance(around, Function) and around.name not in ("__init__", self.name):
                self.add(around)
                self._add_calls(around.name)
            elif not isinstance(around, ast.Module):
                self.is_certain = False
        starts = (self.init, self.source.main)
        if not self._of_init:
            self._add_calls(self.name, [f for f in starts if f is not None])

    def _add_calls(self, method: str, within: Iterable[ast.AST] = ()) -> None:
        """Add the calls of a method: all of them, or those in some functions."""
        calls = [call for part in within for call in self.source.calls_of(method, within=part)]
        for call in calls if within else self.source.calls_of(method):
            self.add(self.module.parents.get(call))
        used = [n for n in self.module.nodes if isinstance(n, ast.Attribute) and n.attr == method]
        if not within and len(used) != len(self.source.calls_of(method)):
            self.is_certain = False

    @property
    def _of_init(self) -> list[ast.stmt]:
        body = self.init.body if self.init is not None else []
        return sorted((s for s in body if s in self.statements), key=lambda s: s.lineno)

    @property
    def first(self) -> ast.stmt | None:
        """The first of the statements in __init__, if it is one line."""
        found = self._of_init[0] if self._of_init else None
        return found if found is not None and found.lineno == found.end_lineno else None

    @property
    def rows(self) -> set[int]:
        """The lines of the statements, and of an import that only they need."""
        rows = {n for s in self.statements for n in range(s.lineno, (s.end_lineno or 0) + 1)}
        for bound, full, statement in imports(self.module):
            one = isinstance(statement, ast.Import | ast.ImportFrom) and len(statement.names) == 1
            if full.partition(".")[0] != "threading" or not one:
                continue
            used = [n for n in self.module.nodes if isinstance(n, ast.Name) and n.id == bound]
            if all(n.lineno in rows for n in used):
                rows.add(statement.lineno)
        return rows


def row_ranges(rows: tuple[int, ...]) -> str:
    """Return line numbers as text: 2, 13-17, 22."""
    ranges: list[list[int]] = []
    for row in rows:
        if ranges and ranges[-1][-1] == row - 1:
            ranges[-1][1:] = [row]
        else:
            ranges.append([row])
    return ", ".join("-".join(map(str, found)) for found in ranges)
