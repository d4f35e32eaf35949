"""The number in a node's source that sets the period of its timer, also through a calculation."""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass

from grader.package.source.budget import known
from grader.package.source.counter import targets_of
from grader.package.source.endless import calls_of_methods
from grader.package.source.module import Function
from grader.package.source.names import called_name, dotted, last_part, own_name
from grader.package.source.node import NodeSource
from grader.package.source.timer import Timer

WORDS = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+")
PARTS_OF_SECOND = {
    "ms": 1e-3, "msec": 1e-3, "msecs": 1e-3, "milli": 1e-3, "millis": 1e-3, "millisec": 1e-3,
    "millisecond": 1e-3, "milliseconds": 1e-3, "us": 1e-6, "usec": 1e-6, "micros": 1e-6,
    "microsecond": 1e-6, "microseconds": 1e-6, "ns": 1e-9, "nsec": 1e-9, "nanos": 1e-9,
    "nanosecond": 1e-9, "nanoseconds": 1e-9, "s": 1.0, "sec": 1.0, "secs": 1.0, "second": 1.0,
    "seconds": 1.0, "min": 60.0, "minute": 60.0, "minutes": 60.0,
}  # fmt: skip
"""The seconds in the units that the names of numbers say."""
RATES = {"rate", "hz", "freq", "frequency", "fps", "bpm"}
UNITS = (1e-3, 1e-6, 1e-9, 1.0)
ENVIRONMENT = ("os.environ.get", "os.getenv", "environ.get", "getenv")
"""What reads a variable of the environment, with its default behind the name."""
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
    is_unit: bool = False
    """Whether it is a number of the calculation that stands for a unit: 1000 in ms / 1000."""

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
    names: tuple[str, ...] = ()

    def origin(self, seconds: float, *, is_unit: bool = False) -> Origin:
        """Return it as what sets a period."""
        return Origin(self.number, seconds, self.power, self.calculation, self.is_integer, is_unit)


class _Unknown(Exception):  # noqa: N818 - no error: the source says no number
    """The value is not known without running the code."""


def timers_of_lines(source: NodeSource) -> list[Timer]:
    """Return the timers whose callback logs, also in a method that it calls; all if none is seen to."""
    return [timer for timer in source.timers if _logs(source, timer.method)] or source.timers


def _logs(source: NodeSource, name: str) -> bool:
    method = source.methods.get(name)
    called = [inner for _, inner in calls_of_methods(source, method)] if method else []
    return any(source.logs(each) for each in (method, *called) if each is not None)


def origin_of(source: NodeSource, period: ast.expr | None) -> Origin | None:
    """Return the only named number that sets a period; None if it is not certain which."""
    found = _searched(source, period)
    return found[0].terms[0].origin(found[1]) if found is not None else None


def wrong_number(source: NodeSource, period: ast.expr | None, wanted: float) -> Origin | None:
    """Return the number that makes a period wrong; None if it is not certain which.

    It is the named number if the calculation fits its unit. Else it can be the number of the
    calculation that is to be a unit: 100 in PERIOD_MS / 100.
    """
    found = _searched(source, period)
    if found is None or is_right(found[1], wanted):
        return None
    (term,), seconds = found[0].terms, found[1]
    units = [literal.origin(seconds, is_unit=True) for literal in found[0].literals]
    units = [
        unit for unit in units if not is_right(float(unit.value), 1) and _is_unit(unit, wanted)
    ]
    named, fits = term.origin(seconds), _fits(term, seconds)
    if fits is False or (fits is None and not named.right(wanted)):
        return units[0] if len(units) == 1 else None
    return named if named.right(wanted) and (fits or not units) else None


def _is_unit(literal: Origin, wanted: float) -> bool:
    """Whether a number of a calculation has to be a unit, so that the period is right."""
    right = float(literal.right(wanted) or 0)
    return any(is_right(right, unit) or is_right(right, 1 / unit) for unit in UNITS)


def _fits(term: _Term, seconds: float) -> bool | None:
    """Whether a calculation makes seconds of a number's unit; None if no name says the unit.

    Of a number without a unit, the calculation has to be one of those that make seconds.
    """
    named = {word.lower() for name in term.names for word in WORDS.findall(name)}
    units = {PARTS_OF_SECOND[word] for word in named if word in PARTS_OF_SECOND}
    number = float(str(term.number.value))
    factor = seconds / number**term.power
    if len(units) > 1 or (units and named & RATES):
        return False
    if units:
        return term.power > 0 and is_right(factor, *units)
    if term.calculation is None:
        return True
    if named & RATES or term.power < 0:
        return term.power < 0 and any(is_right(factor, known) for known in (1.0, 60.0))
    return None if any(is_right(factor, unit) for unit in UNITS) else False


def number_in(value: ast.expr | None) -> float | None:
    """Return the value of a number, or of a product or a fraction of numbers."""
    if isinstance(value, ast.BinOp) and isinstance(value.op, ast.Mult | ast.Div):
        left, right = number_in(value.left), number_in(value.right)
        if not left or not right:
            return None
        return known(left * right if isinstance(value.op, ast.Mult) else left / right)
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
            return known(left * right)
        if right == 0:
            return None
        return known(left // right if isinstance(period.op, ast.FloorDiv) else left / right)
    if isinstance(period, ast.Call) and dotted(period.func) in ENVIRONMENT and period.args[1:]:
        text = period.args[1]
        found = str(text.value) if isinstance(text, ast.Constant) else ""
        return float(found) if re.fullmatch(r"\d{1,9}(\.\d{0,9})?", found) else None
    if isinstance(period, ast.Call) and dotted(period.func) in ("int", "float"):
        inner = seconds_of(source, period.args[0], steps - 1) if len(period.args) == 1 else None
        return float(int(inner)) if inner is not None and dotted(period.func) == "int" else inner
    name = dotted(period)
    kinds = ast.Assign | ast.AnnAssign
    sets = [s for s in source.own_nodes if isinstance(s, kinds) and name in targets_of(s)]
    value = sets[0].value if name and len(sets) == 1 else None
    return seconds_of(source, value, steps - 1) if value is not None else None


def _searched(source: NodeSource, period: ast.expr | None) -> tuple[_Search, float] | None:
    """Return the search for the numbers of a period, and its seconds, if one number has a name."""
    search = _Search(source)
    try:
        seconds = search.value(period) if period is not None else 0.0
    except (_Unknown, ZeroDivisionError, OverflowError):
        return None
    return (search, seconds) if len(search.terms) == 1 and seconds > 0 and known(seconds) else None


class _Search:
    """Follows names and parameters to the numbers that they stand for."""

    def __init__(self, source: NodeSource) -> None:
        self.source = source
        self.terms: list[_Term] = []
        self.literals: list[_Term] = []  # those without a name, in a calculation
        self._given: dict[tuple[Function, str], ast.expr] = {}
        self._steps = 0

    def value(
        self,
        part: ast.expr,
        power: int = 1,
        *,
        named: bool = False,
        inside: ast.expr | None = None,
        kind: str = "",
        names: tuple[str, ...] = (),
    ) -> float:
        """Return the value of an expression, and keep the named numbers in it."""
        self._steps += 1
        if self._steps > MOST_STEPS:
            raise _Unknown
        if isinstance(part, ast.Constant):
            term = _Term(part, power, inside, kind == "integer_value", names)
            return self._number(part, term, kind, named)
        if isinstance(part, ast.BinOp) and isinstance(part.op, ast.Mult | ast.Div) and not kind:
            around = part if named or inside is None or part not in ast.walk(inside) else inside
            left = self.value(part.left, power, inside=around)
            divides = isinstance(part.op, ast.Div)
            right = self.value(part.right, -power if divides else power, inside=around)
            return left / right if divides else left * right
        if isinstance(part, ast.Call) and dotted(part.func) == "float" and len(part.args) == 1:
            return self.value(part.args[0], power, named=named, inside=inside, names=names)
        read, kind = self._read(part, kind)
        names = (*names, *self._words(read))
        found = self._parameter(read) if read is not part else self._named(part)
        found = found or (self._returned(part) if isinstance(part, ast.Call) else None)
        if found is None:
            raise _Unknown
        return self.value(found, power, named=True, inside=inside, kind=kind, names=names)

    def _returned(self, call: ast.Call) -> ast.expr | None:
        """Return what a function of the file or a method returns, if that is all that it does."""
        own = self.source.methods.get(own_name(call.func))
        function = own or self.source.module_of(call).functions.get(dotted(call.func))
        if function is None or (own and own.decorator_list) or call.keywords:
            return None
        body = function.body[1:] if ast.get_docstring(function) else function.body
        names = [argument.arg for argument in function.args.args[1 if own else 0 :]]
        if len(body) != 1 or not isinstance(body[0], ast.Return) or len(names) != len(call.args):
            return None
        self._given |= {(function, n): a for n, a in zip(names, call.args, strict=True)}
        return body[0].value

    def _words(self, read: ast.expr) -> list[str]:
        """Return the name of a variable, or of the parameter that is read."""
        name = _given(read, 0, "name") if isinstance(read, ast.Call) else None
        text = name.value if isinstance(name, ast.Constant) else last_part(dotted(read))
        return [text] if isinstance(text, str) else []

    def _number(self, part: ast.Constant, term: _Term, kind: str, named: bool) -> float:
        if type(part.value) not in (int, float) or type(part.value) is not TYPES.get(
            kind, type(part.value)
        ):
            raise _Unknown
        (self.terms if named else self.literals).append(term)
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
            return self._given.get((scopes[0], named.id))
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
