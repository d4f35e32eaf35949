"""The number in a node's source that sets the period of its timer, also through a calculation."""

from __future__ import annotations

import ast
import math
from collections.abc import Iterator
from dataclasses import dataclass

from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import called_name, dotted
from grader.package.source.node import NodeSource

READ = ("value", "double_value", "integer_value")
TYPES = {"double_value": float, "integer_value": int}
MOST_STEPS = 12
CLOSE = 1e-6  # a share of the period


@dataclass(frozen=True)
class Origin:
    """A number that a name or a parameter stands for, and what the timer's period is with it.

    The period is proportional to the number (`power` 1), or to its reciprocal (-1). `calculation`
    is the expression that calculates with it; None if the number is the period.
    """

    number: ast.Constant
    seconds: float
    power: int
    calculation: ast.expr | None
    is_integer: bool

    @property
    def value(self) -> int | float:
        """The number."""
        value = self.number.value
        return value if isinstance(value, int | float) else 0

    def right(self, wanted: float) -> str:
        """Return the number with which the period is right; "" if there is none of its type."""
        exact = self.value * (wanted / self.seconds) ** self.power
        if isinstance(self.value, int) and (self.calculation is not None or self.is_integer):
            if math.isclose(exact, round(exact), rel_tol=CLOSE) and round(exact) > 0:
                return str(round(exact))
            if self.is_integer:
                return ""
        written = float(f"{exact:.9g}")
        return repr(written) if 0 < written < math.inf else ""


@dataclass(frozen=True)
class _Term:
    """A number that a name stands for, with the power and the calculation in which it is."""

    number: ast.Constant
    power: int
    calculation: ast.expr | None
    is_integer: bool


class _Unknown(Exception):  # noqa: N818 - no error: the source says no number
    """The value is not known without running the code."""


def origin_of(source: NodeSource, period: ast.expr | None) -> Origin | None:
    """Return the only named number that sets a period; None if it is not certain which."""
    if period is None:
        return None
    search = _Search(source)
    try:
        seconds = search.value(period)
    except (_Unknown, ZeroDivisionError, OverflowError):
        return None
    numbers = {id(term.number) for term in search.terms}
    if len(numbers) != 1 or len(search.terms) != 1 or not 0 < seconds < math.inf:
        return None
    term = search.terms[0]
    return Origin(term.number, seconds, term.power, term.calculation, term.is_integer)


def number_in(value: ast.expr | None) -> float | None:
    """Return the value of a number, or of a product or a fraction of numbers."""
    if isinstance(value, ast.BinOp) and isinstance(value.op, ast.Mult | ast.Div):
        left, right = number_in(value.left), number_in(value.right)
        if not left or not right:
            return None
        return left * right if isinstance(value.op, ast.Mult) else left / right
    if not isinstance(value, ast.Constant) or isinstance(value.value, bool):
        return None
    return float(value.value) if isinstance(value.value, int | float) else None


def is_right(seconds: float | None, wanted: float) -> bool:
    """Whether a period is the wanted one."""
    return seconds is not None and math.isclose(seconds, wanted, rel_tol=CLOSE)


def seconds_of(source: NodeSource, period: ast.expr, steps: int = MOST_STEPS) -> float | None:
    """Return the value of a period, also of a calculation with names; None if it is not known."""
    number = number_in(period)
    if number is not None or steps < 1:
        return number
    if isinstance(period, ast.BinOp) and isinstance(period.op, ast.Mult | ast.Div | ast.FloorDiv):
        left = seconds_of(source, period.left, steps - 1)
        right = seconds_of(source, period.right, steps - 1)
        if left is None or right is None:
            return None
        if isinstance(period.op, ast.Mult):
            return left * right
        if right == 0:
            return None
        return left // right if isinstance(period.op, ast.FloorDiv) else left / right
    if isinstance(period, ast.Call) and dotted(period.func) in ("int", "float"):
        inner = seconds_of(source, period.args[0], steps - 1) if len(period.args) == 1 else None
        return float(int(inner)) if inner is not None and dotted(period.func) == "int" else inner
    name = dotted(period)
    kinds = ast.Assign | ast.AnnAssign
    sets = [s for s in source.own_nodes if isinstance(s, kinds) and name in targets_of(s)]
    value = sets[0].value if name and len(sets) == 1 else None
    return seconds_of(source, value, steps - 1) if value is not None else None


class _Search:
    """Follows names and parameters to the numbers that they stand for."""

    def __init__(self, source: NodeSource) -> None:
        self.source = source
        self.terms: list[_Term] = []
        self._steps = 0

    def value(
        self,
        part: ast.expr,
        power: int = 1,
        *,
        named: bool = False,
        inside: ast.expr | None = None,
        kind: str = "",
    ) -> float:
        """Return the value of an expression, and keep the named numbers in it."""
        self._steps += 1
        if self._steps > MOST_STEPS:
            raise _Unknown
        if isinstance(part, ast.Constant):
            return self._number(
                part, _Term(part, power, inside, kind == "integer_value"), kind, named
            )
        if isinstance(part, ast.BinOp) and isinstance(part.op, ast.Mult | ast.Div) and not kind:
            around = part if named or inside is None or part not in ast.walk(inside) else inside
            left = self.value(part.left, power, inside=around)
            divides = isinstance(part.op, ast.Div)
            right = self.value(part.right, -power if divides else power, inside=around)
            return left / right if divides else left * right
        if isinstance(part, ast.Call) and dotted(part.func) == "float" and len(part.args) == 1:
            return self.value(part.args[0], power, named=named, inside=inside)
        read, kind = self._read(part, kind)
        found = self._parameter(read) if read is not part else self._named(part)
        if found is None:
            raise _Unknown
        return self.value(found, power, named=True, inside=inside, kind=kind)

    def _number(self, part: ast.Constant, term: _Term, kind: str, named: bool) -> float:
        if type(part.value) not in (int, float) or type(part.value) is not TYPES.get(
            kind, type(part.value)
        ):
            raise _Unknown
        self.terms += [term] if named else []
        return float(str(part.value))

    def _read(self, part: ast.expr, kind: str) -> tuple[ast.expr, str]:
        """Return what the value of a parameter is read from, and with which attribute."""
        if isinstance(part, ast.Attribute) and part.attr in READ:
            kind, part = part.attr, part.value
            if isinstance(part, ast.Call) and isinstance(part.func, ast.Attribute):
                part = part.func.value if part.func.attr == "get_parameter_value" else part
        return part, kind

    def _parameter(self, read: ast.expr) -> ast.expr | None:
        """Return the default of a parameter that is read."""
        call = read if isinstance(read, ast.Call) else self._named(read)
        if not isinstance(call, ast.Call) or self.source.calls_of("set_parameters"):
            return None
        if called_name(call) == "declare_parameter":
            return _given(call, 1, "value")
        name = _given(call, 0, "name") if called_name(call) == "get_parameter" else None
        if not isinstance(name, ast.Constant):
            return None
        found = [value for key, value in self._declared() if key == name.value]
        return found[0] if len(found) == 1 else None

    def _declared(self) -> Iterator[tuple[object, ast.expr]]:
        """Yield the names of the parameters and their defaults."""
        for call in self.source.calls_of("declare_parameter"):
            name, value = _given(call, 0, "name"), _given(call, 1, "value")
            if isinstance(name, ast.Constant) and value is not None:
                yield name.value, value
        for call in self.source.calls_of("declare_parameters"):
            rows = _given(call, 1, "parameters")
            for row in rows.elts if isinstance(rows, ast.List | ast.Tuple) else ():
                if isinstance(row, ast.Tuple) and len(row.elts) > 1:
                    name = row.elts[0]
                    if isinstance(name, ast.Constant):
                        yield name.value, row.elts[1]

    def _named(self, named: ast.expr) -> ast.expr | None:
        """Return the value of a variable or an attribute that is set once."""
        if isinstance(named, ast.Name):
            return self._variable(named)
        owner = dotted(named.value) if isinstance(named, ast.Attribute) else ""
        if not isinstance(named, ast.Attribute) or owner not in ("self", *self.source.class_names):
            return None
        stored = [
            node
            for node in self.source.own_nodes
            if isinstance(node, ast.Attribute)
            and isinstance(node.ctx, ast.Store)
            and node.attr == named.attr
        ]
        body = [s for s in self.source.class_body if isinstance(s, ast.Assign | ast.AnnAssign)]
        of_class = [t for s in body for t in _targets(s) if dotted(t) == named.attr]
        return self._set_by([*stored, *of_class])

    def _variable(self, named: ast.Name) -> ast.expr | None:
        module = self.source.module_of(named)
        scopes = [n for n in module.around(named) if isinstance(n, Function)][:1]
        changed = [n for n in module.nodes if isinstance(n, ast.Global | ast.Nonlocal)]
        if any(named.id in node.names for node in changed):
            return None
        if scopes and any(
            a.arg == named.id for a in ast.walk(scopes[0].args) if isinstance(a, ast.arg)
        ):
            return None
        for scope in (*scopes, None):
            stored: list[ast.expr] = [
                node
                for node in module.nodes
                if isinstance(node, ast.Name)
                and isinstance(node.ctx, ast.Store)
                and node.id == named.id
                and self._is_in(node, scope)
            ]
            if stored:
                return self._set_by(stored)
        return None

    def _is_in(self, target: ast.Name, scope: ast.AST | None) -> bool:
        """Whether a target is a variable of a function; of None, one of the module."""
        around = list(self.source.module_of(target).around(target))
        if scope is None:
            return len(around) == 2  # (its statement, and the module)
        return next((n for n in around if isinstance(n, Function)), None) is scope

    def _set_by(self, stored: list[ast.expr]) -> ast.expr | None:
        """Return the value that the only one of these targets gets."""
        if len(stored) != 1:
            return None
        statement = self.source.module_of(stored[0]).parents.get(stored[0])
        if isinstance(statement, ast.Assign | ast.AnnAssign) and stored[0] in _targets(statement):
            return statement.value
        return None


def _targets(statement: ast.Assign | ast.AnnAssign) -> list[ast.expr]:
    return statement.targets if isinstance(statement, ast.Assign) else [statement.target]


def _given(call: ast.Call, place: int, name: str) -> ast.expr | None:
    """Return an argument of a call."""
    if len(call.args) > place:
        return call.args[place]
    return next((k.value for k in call.keywords if k.arg == name), None)
