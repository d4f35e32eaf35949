"""The mistake of a line that compares with `==` where it was to assign a value."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import node_equals
from grader.mistakes.fixes.node_equals import Compared, compared_in
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
from grader.package.source.names import dotted
from grader.package.source.place import function_at

UNBOUND = r"UnboundLocalError: .{0,60}'(?P<name>\w{1,120})'"


def _attribute(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """An attribute has no value, because the line compares it where it was to set it."""
    return _line_of_error(raised, f"self.{match['name']}") if of_self(raised, match) else None


def _variable(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The same of a variable, unless the class has an attribute of that name, which may be meant."""
    if any(dotted(node) == f"self.{match['name']}" for node in raised.source.own_nodes):
        return None
    return _line_of_error(raised, match["name"])


def _line_of_error(raised: Raised, name: str) -> RecognisedMistake | None:
    """Return the statement at which the error was raised, if one = makes it right."""
    function = function_at(raised.module, raised.line)
    counts = function in parts_of_callback(raised.source) and any(
        name in targets_of(node) for node in ast.walk(function or raised.module.tree)
    )
    for one in compared_in(raised.module):
        if one.name == name and raised.line in one.lines and not counts:
            if any(dotted(node) == name for node in ast.walk(one.right)):
                return None
            params = {"name": one.name, "written": one.written(raised.module)}
            found = raised.finding("compared_not_assigned", at=one.statement, params=params)
            return _with_line(found, one)
    return None


def _kept(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only statement of the node that compares a value, and does nothing with the result."""
    source = suspect.source
    found = [one for one in compared_in(source.module) if one.statement in source.own_nodes]
    if len(found) != 1:
        return None
    params = {"name": found[0].name, "written": found[0].written(source.module)}
    mistake = suspect.finding("compared_not_assigned", found[0].statement, **params)
    return replace(_with_line(mistake, found[0]), variant="kept")


def _with_line(found: RecognisedMistake, one: Compared) -> RecognisedMistake:
    return replace(found, words={**found.words, "line": str(one.statement.lineno)})


_node = Family("node", links.FIRST_NODE)
KINDS = (
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
