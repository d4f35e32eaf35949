"""What a node logs, worked out from its code: a small part of Python, without running any file.

Whatever is not known stands for itself (`UNKNOWN`), and makes what is built with it unknown.
"""

from __future__ import annotations

import ast
import collections
import contextlib
import itertools
import operator
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from grader.package.source.generators import is_plain_generator
from grader.package.source.module import Function
from grader.package.source.named_tuples import is_named_tuple, named_tuple
from grader.package.source.names import dotted, last_part
from grader.package.source.node import LOG_METHODS

MOST_STEPS = 4000
MOST_YIELDED = 16  # values of a generator
MOST_CALLS = 25  # calls inside each other
LONGEST = 500  # characters of a text
LARGEST = 10**9
SHOWN_LEVELS = ("info", "warn", "warning", "error", "fatal")
FORM = re.compile(r"\{\w{0,30}(?:![rsa])?(?::[^{}]{0,8})?\}")
TOO_WIDE = re.compile(r"\d{3}|\*")
TEXT_METHODS = (
    *("center", "capitalize", "format", "join", "ljust", "lower", "lstrip", "replace"),
    *("rjust", "rstrip", "strip", "title", "upper", "zfill"),
)
OPERATORS: Mapping[type[ast.AST], Callable[..., object]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Mod: operator.mod,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
    ast.Not: operator.not_,
}
BUILTINS: Mapping[str, Callable[..., object]] = {
    "str": str,
    "int": int,
    "float": float,
    "bool": bool,
    "repr": repr,
    "ascii": ascii,
    "len": len,
    "abs": abs,
    "round": round,
    "format": format,
    "min": min,
    "max": max,
    "hex": hex,
    "bin": bin,
    "oct": oct,
    "chr": chr,
    "ord": ord,
    "sorted": sorted,
}
COUNTING = ("Counter", "collections.Counter")
ITERATORS = (itertools.count, Iterator)
Scope = tuple[dict[str, object], ...]  # the names, the innermost first
ERRORS = (TypeError, ValueError, ArithmeticError, LookupError, AttributeError, StopIteration)


class UnplayableError(Exception):
    """The code does something that this module does not know."""


class _SpunError(Exception):
    """The node is spun."""


class _EnoughError(Exception):
    """A generator has given enough values."""


class _ReturnedError(Exception):
    def __init__(self, value: object) -> None:
        super().__init__()
        self.value = value


class _Unknown:
    """A value that is not known."""


UNKNOWN = _Unknown()


@dataclass(eq=False)
class _Made:
    """An object of a class of the file."""

    of: ast.ClassDef
    attributes: dict[str, object] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class _Class:
    found: ast.ClassDef


@dataclass(frozen=True, eq=False)
class _Super:
    of: _Made
    after: ast.ClassDef


@dataclass(frozen=True, eq=False)
class _Code:
    """A function, a lambda or a bound method, with the names around it."""

    found: Function | ast.Lambda
    around: Scope
    given: tuple[object, ...] = ()
    owner: ast.ClassDef | None = None


@dataclass(frozen=True)
class _Logger:
    pass


@dataclass(frozen=True)
class _Parameter:
    value: object


@dataclass(frozen=True)
class _Log:
    level: str


@dataclass(frozen=True)
class _Method:
    """A method of a Python value."""

    of: object
    name: str


@dataclass(frozen=True)
class _Named:
    """A name that the file imports, or that Python has."""

    name: str


@dataclass(frozen=True)
class Line:
    """A line that a callback wrote, and where."""

    text: str
    call: ast.Call


def played(
    module: ast.Module, function: str, ticks: int, levels: Sequence[str] = SHOWN_LEVELS
) -> list[Line] | None:
    """Return the lines that the first callbacks of a file's only timer write; None if unknown.

    They are those that are logged with one of the levels.
    """
    try:
        return _Player(module, levels).lines(function, ticks)
    except (UnplayableError, RecursionError, _ReturnedError, _SpunError, *ERRORS):
        return None


class _Player:
    def __init__(self, module: ast.Module, levels: Sequence[str]) -> None:
        self.module = module
        self.levels = levels
        self.names: dict[str, object] = {}
        self.written: list[Line] = []
        self.timers: list[object] = []
        self.steps = 0
        self.depth = 0
        self.ticking = False
        self.classes = {n.name: n for n in module.body if isinstance(n, ast.ClassDef)}
        self.of_class: dict[ast.ClassDef, dict[str, object]] = {}
        self.defaults: dict[ast.expr, object] = {}
        self.parameters: dict[str, object] = {}

    def lines(self, function: str, ticks: int) -> list[Line]:
        for statement in self.module.body:
            if not isinstance(statement, ast.If):  # (the guard)
                self.run([statement], (self.names,))
        try:
            self.call(self.names.get(function, UNKNOWN), [], {})
        except _SpunError:
            pass
        else:
            raise UnplayableError
        if len(self.timers) != 1:
            raise UnplayableError
        self.written, self.ticking = [], True
        for _ in range(ticks):
            self.call(self.timers[0], [], {})
        return self.written

    def step(self) -> None:
        self.steps += 1
        if self.steps > MOST_STEPS:
            raise UnplayableError

    # statements ------------------------------------------------------------------------------

    def run(self, body: Sequence[ast.stmt], scope: Scope) -> None:
        for statement in body:
            self.step()
            self.statement(statement, scope)

    def statement(self, node: ast.stmt, scope: Scope) -> None:
        if not self.defines(node, scope) and not self.assigns(node, scope):
            self.flows(node, scope)

    def defines(self, node: ast.stmt, scope: Scope) -> bool:
        """Run a statement that defines a name; return whether it is one."""
        if isinstance(node, Function):
            self.keep_defaults(node.args, scope)
            scope[0][node.name] = _Code(node, scope)
        elif isinstance(node, ast.ClassDef):
            scope[0][node.name] = _Class(node)
            own: dict[str, object] = {}
            self.of_class[node] = own
            self.run(node.body, (own, *scope))
        elif isinstance(node, ast.Import | ast.ImportFrom):
            before = f"{node.module}." if isinstance(node, ast.ImportFrom) else ""
            for alias in node.names:
                bound = alias.asname or alias.name.partition(".")[0]
                full = alias.name if before or alias.asname else bound
                scope[0][bound] = _Named(f"{before}{full}")
        elif isinstance(node, ast.Global | ast.Nonlocal):
            for name in node.names:
                scope[0][f"{name} is outer"] = True
        else:
            return False
        return True

    def assigns(self, node: ast.stmt, scope: Scope) -> bool:
        """Run an assignment; return whether it is one."""
        if isinstance(node, ast.Assign):
            value = self.value(node.value, scope)
            for target in node.targets:
                self.assign(target, value, scope)
        elif isinstance(node, ast.AnnAssign):
            if node.value is not None:
                self.assign(node.target, self.value(node.value, scope), scope)
        elif isinstance(node, ast.AugAssign):
            old, added = self.value(node.target, scope), self.value(node.value, scope)
            self.assign(node.target, self.operate(node.op, old, added), scope)
        else:
            return False
        return True

    def flows(self, node: ast.stmt, scope: Scope) -> None:
        """Run any other statement."""
        if isinstance(node, ast.Expr):
            self.value(node.value, scope)
        elif isinstance(node, ast.Return):
            raise _ReturnedError(self.value(node.value, scope) if node.value else None)
        elif isinstance(node, ast.If):
            met = self.value(node.test, scope)
            if not _is_plain_or_list(met):
                raise UnplayableError
            self.run(node.body if met else node.orelse, scope)
        elif isinstance(node, ast.While) and " values" in scope[0]:
            while self.met(node.test, scope):
                self.run(node.body, scope)
        elif isinstance(node, ast.While) and not self.ticking:
            self.run(node.body, scope)  # (a loop that spins ends this)
        elif isinstance(node, ast.Try):
            self.run([*node.body, *node.orelse, *node.finalbody], scope)
        elif isinstance(node, ast.With):
            self.run(node.body, scope)
        elif isinstance(node, ast.Assert):
            met = self.value(node.test, scope)
            if not _is_plain_or_list(met) or not met:
                raise UnplayableError
        elif not isinstance(node, ast.Pass | ast.Delete):
            raise UnplayableError

    def met(self, test: ast.expr, scope: Scope) -> bool:
        value = self.value(test, scope)
        if not _is_plain_or_list(value):
            raise UnplayableError
        return bool(value)

    def assign(self, target: ast.expr, value: object, scope: Scope) -> None:
        if isinstance(target, ast.Name):
            places = scope
            if f"{target.id} is outer" in scope[0]:
                places = tuple(s for s in scope[1:] if target.id in s) or (self.names,)
            places[0][target.id] = value
        elif isinstance(target, ast.Attribute):
            of = self.value(target.value, scope)
            if isinstance(of, _Made):
                of.attributes[target.attr] = value
            elif isinstance(of, _Class):
                self.of_class.setdefault(of.found, {})[target.attr] = value
            elif of is not UNKNOWN:
                raise UnplayableError
        elif isinstance(target, ast.Subscript):
            of, key = self.value(target.value, scope), self.value(target.slice, scope)
            if not isinstance(of, list | dict) or not isinstance(key, int | str):
                raise UnplayableError
            self.python(operator.setitem, of, key, value)
        elif isinstance(target, ast.Tuple) and isinstance(value, tuple | list):
            if len(target.elts) != len(value):
                raise UnplayableError
            for part, one in zip(target.elts, value):
                self.assign(part, one, scope)
        else:
            raise UnplayableError

    # expressions -----------------------------------------------------------------------------

    def value(self, node: ast.expr, scope: Scope) -> object:
        self.step()
        if isinstance(node, ast.Constant):
            return node.value
        if isinstance(node, ast.Name):
            found = [s for s in scope if node.id in s]
            return found[0][node.id] if found else _Named(node.id)
        if isinstance(node, ast.Attribute):
            return self.attribute(self.value(node.value, scope), node.attr)
        if isinstance(node, ast.Call):
            return self.called(node, scope)
        if isinstance(node, ast.Lambda):
            self.keep_defaults(node.args, scope)
            return _Code(node, scope)
        if isinstance(node, ast.IfExp):
            met = self.value(node.test, scope)
            if not _is_plain_or_list(met):
                return UNKNOWN
            return self.value(node.body if met else node.orelse, scope)
        if isinstance(node, ast.NamedExpr):
            value = self.value(node.value, scope)
            self.assign(node.target, value, scope)
            return value
        return self.made_of_parts(node, scope)

    def made_of_parts(self, node: ast.expr, scope: Scope) -> object:
        """Return the value of a text, an operation or a list."""
        if isinstance(node, ast.JoinedStr):
            return self.joined([self.value(part, scope) for part in node.values])
        if isinstance(node, ast.FormattedValue):
            return self.formatted(node, scope)
        if isinstance(node, ast.BinOp):
            left, right = self.value(node.left, scope), self.value(node.right, scope)
            return self.operate(node.op, left, right)
        if isinstance(node, ast.UnaryOp):
            return self.operate(node.op, self.value(node.operand, scope))
        if isinstance(node, ast.Compare) and len(node.ops) == 1:
            left, right = self.value(node.left, scope), self.value(node.comparators[0], scope)
            return self.operate(node.ops[0], left, right)
        if isinstance(node, ast.Tuple | ast.List | ast.Dict | ast.Subscript):
            return self.container(node, scope)
        if isinstance(node, ast.GeneratorExp | ast.ListComp):
            return self.comprehended(node, scope)
        if isinstance(node, ast.Yield):
            return self.yielded(node, scope)
        return UNKNOWN

    def container(
        self, node: ast.Tuple | ast.List | ast.Dict | ast.Subscript, scope: Scope
    ) -> object:
        """Return a tuple, a list or a dictionary, or what one has at a place."""
        if isinstance(node, ast.Tuple | ast.List):
            return self.several(node, scope)
        if isinstance(node, ast.Subscript):
            of, key = self.value(node.value, scope), self.value(node.slice, scope)
            if isinstance(node.slice, ast.Slice) and isinstance(of, str):
                ends = [self.value(v, scope) if v else None for v in _ends(node.slice)]
                plain = all(v is None or type(v) is int for v in ends)
                return self.python(operator.getitem, of, slice(*ends)) if plain else UNKNOWN
            known = isinstance(of, list | tuple | dict | str) and isinstance(key, int | str)
            return self.python(operator.getitem, of, key) if known else UNKNOWN
        keys = [self.value(key, scope) if key is not None else UNKNOWN for key in node.keys]
        if not all(isinstance(key, int | str) for key in keys):
            return UNKNOWN
        return dict(zip(keys, (self.value(value, scope) for value in node.values)))

    def several(self, node: ast.Tuple | ast.List, scope: Scope) -> object:
        values: list[object] = []
        for part in node.elts:
            if isinstance(part, ast.Starred):
                inside = self.value(part.value, scope)
                if not isinstance(inside, list | tuple):
                    return UNKNOWN
                values += inside
            else:
                values.append(self.value(part, scope))
        return tuple(values) if isinstance(node, ast.Tuple) else values

    def comprehended(self, node: ast.GeneratorExp | ast.ListComp, scope: Scope) -> object:
        first = node.generators[0]
        values = self.value(first.iter, scope)
        if len(node.generators) > 1 or first.ifs or not isinstance(values, list | tuple):
            return UNKNOWN
        found: list[object] = []
        for value in values:
            own: dict[str, object] = {}
            self.assign(first.target, value, (own, *scope))
            found.append(self.value(node.elt, (own, *scope)))
        return found

    def operate(self, op: ast.AST, *values: object) -> object:
        done = OPERATORS.get(type(op))
        plain = all(isinstance(v, int | float | str | tuple | list) for v in values)
        if done is None or not plain:
            return UNKNOWN
        if isinstance(op, ast.Mult) and not _is_short_product(values):
            return UNKNOWN
        if isinstance(op, ast.Mod) and isinstance(values[0], str):
            given = values[1] if isinstance(values[1], tuple) else values[1:]
            flat = [v for part in given for v in (part if isinstance(part, list) else [part])]
            wide = TOO_WIDE.search(values[0]) or not all(map(_is_plain, flat))
            if wide:
                return UNKNOWN
        return self.python(done, *values)

    def python(self, done: Callable[..., object], *values: object, **named: object) -> object:
        try:
            return _bounded(done(*values, **named))
        except ERRORS as error:
            raise UnplayableError from error

    def joined(self, parts: list[object]) -> object:
        texts = [part for part in parts if isinstance(part, str)]
        return _bounded("".join(texts)) if len(texts) == len(parts) else UNKNOWN

    def formatted(self, node: ast.FormattedValue, scope: Scope) -> object:
        value = self.value(node.value, scope)
        form = self.value(node.format_spec, scope) if node.format_spec is not None else ""
        if not _is_plain(value) or not isinstance(form, str) or TOO_WIDE.search(form):
            return UNKNOWN
        if node.conversion == ord("r"):
            value = repr(value)
        elif node.conversion == ord("a"):
            value = ascii(value)
        elif node.conversion == ord("s"):
            value = str(value)
        return self.python(format, value, form)

    def attribute(self, of: object, name: str) -> object:
        if isinstance(of, _Made):
            if name in of.attributes:
                return of.attributes[name]
            if name == "_replace" and is_named_tuple(of.of):
                return _Method(of, name)
            return self.of_object(of, self.line_of(of.of), name)
        if isinstance(of, _Super):
            line = self.line_of(of.of.of)
            return self.of_object(of.of, line[line.index(of.after) + 1 :], name)
        if isinstance(of, _Class):
            for found in self.line_of(of.found):
                if name in self.of_class.get(found, {}):
                    return self.of_class[found][name]
            return UNKNOWN
        if isinstance(of, _Parameter):
            return of.value if name == "value" else UNKNOWN
        if isinstance(of, _Logger):
            return _Log(name) if name in LOG_METHODS else UNKNOWN
        if isinstance(of, _Named):
            return _Named(f"{of.name}.{name}")
        return UNKNOWN if of is UNKNOWN else _Method(of, name)

    def of_object(self, made: _Made, line: list[ast.ClassDef], name: str) -> object:
        """Return what the classes of an object give it under a name."""
        for owner in line:
            value = self.of_class.get(owner, {}).get(name, UNKNOWN)
            if value is UNKNOWN:
                continue
            if not isinstance(value, _Code) or isinstance(value.found, ast.Lambda):
                return value
            marks = [m.id for m in value.found.decorator_list if isinstance(m, ast.Name)]
            if len(marks) != len(value.found.decorator_list):
                raise UnplayableError
            if marks == ["staticmethod"]:
                return value
            bound = _Code(value.found, value.around[1:], (made,), owner)
            if marks == ["property"]:
                return self.call(bound, [], {})
            if marks:
                raise UnplayableError
            return bound
        if name == "get_logger":
            return _Named("get_logger")
        return _Named(f"self.{name}")

    def line_of(self, found: ast.ClassDef) -> list[ast.ClassDef]:
        """Return a class and its bases of the file, in the order in which Python looks."""
        line = [found]
        for one in line:
            if len(one.bases) > 1:
                raise UnplayableError
            base = one.bases[0] if one.bases else None
            above = self.classes.get(base.id) if isinstance(base, ast.Name) else None
            if above is not None and above not in line:
                line.append(above)
        return line

    # calls -----------------------------------------------------------------------------------

    def called(self, node: ast.Call, scope: Scope) -> object:
        if isinstance(node.func, ast.Name) and node.func.id == "super":
            return self.base_of(scope)
        function = self.value(node.func, scope)
        given = self.several(ast.List(node.args), scope)
        named: dict[str, object] = {}
        for keyword in node.keywords:
            value = self.value(keyword.value, scope)
            if keyword.arg is None and isinstance(value, dict):
                named |= value if all(isinstance(key, str) for key in value) else {"": value}
            else:
                named[keyword.arg or ""] = value
        if not isinstance(given, list) or "" in named:
            return UNKNOWN
        if isinstance(function, _Log):
            if named or len(given) != 1:
                raise UnplayableError
            self.log(function, given[0], node)
            return None
        if isinstance(function, _Named) and function.name == "print":
            self.printed(given, named, node)
            return None
        return self.call(function, given, named)

    def base_of(self, scope: Scope) -> object:
        for names in scope:
            made, owner = names.get(" self"), names.get(" owner")
            if isinstance(made, _Made) and isinstance(owner, ast.ClassDef):
                return _Super(made, owner)
        return UNKNOWN

    def log(self, method: _Log, text: object, node: ast.Call) -> None:
        if not isinstance(text, str) and self.ticking:
            raise UnplayableError
        if method.level in self.levels and isinstance(text, str):
            self.written.append(Line(text, node))

    def printed(self, given: list[object], named: dict[str, object], node: ast.Call) -> None:
        between = named.pop("sep", " ")
        named.pop("flush", None)
        if not self.ticking:
            return
        if named or not isinstance(between, str) or not all(map(_is_plain, given)):
            raise UnplayableError
        self.written.append(Line(between.join(map(str, given)), node))

    def call(self, function: object, given: list[object], named: dict[str, object]) -> object:
        self.step()
        if isinstance(function, _Code):
            return self.code(function, given, named)
        if isinstance(function, _Class):
            made = _Made(function.found)
            init = self.of_object(made, self.line_of(function.found), "__init__")
            if isinstance(init, _Code):
                self.call(init, given, named)
            elif function.found.decorator_list or is_named_tuple(function.found):
                made.attributes |= self.fields(function.found, given, named)
            elif (given or named) and not function.found.bases:
                raise UnplayableError
            return made
        if isinstance(function, _Method):
            return self.method(function, given, named)
        if isinstance(function, _Named):
            old = given[0] if len(given) == 1 else None
            if function.name == "dataclasses.replace" and isinstance(old, _Made):
                return _Made(old.of, {**old.attributes, **named})
            return self.known(function.name, given, named)
        return UNKNOWN

    def fields(
        self, found: ast.ClassDef, given: list[object], named: dict[str, object]
    ) -> dict[str, object]:
        """Return the attributes of a new object of a dataclass."""
        own = {n.name for n in found.body if isinstance(n, Function)}
        plain = len(found.decorator_list) == 1 and not found.bases and "__post_init__" not in own
        if is_named_tuple(found):
            plain = not found.decorator_list
        elif not plain or last_part(dotted(found.decorator_list[0])).rstrip("()") != "dataclass":
            plain = False
        if not plain:
            raise UnplayableError
        values: dict[str, object] = {}
        fields = [n for n in found.body if isinstance(n, ast.AnnAssign)]
        names = [n.target.id for n in fields if isinstance(n.target, ast.Name)]
        if len(given) > len(names) or not set(named) <= set(names):
            raise UnplayableError
        for at, name in enumerate(names):
            value = self.of_class.get(found, {}).get(name, UNKNOWN)
            if isinstance(value, _Named | list | dict):  # (field(…), or what all objects share)
                value = UNKNOWN
            values[name] = named.get(name, given[at] if at < len(given) else value)
        return values

    def known(self, name: str, given: list[object], named: dict[str, object]) -> object:
        last = name.rpartition(".")[2]
        if last in ("spin", "spin_once", "spin_until_future_complete"):
            raise _SpunError
        if last == "get_logger":
            return _Logger()
        if last == "create_timer":
            both = [*given[1:2], *([named["callback"]] if "callback" in named else [])]
            self.timers += both or [UNKNOWN]
            return UNKNOWN
        if name in ("partial", "functools.partial") and given and isinstance(given[0], _Code):
            first = given[0]
            if named:
                return UNKNOWN
            return _Code(first.found, first.around, (*first.given, *given[1:]), first.owner)
        of_several = self.of_several(name, given, named)
        if of_several is not None:
            return of_several
        done = BUILTINS.get(name)
        if done is None:
            return _Named(f"{name}()")
        if not all(map(_is_plain_or_list, [*given, *named.values()])):
            return UNKNOWN
        if name == "format" and len(given) == 2 and TOO_WIDE.search(str(given[1])):
            return UNKNOWN
        return self.python(done, *given, **named)

    def of_several(self, name: str, given: list[object], named: dict[str, object]) -> object | None:
        """Return what functions of several values give; None for other functions."""
        first = given[0] if given else None
        if name in ("itertools.count", "count"):
            return self.counting(given, named)
        if name == "iter" and len(given) == 1 and isinstance(first, list | tuple):
            return iter(first)
        if name == "next" and len(given) == 1:
            return next(first) if isinstance(first, ITERATORS) else UNKNOWN
        if name in COUNTING:
            return UNKNOWN if given or named else collections.Counter()
        if name == "map" and len(given) == 2 and isinstance(first, _Named):
            done, values = BUILTINS.get(first.name), given[1]
            if (
                done is None
                or not isinstance(values, list | tuple)
                or not _is_plain_or_list(values)
            ):
                return UNKNOWN
            return [self.python(done, value) for value in values]
        if name == "range" and given and all(type(v) is int for v in given):
            return self.python(lambda *ends: list(range(*ends)[: LONGEST + 1]), *given)
        if name == "dict" and not given:
            return dict(named)
        if name == "self.declare_parameter" and len(given) == 2 and isinstance(first, str):
            self.parameters[first] = given[1]
            return UNKNOWN
        if name == "self.get_parameter" and first in self.parameters:
            return _Parameter(self.parameters[str(first)])
        if name.rpartition(".")[2] == "namedtuple" and not named:
            made = named_tuple(given)
            return _Class(made) if made is not None else UNKNOWN
        return None

    def counting(self, given: list[object], named: dict[str, object]) -> object:
        """Return what itertools.count() gives."""
        plain = [v for v in (*given, *named.values()) if isinstance(v, int)]
        if len(plain) != len(given) + len(named) or not set(named) <= {"start", "step"}:
            return UNKNOWN
        begin, by = [*plain[: len(given)], *(0, 1)[len(given) :]]
        return itertools.count(int(str(named.get("start", begin))), int(str(named.get("step", by))))

    def method(self, method: _Method, given: list[object], named: dict[str, object]) -> object:
        of, name = method.of, method.name
        if isinstance(of, _Made) and not given and set(named) <= set(of.attributes):
            return _Made(of.of, {**of.attributes, **named})  # (_replace of a named tuple)
        if isinstance(of, dict) and name in ("get", "update") and not named:
            return self.python(getattr(of, name), *given)
        if isinstance(of, list) and name == "append" and len(given) == 1:
            of.append(given[0])
            return None
        values = [*given, *named.values()]
        if not isinstance(of, str) or name not in TEXT_METHODS:
            if isinstance(of, str | int | float | tuple):
                return UNKNOWN
            raise UnplayableError
        if not all(map(_is_plain_or_list, values)) or any(
            isinstance(v, int) and abs(v) > LONGEST and name != "format" for v in values
        ):
            return UNKNOWN
        if name == "format" and re.search(
            r"[{}]", FORM.sub("", of.replace("{{", "").replace("}}", ""))
        ):
            return UNKNOWN
        if name == "format" and TOO_WIDE.search(of):
            return UNKNOWN
        done: Callable[..., object] = getattr(of, name)
        return self.python(done, *given, **named)

    def code(self, code: _Code, given: list[object], named: dict[str, object]) -> object:
        found, values = code.found, [*code.given, *given]
        yields = any(isinstance(n, ast.Yield | ast.YieldFrom | ast.Await) for n in ast.walk(found))
        if yields and not is_plain_generator(found):
            raise UnplayableError
        own: dict[str, object] = {}
        if code.owner is not None:
            own[" self"], own[" owner"] = code.given[0], code.owner
        self.bind(found.args, values, named, own)
        self.depth += 1
        if self.depth > MOST_CALLS:
            raise UnplayableError
        try:
            if isinstance(found, ast.Lambda):
                return self.value(found.body, (own, *code.around))
            if yields:
                return self.generated(found, (own, *code.around))
            self.run(found.body, (own, *code.around))
        except _ReturnedError as end:
            return end.value
        finally:
            self.depth -= 1
        return None

    def generated(self, found: Function, scope: Scope) -> object:
        """Return an iterator over the first values of a generator that only uses its own variables."""
        values: list[object] = []
        scope[0][" values"] = values
        with contextlib.suppress(_EnoughError, _ReturnedError):
            self.run(found.body, scope)
        return iter(values)

    def yielded(self, node: ast.Yield, scope: Scope) -> object:
        values = scope[0].get(" values")
        if not isinstance(values, list):
            raise UnplayableError
        values.append(self.value(node.value, scope) if node.value is not None else None)
        if len(values) >= MOST_YIELDED:
            raise _EnoughError
        return None

    def keep_defaults(self, parameters: ast.arguments, scope: Scope) -> None:
        """Work out the defaults of parameters, as Python does: once, when it reads the function."""
        for default in (*parameters.defaults, *filter(None, parameters.kw_defaults)):
            value = self.value(default, scope)
            same = self.defaults.get(default, value) in (value,)
            self.defaults[default] = value if same else UNKNOWN

    def bind(
        self,
        parameters: ast.arguments,
        values: list[object],
        named: dict[str, object],
        own: dict[str, object],
    ) -> None:
        places = [*parameters.posonlyargs, *parameters.args]
        if parameters.kwarg is not None or (len(values) > len(places) and not parameters.vararg):
            raise UnplayableError
        defaults = dict(zip(reversed(places), reversed(parameters.defaults)))
        defaults |= {p: d for p, d in zip(parameters.kwonlyargs, parameters.kw_defaults) if d}
        for at, place in enumerate([*places, *parameters.kwonlyargs]):
            if at < min(len(values), len(places)):
                own[place.arg] = values[at]
            elif place.arg in named:
                own[place.arg] = named[place.arg]
            elif place in defaults:
                own[place.arg] = self.defaults.get(defaults[place], UNKNOWN)
            else:
                raise UnplayableError
        if parameters.vararg is not None:
            own[parameters.vararg.arg] = tuple(values[len(places) :])


def _ends(of: ast.Slice) -> tuple[ast.expr | None, ...]:
    return of.lower, of.upper, of.step


def _is_short_product(values: Sequence[object]) -> bool:
    """Whether a product is one of numbers, or a text that is repeated and stays short."""
    texts = [v for v in values if isinstance(v, str)]
    times = [v for v in values if isinstance(v, int)]
    if len(texts) == len(times) == 1:
        return len(texts[0]) * times[0] <= LONGEST
    return all(isinstance(v, int | float) for v in values)


def _is_plain(value: object) -> bool:
    return value is None or isinstance(value, int | float | str)


def _is_plain_or_list(value: object) -> bool:
    if isinstance(value, list | tuple):
        return all(map(_is_plain, value))
    return _is_plain(value)


def _bounded(value: object) -> object:
    if isinstance(value, str) and len(value) > LONGEST:
        raise UnplayableError
    if isinstance(value, int | float) and abs(value) > LARGEST:
        raise UnplayableError
    if isinstance(value, list | tuple) and len(value) > LONGEST:
        raise UnplayableError
    return value
