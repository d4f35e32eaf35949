"""The statements that make or change what a log call shows, followed through the files of a node."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from grader.package.source.counter import declares
from grader.package.source.module import Function
from grader.package.source.names import called_name
from grader.package.source.node import LOG_METHODS, NodeSource

MOST_ROUNDS = 8  # steps from the logged value back to what makes it
SET = ast.Assign | ast.AugAssign | ast.AnnAssign | ast.For
NO_CHANGE = ("print", "create_timer")
TAKING = ("__next__", "pop", "popitem", "popleft", "send")
NOT_VALUES = ("self", "cls", "get_logger", "get_clock", *LOG_METHODS)


def traced(source: NodeSource, call: ast.Call) -> list[ast.stmt]:
    """Return the statements that make or change the values in the text of a log call, in order.

    Helper functions, classes and properties of the files are followed by their names, so that a
    statement can belong to another object with the same attribute.
    """
    trace = _Trace(source)
    around = source.function_around(call)
    for given in (*call.args, *(keyword.value for keyword in call.keywords)):
        trace.read(given, around)
    for _ in range(MOST_ROUNDS):
        before = len(trace.found)
        trace.look()
        if len(trace.found) == before:
            break
    statements = (n for n in trace.found if not isinstance(n, Function))
    own = {n for n in statements if any(part is call for part in ast.walk(n))}
    order = {module: at for at, module in enumerate((*source.modules, *source.beside))}
    found = trace.found - own
    return sorted(found, key=lambda n: (order[source.module_of(n)], n.lineno, n.col_offset))


class _Trace:
    """What is known of the values: attributes by name, variables by function and name."""

    def __init__(self, source: NodeSource) -> None:
        self.source = source
        self.attributes: set[str] = set()
        self.variables: set[tuple[Function | None, str]] = set()
        self.found: set[ast.stmt] = set()
        self.entered: set[Function] = set()
        self.functions: dict[str, list[Function]] = {}
        nodes = [n for module in (*source.modules, *source.beside) for n in module.nodes]
        for node in nodes:
            if isinstance(node, Function):
                self.functions.setdefault(node.name, []).append(node)
        self.statements = [n for n in nodes if isinstance(n, ast.stmt)]

    def read(self, value: ast.AST, around: Function | None) -> None:
        """Note what an expression reads, and enter the functions that it calls."""
        called = {n.func for n in ast.walk(value) if isinstance(n, ast.Call)}
        for node in ast.walk(value):
            if isinstance(node, ast.Call):
                self.enter(called_name(node))
            elif isinstance(node, ast.Attribute) and node not in called:
                if node.attr not in NOT_VALUES:
                    self.attributes.add(node.attr)
                    self.enter(node.attr)
            elif isinstance(node, ast.Name) and node not in called and node.id not in NOT_VALUES:
                self.variables.add((around, node.id))

    def enter(self, name: str) -> None:
        """Read what the functions of this name return."""
        for function in self.functions.get(name, ()) if name != "__init__" else ():
            if function in self.entered:
                continue
            self.entered.add(function)
            for node in ast.walk(function):
                value = node.value if isinstance(node, ast.Return | ast.Yield) else None
                if value is None or self.source.function_around(node) is not function:
                    continue
                self.read(value, function)
                statement = self.statement_around(node)
                if statement is not None:
                    self.found.add(statement)

    def look(self) -> None:
        """Find the statements that set or change what is known."""
        for statement in self.statements:
            around = self.source.function_around(statement)
            self.gives(statement, around)
            if isinstance(statement, SET):
                if statement not in self.found and self.sets(statement, around):
                    self.found.add(statement)
                    self.read(_value_of(statement), around)
                elif statement not in self.found and self.takes(statement, around):
                    self.found.add(statement)
            elif statement not in self.found and self.changes(statement, around):
                self.found.add(statement)

    def sets(self, statement: ast.stmt, around: Function | None) -> bool:
        return any(self.knows(target, around) for target in _targets(statement))

    def changes(self, statement: ast.stmt, around: Function | None) -> bool:
        """Whether a call of a statement may change an object: `x.add()`, `next(x)`, `f(x)`."""
        for call in (n for n in _head(statement) if isinstance(n, ast.Call)):
            name = called_name(call)
            if name in LOG_METHODS or name in NO_CHANGE:
                continue
            on = call.func.value if isinstance(call.func, ast.Attribute) else None
            alone = isinstance(statement, ast.Expr) and statement.value is call
            given = (alone and name not in self.functions) or name == "next"
            if alone and on is not None and self.knows(on, around):
                self.enter(name)
                self.found |= {n for f in self.functions.get(name, ()) for n in _sets_in(f)}
                return True
            if given and any(self.knows(part, around) for part in call.args):
                return True
        return False

    def takes(self, statement: ast.stmt, around: Function | None) -> bool:
        """Whether a statement takes a value out of a known object: `y = next(x)`, `y = x.pop()`."""
        for call in (n for n in _head(statement) if isinstance(n, ast.Call)):
            on = call.func.value if isinstance(call.func, ast.Attribute) else None
            parts = call.args if called_name(call) == "next" else [on]
            if called_name(call) not in ("next", *TAKING):
                continue
            if any(part is not None and self.knows(part, around) for part in parts):
                return True
        return False

    def gives(self, statement: ast.stmt, around: Function | None) -> None:
        """Note a call that gives a known parameter of a function its value, and read that value."""
        for call in (n for n in _head(statement) if isinstance(n, ast.Call)):
            for function in self.functions.get(called_name(call), ()):
                names = [a.arg for a in function.args.args if a.arg not in ("self", "cls")]
                known = [name for name in names if (function, name) in self.variables]
                if not known or function is around:
                    continue
                for at, given in enumerate(call.args):
                    if at < len(names) and names[at] in known:
                        self.read(given, around)
                for keyword in call.keywords:
                    if keyword.arg in known:
                        self.read(keyword.value, around)
                self.found.add(statement)
                if len(call.args) + len(call.keywords) < len(names):
                    self.found.add(function)  # (it has a default)

    def knows(self, target: ast.AST, around: Function | None) -> bool:
        """Whether a target, or the object of which it is a part, is one of the known values."""
        while isinstance(target, ast.Subscript | ast.Starred):
            target = target.value
        if isinstance(target, ast.Tuple | ast.List):
            return any(self.knows(part, around) for part in target.elts)
        if isinstance(target, ast.Attribute):
            return target.attr in self.attributes
        if not isinstance(target, ast.Name) or target.id == "self":
            return False
        if (around, target.id) in self.variables:
            return True
        if around is None:  # (of the module or of a class)
            read = target.id in {name for _, name in self.variables}
            return read or target.id in self.attributes
        return declares(around, target.id) and target.id in {n for _, n in self.variables}

    def statement_around(self, node: ast.AST) -> ast.stmt | None:
        if isinstance(node, ast.stmt):
            return node
        around = self.source.module_of(node).around(node)
        return next((n for n in around if isinstance(n, ast.stmt)), None)


def _targets(statement: ast.stmt) -> list[ast.expr]:
    if isinstance(statement, ast.Assign):
        return statement.targets
    if isinstance(statement, ast.AugAssign | ast.AnnAssign | ast.For):
        return [statement.target]
    return []


def _sets_in(function: Function) -> Iterator[ast.stmt]:
    """Yield the statements of a method that set attributes."""
    for node in ast.walk(function):
        if isinstance(node, SET) and any(isinstance(t, ast.Attribute) for t in _targets(node)):
            yield node


def _value_of(statement: SET) -> ast.AST:
    """Return what a statement sets its targets to; the target of a bare annotation."""
    if isinstance(statement, ast.For):
        return statement.iter
    return statement.value if statement.value is not None else statement.target


def _head(statement: ast.stmt) -> Iterator[ast.AST]:
    """Yield the parts of a statement, without the statements in its blocks."""
    waiting: list[ast.AST] = [statement]
    for node in waiting:
        yield node
        waiting += [n for n in ast.iter_child_nodes(node) if not isinstance(n, ast.stmt)]
