"""The mistake of a line that compares with `==` where it was to assign a value."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import node_equals
from grader.mistakes.fixes.node_equals import Compared, arrows_in, compared_in
from grader.mistakes.kind import Family
from grader.mistakes.recognised import (
    NAME_ERROR,
    OWN_ATTRIBUTE,
    Raised,
    RecognisedMistake,
    Suspect,
    of_self,
)
from grader.package.edit.tree import Replace
from grader.package.source.counter import parts_of_callback, targets_of
from grader.package.source.names import dotted, last_part
from grader.package.source.place import function_at

UNBOUND = r"UnboundLocalError: .{0,60}'(?P<name>\w{1,120})'"


def _attribute(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """An attribute has no value, because a line compares it where it was to set it."""
    name = f"self.{match['name']}"
    if not of_self(raised, match):
        return None
    one = _line_of_error(raised, name) or _only_typed(raised, name)
    return _finding(raised, one) if one is not None else None


def _variable(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The same of a variable; where the class uses an attribute of that name, that was meant."""
    name = match["name"]
    one = _line_of_error(raised, name)
    if one is None:
        return None
    module, source = raised.module, raised.source
    function = function_at(module, one.statement.lineno)
    used = [
        n for n in module.nodes if isinstance(n, ast.Name) and n.id == name and n is not one.left
    ]
    own = any(dotted(node) == f"self.{name}" for node in source.own_nodes)
    if not used and own and function is not None and function is source.methods.get("__init__"):
        if not isinstance(one.statement, ast.Expr):
            return None
        return replace(_finding(raised, one, "self."), variant="own")
    return _finding(raised, one)


def _line_of_error(raised: Raised, name: str) -> Compared | None:
    """Return the statement at which the error was raised, if one = makes it right."""
    for one in compared_in(raised.module):
        if one.name == name and raised.line in one.lines and isinstance(one.statement, ast.Expr):
            return None if _reads(one.right, name) or _counts(raised, name) else one
    return None


def _counts(raised: Raised, name: str) -> bool:
    """Whether the error was raised in a callback that adds to the name, so it must be set before."""
    function = function_at(raised.module, raised.line)
    parts = parts_of_callback(raised.source)
    return function in parts and any(name in targets_of(node) for node in ast.walk(function))


def _only_typed(raised: Raised, name: str) -> Compared | None:
    """Return the statement of __init__ that has == between the type and the value."""
    init = raised.source.methods.get("__init__")
    for one in compared_in(raised.module):
        typed = isinstance(one.statement, ast.AnnAssign) and one.name == name
        inside = init is not None and one.statement in init.body
        if typed and inside and (raised.line is None or raised.line not in one.lines):
            return one if _is_after(raised, one) else None
    return None


def _is_after(raised: Raised, one: Compared) -> bool:
    """Whether the error was raised below a line of __init__, or in another function."""
    same = function_at(raised.module, raised.line) is function_at(
        raised.module, one.statement.lineno
    )
    return not same or (raised.line or 0) > one.statement.lineno


def _reads(value: ast.expr, name: str) -> bool:
    return any(dotted(node) == name for node in ast.walk(value))


def _finding(raised: Raised, one: Compared, before: str = "") -> RecognisedMistake:
    written = before + one.written(raised.module)
    found = raised.finding(
        "compared_not_assigned", at=one.statement, name=one.name, written=written
    )
    return replace(found, words={**found.words, "line": str(one.statement.lineno)})


def _kept(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only statement of the node that compares a value, and does nothing with the result."""
    source = suspect.source
    found = [one for one in compared_in(source.module) if one.statement in source.own_nodes]
    if len(found) != 1 or not isinstance(found[0].statement, ast.Expr):
        return None
    one = found[0]
    params: dict[str, str | int] = {"name": one.name, "written": one.written(source.module)}
    mistake = suspect.finding("compared_not_assigned", one.statement, **params)
    words = {**mistake.words, "line": str(one.statement.lineno)}
    return replace(mistake, words=words, variant="kept")


def _arrow(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A name has no value, because its line has the arrow <- of other languages."""
    for one in arrows_in(raised.module):
        if last_part(one.name) != match["name"] or raised.line not in one.lines:
            continue
        found = raised.finding(
            "arrow", at=one.statement, name=one.name, written=one.written(raised.module)
        )
        return replace(found, words={**found.words, "line": str(one.statement.lineno)})
    return None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "arrow",
        "file",
        msg("<- is written where = is needed"),
        msg(
            "In Python, <- is < and -: the line asks whether {name} is less than a negative number. It "
            "reads {name}, which has no value yet."
        ),
        msg("Write = in line {line}: {written}"),
        links.PYTHON_CLASSES,
        raised=dict.fromkeys((OWN_ATTRIBUTE, NAME_ERROR, UNBOUND), _arrow),
        fixed_by=(node_equals.assigned,),
        examples=(
            example(
                "counter_assigned_by_an_arrow",
                Replace(NODE, "self.counter_ = 0", "self.counter_ <- 0"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "compared_not_assigned",
        "file",
        msg("== is written where one = is needed"),
        msg("== only compares: it reads {name}, which has no value yet. One = assigns a value."),
        msg("Write one = in line {line}: {written}"),
        links.PYTHON_CLASSES,
        whys={
            "kept": msg(
                "== only compares: this line does nothing with the result, and {name} keeps the value that "
                "it has. One = assigns a value."
            )
        },
        fixes={
            "own": msg("Write one = in line {line}, and self. before the name: {written}"),
        },
        behind=dict.fromkeys(
            (
                *("run.no_lines", "run.stops", "run.constant_counter", "run.wrong_start"),
                *("run.wrong_step", "run.wrong_text", "run.wrong_period", "run.twice"),
            ),
            _kept,
        ),
        raised={OWN_ATTRIBUTE: _attribute, NAME_ERROR: _variable, UNBOUND: _variable},
        fixed_by=(node_equals.assigned,),
        examples=(
            example(
                "counter_compared",
                Replace(NODE, "self.counter_ = 0", "self.counter_ == 0"),
                fails="run.starts",
            ),
            example(
                "timer_compared",
                Replace(NODE, "self.create_timer(", "self.timer_ == self.create_timer("),
                fails="run.starts",
            ),
            example(
                "node_compared",
                Replace(NODE, "node = MyFirstNode()", "node == MyFirstNode()"),
                fails="run.starts",
            ),
        ),
    ),
)
