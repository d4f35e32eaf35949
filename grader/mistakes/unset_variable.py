"""The mistake of a variable that has no value yet because the line that sets it did not run."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.counter_variable import has_text, is_built
from grader.mistakes.example import DEAD, LOG_LINE, NODE, STEP_LINE, example
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, first_of
from grader.mistakes.unset_name import UNBOUND
from grader.package.edit.tree import Replace
from grader.package.source.counter import adds_to, targets_of
from grader.package.source.module import Function
from grader.package.source.place import function_at, statement_at
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


def _added_to_nothing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line adds to a text or a sum that no line of the function begins."""
    name, function = match["name"], function_at(raised.module, raised.line)
    statement = statement_at(raised.module, raised.line)
    if function is None or statement is None or not adds_to(statement, name):
        return None
    changed = [n for n in ast.walk(function) if isinstance(n, ast.stmt) and name in targets_of(n)]
    if not is_built(raised, function, name) or any(not adds_to(n, name) for n in changed):
        return None
    written = f"{name} = {raised.module.text.quote * 2 if has_text(statement) else 0}"
    found = raised.finding("variable_not_set", at=statement, name=name, written=written)
    return replace(found, words={**found.words, "function": function.name}, variant="added_to")


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
        whys={
            "added_to": msg(
                "{name} is a variable of {function}, and no line of {function} gives it a first value. So "
                "there is nothing yet to which this line can add."
            )
        },
        fixes={
            "added_to": msg(
                "Write {written} on a line of its own above this line, indented as far as this line. If "
                "this line is in a loop, write it above the loop, indented as far as the loop."
            )
        },
        raised={UNBOUND: first_of(_added_to_nothing, _no_value)},
        examples=(
            example(
                "text_put_together_from_nothing",
                Replace(
                    NODE,
                    LOG_LINE,
                    "        text += 'Hello time: ' + str(self.counter_)\n"
                    "        self.get_logger().info(text)\n",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "sum_in_a_loop_from_nothing",
                Replace(
                    NODE,
                    STEP_LINE,
                    "        for number in (self.counter_, 1):\n            total += number\n"
                    "        self.counter_ = total\n",
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
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
