"""Mistakes in a callback inside of a function: a lambda or a def with a parameter that nothing fills."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import DEAD, LOG_LINE, NODE, SILENT, STEP_LINE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.text import SourceText
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import last_part

MISSING = (
    r"TypeError: (?P<function>[\w.<>]{1,200})\(\) missing \d{1,2} required positional arguments?: "
    r"'(?P<name>\w{1,120})'"
)


def _callback(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A timer calls a lambda, or a function inside of a method, that has a parameter."""
    called = last_part(match["function"])
    for timer in raised.source.timers:
        given = timer.callback
        if isinstance(given, ast.Name):
            given = _value_of(raised, given.id) or given
        if called == "<lambda>" and isinstance(given, ast.Lambda):
            if match["name"] in _needed(given.args):
                return _lambda(raised, given, match["name"])
        elif isinstance(given, ast.Name) and given.id == called and "<locals>" in match["function"]:
            for inner in raised.source.all_nodes:
                if isinstance(inner, Function) and inner.name == called:
                    return _inner(raised, inner, match["name"])
    return None


def _value_of(raised: Raised, name: str) -> ast.expr | None:
    """Return the only value that a variable gets."""
    values = [
        n.value
        for n in raised.source.all_nodes
        if isinstance(n, ast.Assign) and name in targets_of(n)
    ]
    return values[0] if len(values) == 1 else None


def _needed(arguments: ast.arguments) -> list[str]:
    """Return the parameters without a default."""
    named = [*arguments.posonlyargs, *arguments.args]
    return [a.arg for a in named[: len(named) - len(arguments.defaults)]]


def _lambda(raised: Raised, given: ast.Lambda, name: str) -> RecognisedMistake | None:
    module = raised.source.module_of(given)
    text, needed = module.text, _needed(given.args)
    code, body = text.code(given), text.code(given.body)
    around = [n for n in module.around(given) if isinstance(n, Function)]
    outside = [a.arg for a in around[0].args.args] if around else []
    used = {n.id for n in ast.walk(given.body) if isinstance(n, ast.Name)} & {*needed}
    if "\n" in code:
        return None
    others = [a for a in used if a != "self" or "self" not in outside]
    plain = len(needed) == len(given.args.args) and not given.args.kwonlyargs
    if others or not plain or given.args.vararg or given.args.posonlyargs:
        params = {"name": shown(code), "parameter": name, "function": "lambda"}
        found = raised.finding("inner_callback_parameter", at=given, params=params)
        return replace(found, variant="used")
    params = {"name": shown(code), "written": shown(f"lambda: {body}"), "parameter": name}
    found = raised.finding("inner_callback_parameter", at=given, params=params)
    return replace(found, variant="self" if "self" in used else "lambda")


def _inner(raised: Raised, inner: Function, name: str) -> RecognisedMistake | None:
    module = raised.source.module_of(inner)
    needed = _needed(inner.args)
    used = {n.id for s in inner.body for n in ast.walk(s) if isinstance(n, ast.Name)} & {*needed}
    around = [n for n in module.around(inner) if isinstance(n, Function)]
    outside = [a.arg for a in around[0].args.args] if around else []
    others = [a for a in used if a != "self" or "self" not in outside]
    head = _head(module.text, inner)
    params = {"name": head, "parameter": name, "function": inner.name}
    arguments = inner.args
    plain = len(arguments.args) == len(needed) and not arguments.vararg and not arguments.kwonlyargs
    if others or not plain or not head:
        found = raised.finding("inner_callback_parameter", at=inner, params=params)
        return replace(found, variant="used")
    written = re.sub(r"\([^()]*\)", "()", head, count=1)
    found = raised.finding(
        "inner_callback_parameter", at=inner, params={**params, "written": written}
    )
    return replace(found, variant="self" if "self" in used else "")


def _head(text: SourceText, inner: Function) -> str:
    """Return the def up to its closing bracket, if it is on one line and has nothing else in ()."""
    match = re.match(r"\s*(def\s+\w+\([^()]*\))", text.line(inner.lineno))
    return match[1] if match is not None else ""


def _makes_another(suspect: Suspect) -> RecognisedMistake | None:
    """The timer gets a function that only makes the callback and returns it."""
    source = suspect.source
    for timer in source.timers:
        made, given = source.methods.get(timer.method), timer.callback
        last = made.body[-1] if made is not None else None
        if made is None or given is None or isinstance(given, ast.Call | ast.Lambda):
            continue
        inner = [s for s in made.body if isinstance(s, Function) and source.logs(s)]
        if len(inner) != 1 or len(made.args.args) != 1 or not isinstance(last, ast.Return):
            continue
        if not isinstance(last.value, ast.Name) or last.value.id != inner[0].name:
            continue
        text = source.module_of(given).text
        words = {"method": made.name, "inner": inner[0].name}
        if any(isinstance(n, ast.Nonlocal) for n in ast.walk(inner[0])):  # (it keeps a value)
            code = text.code(given)
            found = suspect.finding("makes_callback", given, name=code, written=f"{code}()")
            return replace(found, words={**found.words, **words}, variant="made_once")
        written = f"{inner[0].name}()"
        found = suspect.finding("makes_callback", last, name=text.code(last), written=written)
        return replace(found, words={**found.words, **words})
    return None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "makes_callback",
        "callback",
        msg("The timer calls a function that only makes the callback"),
        msg(
            "{method} returns the function {inner} and does not call it. The timer calls {method} in "
            "each period, and does nothing with what it returns."
        ),
        msg("Write {written} instead of {name}: {method} calls {inner} then, in each period."),
        fixes={
            "made_once": msg(
                "Write {written} instead of {name}: create_timer gets what {method} returns then."
            )
        },
        behind={"run.no_lines": _makes_another},
        fixed_by=(lines.written,),
        examples=(
            example(
                "callback_with_a_count_of_its_own_is_made_in_each_period",
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        number = 0\n\n        def handler():\n            nonlocal number\n"
                    "            self.get_logger().info('Hello time: ' + str(number))\n"
                    "            number += 1\n\n        return handler\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "callback_is_made_in_each_period",
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    f"        def handler():\n    {LOG_LINE}    {STEP_LINE}\n        return handler\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "inner_callback_parameter",
        "callback",
        msg("The timer's callback has a parameter, and the timer passes nothing"),
        msg(
            "The timer calls the callback with empty (). Nothing gives {parameter} a value. Only a "
            "method gets self from Python."
        ),
        msg("Write {written} instead of {name}."),
        whys={
            "self": msg(
                "The timer calls the callback with empty (). Nothing gives the parameter self a "
                "value, and it needs none: self of the method around it is known here."
            )
        },
        fixes={
            "used": msg(
                "Delete {parameter} in the parameters of this {function}. Where {function} uses "
                "{parameter}, write the value that you mean."
            )
        },
        raised={MISSING: _callback},
        fixed_by=(lines.written,),
        examples=(
            example(
                "lambda_with_self",
                Replace(NODE, "self.timer_callback)", "lambda self: self.timer_callback())"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "lambda_with_event",
                Replace(NODE, "self.timer_callback)", "lambda event: self.timer_callback())"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
