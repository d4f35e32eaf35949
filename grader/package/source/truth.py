"""Conditions that are always true or always false, as far as the source shows it for certain."""

from __future__ import annotations

import ast
from dataclasses import dataclass, replace
from typing import Literal

from grader.package.source.counter import targets_of
from grader.package.source.imported import full_name
from grader.package.source.module import Function
from grader.package.source.names import dotted, own_name
from grader.package.source.node import NodeSource

Reason = Literal["constant", "function", "bits", "ok", "guard", "argument"]
OK = "rclpy.ok"
SETS_UP, ENDS = ("init",), ("shutdown", "try_shutdown")
NOT = (ast.IsNot, ast.NotEq)


@dataclass(frozen=True)
class Truth:
    """What a condition always is, why, and the part of it that makes it so."""

    value: bool
    reason: Reason
    part: ast.expr


def truth_of(source: NodeSource, test: ast.expr) -> Truth | None:
    """Return what a condition of a function is whenever it is asked; None if that is not certain."""
    if isinstance(test, ast.Constant):
        return Truth(bool(test.value), "constant", test)
    if isinstance(test, ast.Tuple | ast.List | ast.Set):
        filled = any(not isinstance(part, ast.Starred) for part in test.elts)
        return Truth(True, "constant", test) if filled else None
    if isinstance(test, ast.UnaryOp):
        return _of_unary(source, test)
    if isinstance(test, ast.BoolOp):
        return _of_several(source, test)
    if isinstance(test, ast.Compare) and len(test.ops) == 1:
        return _of_comparison(source, test)
    if is_function(source, test):
        return Truth(True, "function", test)
    if isinstance(test, ast.Call):
        runs = full_name(source.module_of(test), test.func) == OK and not test.args
        return Truth(True, "ok", test) if runs and _ros_runs(source, test) else None
    return _of_name(source, test)


def _of_unary(source: NodeSource, test: ast.UnaryOp) -> Truth | None:
    if isinstance(test.op, ast.Not):
        found = truth_of(source, test.operand)
        return replace(found, value=not found.value) if found is not None else None
    if isinstance(test.op, ast.Invert) and _is_bool(source, test.operand):
        return Truth(True, "bits", test)
    return None


def _of_several(source: NodeSource, test: ast.BoolOp) -> Truth | None:
    """One true part decides an `or`, and one false part an `and`."""
    found = [truth_of(source, part) for part in test.values]
    decides = isinstance(test.op, ast.Or)
    for each in found:
        if each is not None and each.value is decides:
            return each
    known = [each for each in found if each is not None]
    return known[0] if len(known) == len(found) else None


def _of_comparison(source: NodeSource, test: ast.Compare) -> Truth | None:
    left, op, right = test.left, test.ops[0], test.comparators[0]
    if not isinstance(op, ast.Is | ast.IsNot | ast.Eq | ast.NotEq):
        return None
    differs = isinstance(op, NOT)
    if not isinstance(right, ast.Constant):
        return None
    if dotted(left) == "__name__" and right.value == "__main__":
        return Truth(differs, "guard", test)
    if is_function(source, left):
        return Truth(differs, "function", left)
    found = truth_of(source, left)
    if found is None:
        return None
    if found.reason == "argument" and right.value is None:
        return Truth(not differs, "argument", left)
    if found.reason == "ok" and isinstance(right.value, bool):
        return replace(found, value=(found.value is right.value) is not differs)
    return None


def is_function(source: NodeSource, named: ast.expr) -> bool:
    """Whether an expression names a function or a method that is not called."""
    module = source.module_of(named)
    if full_name(module, named) == OK:
        return True
    if isinstance(named, ast.Name):
        stored = any(
            isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store) and n.id == named.id
            for n in module.nodes
        )
        given = any(isinstance(n, ast.arg) and n.arg == named.id for n in module.nodes)
        return named.id in module.functions and not stored and not given
    method = source.methods.get(own_name(named)) if isinstance(named, ast.Attribute) else None
    return (
        method is not None
        and not method.decorator_list
        and method.name not in source.attributes
        and dotted(named) == f"self.{method.name}"
    )


def _is_bool(source: NodeSource, part: ast.expr) -> bool:
    """Whether a value is True or False."""
    if isinstance(part, ast.Compare) or (
        isinstance(part, ast.UnaryOp) and isinstance(part.op, ast.Not)
    ):
        return True
    if isinstance(part, ast.Call):
        return full_name(source.module_of(part), part.func) == OK or dotted(part.func) == "bool"
    values = _values_of(source, part)
    return bool(values) and all(
        isinstance(value, ast.Constant) and isinstance(value.value, bool) for value in values
    )


def always_set_to(source: NodeSource, part: ast.expr, value: bool) -> bool:
    """Whether an attribute of the node gets only this value."""
    values = _values_of(source, part)
    return bool(values) and all(isinstance(v, ast.Constant) and v.value is value for v in values)


def _values_of(source: NodeSource, named: ast.expr) -> list[ast.expr | None]:
    """Return what all statements give to an attribute of self; None for what is not plain."""
    name = dotted(named)
    if not name.startswith("self.") or name.count(".") != 1:
        return []
    sets = [n for n in source.all_nodes if isinstance(n, ast.stmt) and name in targets_of(n)]
    stored = [
        n
        for n in source.all_nodes
        if isinstance(n, ast.Attribute)
        and isinstance(n.ctx, ast.Store | ast.Del)
        and n.attr == name.removeprefix("self.")
    ]
    plain = [s for s in sets if isinstance(s, ast.Assign | ast.AnnAssign)]
    if len(plain) != len(stored):
        return [None]
    return [s.value for s in plain]


def _ros_runs(source: NodeSource, call: ast.Call) -> bool:
    """Whether rclpy.ok() is asked when ROS has been started, and before it is shut down."""
    around = source.function_around(call)
    if around is not source.main or around is None:
        return around is not None and around is source.callback
    calls = [(n, dotted(n.func)) for n in ast.walk(around) if isinstance(n, ast.Call)]
    before = {name.rpartition(".")[2] for n, name in calls if n.lineno < call.lineno}
    return bool(before & set(SETS_UP)) and not before & set(ENDS)


def _of_name(source: NodeSource, test: ast.expr) -> Truth | None:
    """A parameter of the entry function, which is called without arguments."""
    main = source.main
    if not isinstance(test, ast.Name) or main is None or source.function_around(test) is not main:
        return None
    if not _is_none_by_default(main, test.id):
        return None
    stored = [
        n
        for n in ast.walk(main)
        if isinstance(n, ast.Name) and n.id == test.id and not isinstance(n.ctx, ast.Load)
    ]
    return Truth(False, "argument", test) if not stored else None


def _is_none_by_default(main: Function, name: str) -> bool:
    given = main.args.args
    defaults = dict(zip([a.arg for a in reversed(given)], reversed(main.args.defaults)))
    value = defaults.get(name)
    return isinstance(value, ast.Constant) and value.value is None
