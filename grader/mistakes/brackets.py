"""The mistake of a function that is named where it was to be called."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import dotted, last_part, own_name
from grader.package.source.place import function_at, statement_at

OF_FUNCTION = (
    r"AttributeError: '(?:function|method|builtin_function_or_method)' object has no attribute "
    r"'(?P<name>\w{1,120})'"
)


def _not_called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Something is read from a function that the line, or one above it, does not call."""
    statement = statement_at(raised.module, raised.line)
    parts = [
        part.value
        for part in (ast.walk(statement) if statement is not None else ())
        if isinstance(part, ast.Attribute) and part.attr == match["name"]
    ]
    named = [part for part in parts if isinstance(part, ast.Name | ast.Attribute)]
    if len(named) != 1 or last_part(dotted(named[0])) == "get_logger" or not dotted(named[0]):
        return None
    around = raised.module.parents.get(named[0])
    if isinstance(around, ast.Attribute) and isinstance(around.ctx, ast.Store):
        return None
    given = _assigned(raised, named[0])
    part = named[0] if given is None else given
    if isinstance(part, ast.Call):
        return None
    if given is None and isinstance(part, ast.Name) and part.id not in raised.module.functions:
        return None
    code = raised.module.text.code(part)
    method = raised.source.methods.get(own_name(part))
    function = raised.module.functions.get(code) if isinstance(part, ast.Name) else method
    if function is not None and isinstance(part, ast.Name) and not _gives_value(function):
        return None
    arguments = _arguments(code, function)
    shown = raised.finding("not_called", at=part, name=code, written=f"{code}({arguments})")
    if "…" not in arguments:
        return shown
    return replace(shown, params={}, variant="open")


def _gives_value(function: Function) -> bool:
    """Whether a function has a return with a value, a yield, or a decorator."""
    return bool(function.decorator_list) or any(
        isinstance(n, ast.Yield | ast.YieldFrom)
        or (isinstance(n, ast.Return) and n.value is not None and ast.unparse(n.value) != "None")
        for n in ast.walk(function)
    )


def _assigned(raised: Raised, named: ast.expr) -> ast.expr | None:
    """Return what a variable or an attribute gets in the only line that assigns to it."""
    name, function = dotted(named), function_at(raised.module, raised.line)
    among = raised.source.own_nodes if "." in name else ast.walk(function or raised.module.tree)
    found = [
        n.value
        for n in among
        if isinstance(n, ast.Assign | ast.AnnAssign) and name in targets_of(n)
    ]
    return found[0] if len(found) == 1 else None


def _arguments(code: str, function: Function | None) -> str:
    """Return what belongs in the () of a function: nothing, or what is open."""
    if function is None:
        return "'…'" if last_part(code) == "get_parameter" else ""
    own = 1 if code.startswith("self.") else 0
    return "…" if len(function.args.args) - len(function.args.defaults) > own else ""


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "not_called",
        "callback",
        msg("The () after a function is missing"),
        msg("{name} is a function: only calling it, with (), gives its result."),
        msg("Write {written} instead of {name}."),
        fixes={
            "open": msg(
                "Write {written} instead of {name}, with what the function needs in the place of …"
            )
        },
        raised={OF_FUNCTION: _not_called},
        fixed_by=(lines.written,),
        examples=(
            example(
                "get_clock_not_called",
                Replace(
                    NODE, "self.counter_ += 1", "self.get_clock.now()\n        self.counter_ += 1"
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "parameter_value_not_called",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        self.declare_parameter('period', 1.0)\n"
                    "        value = self.get_parameter('period').get_parameter_value\n"
                    "        self.create_timer(value.double_value,",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
