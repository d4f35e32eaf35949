"""The mistake of a variable that has no value yet because the line that sets it did not run."""

from __future__ import annotations

import ast
import re

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.mistakes.unset_name import UNBOUND
from grader.package.edit.tree import Replace
from grader.package.source.module import Function
from grader.package.source.scopes import bindings, scope_of, use_of


def _no_value(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The lines of the function that set the variable did not run before this one."""
    name, module = match["name"], raised.module
    use = use_of(module, raised.line, name)
    here = scope_of(module, use) if use is not None else None
    found = [b for b in bindings(module, name) if b.scope is here]
    plain = [b for b in found if isinstance(b.part, ast.Name)]
    removed = any(
        isinstance(n, ast.Name) and n.id == name and isinstance(n.ctx, ast.Del)
        for n in module.nodes
    )
    if not isinstance(here, Function) or not found or plain != found or removed:
        return None
    rows = ", ".join(str(row) for row in sorted({b.line for b in found}))
    params = {"name": name, "lines": rows, "function": here.name}
    return raised.finding("variable_not_set", params=params)


def _def_below(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The only thing that gives the name a value is a def further down in the same function."""
    name, module = match["name"], raised.module
    use = use_of(module, raised.line, name)
    here = scope_of(module, use) if use is not None else None
    found = [b for b in bindings(module, name) if b.scope is here]
    if len(found) != 1 or not isinstance(here, Function) or not isinstance(found[0].part, Function):
        return None
    if found[0].line <= (raised.line or 0):
        return None
    return raised.finding("def_below", name=name, line=str(found[0].line), function=here.name)


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "def_below",
        "start",
        msg("A function is used above its def"),
        msg(
            "A def inside of {function} is a line like any other: {name} exists only after line {line} "
            "has run, and this line runs before it."
        ),
        msg("Move def {name} (line {line}), with all of its lines, above this line."),
        raised={UNBOUND: _def_below},
        examples=(
            example(
                "callback_inside_below_the_timer",
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "        self.create_timer(1.0, call)\n\n        def call():\n"
                    "            self.timer_callback()\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "variable_not_set",
        "start",
        msg("A variable has no value on this line"),
        msg(
            "{name} is a variable of {function}. Line {lines} gives it a value, but had not done so when "
            "Python came to this line."
        ),
        msg(
            "See why line {lines} gave it no value: it may be in a branch or a loop that was not "
            "entered, or an earlier error skipped it; the terminal shows such an error above this "
            "one. Give {name} a value on a line of {function} that runs in each case."
        ),
        raised={UNBOUND: _no_value},
        examples=(
            example(
                "period_set_in_empty_loop",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        for period in ():\n            pass\n        self.create_timer(period,",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
