"""The parameters that a node declares and reads."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from grader.package.source.names import last_part
from grader.package.source.node import NodeSource


@dataclass(frozen=True)
class Parameter:
    """A parameter in a call: its name as a string, and its default value if the call has one."""

    call: ast.Call
    written: ast.Constant
    default: ast.expr | None = None

    @property
    def name(self) -> str:
        """The parameter's name."""
        return str(self.written.value)


def declared(source: NodeSource) -> list[Parameter]:
    """Return the parameters that the files declare by a name in quotes."""
    found: list[Parameter] = []
    for call, name in source.calls:
        if last_part(name) == "declare_parameter":
            default = _argument(call, 1, "value")
            found += [Parameter(call, text, default) for text in _text(_argument(call, 0, "name"))]
        elif last_part(name) == "declare_parameters":
            given = _argument(call, 1, "parameters")
            if call is with_namespace(source):
                continue
            for entry in given.elts if isinstance(given, ast.List | ast.Tuple) else ():
                parts = entry.elts if isinstance(entry, ast.Tuple) else []
                default = parts[1] if len(parts) > 1 else None
                found += [Parameter(call, text, default) for text in _text((*parts, None)[0])]
    return found


def with_namespace(source: NodeSource) -> ast.Call | None:
    """Return the call of declare_parameters that may put a namespace before each name."""
    for call, name in source.calls:
        given = _argument(call, 0, "namespace")
        empty = isinstance(given, ast.Constant) and given.value == ""
        if last_part(name) == "declare_parameters" and given is not None and not empty:
            return call
    return None


def declares_others(source: NodeSource) -> bool:
    """Whether a call declares parameters whose names are not in it."""
    calls = [c for c, name in source.calls if last_part(name).startswith("declare_parameter")]
    return any(call not in {p.call for p in declared(source)} for call in calls)


def _argument(call: ast.Call, place: int, name: str) -> ast.expr | None:
    if place < len(call.args):
        return call.args[place]
    return next((k.value for k in call.keywords if k.arg == name), None)


def _text(given: ast.expr | None) -> list[ast.Constant]:
    is_text = isinstance(given, ast.Constant) and isinstance(given.value, str)
    return [given] if isinstance(given, ast.Constant) and is_text else []
