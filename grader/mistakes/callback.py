"""Mistakes in the callback: its parameters, and what keeps it from returning in time."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import node_callback, node_timer
from grader.mistakes.kind import Family
from grader.mistakes.recognised import MISSING_ARGUMENT, Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.endless import goes_on
from grader.package.source.module import Function
from grader.package.source.names import dotted, last_part
from grader.package.source.parameters import def_after, needed_besides_self, only_self, uses_of
from grader.package.source.sleeps import longest_sleep

NO_PARAMETER = (
    r"(?:(?P<function>[\w.<>]{1,120})\(\) )?takes 0 positional arguments but 1 was given"
    "|invalid method signature"
)
ONLY_SELF = msg("The timer passes no argument to your callback except self.")


def _no_self(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A method of the node, or the function that the timer calls, has no parameter at all."""
    function, callback = match["function"], raised.source.callback
    called = last_part(function) if function else ""
    method = raised.source.methods.get(called) if called else callback
    method = callback if callback is not None and callback.name == called else method
    method = method or (_of_object(raised, function) if function else None)
    if method is None or method.args.args or "staticmethod" in map(dotted, method.decorator_list):
        return None
    return _with_line(raised.finding("callback_no_self", at=method), raised, method)


def _of_object(raised: Raised, function: str) -> Function | None:
    """Return the only method of a name such as `Counter.next` in the classes of all files."""
    owner, _, name = function.rpartition(".")
    methods = [
        method
        for module in (*raised.source.modules, *raised.source.beside)
        for own in module.classes
        for method in own.body
        if own.name == owner and isinstance(method, Function) and method.name == name
    ]
    return methods[0] if len(methods) == 1 and name != "__init__" else None


def _with_line(found: RecognisedMistake, raised: Raised, method: Function) -> RecognisedMistake:
    """Return a mistake in a def with the line as it should be, if only parameters change in it."""
    text = raised.source.module_of(method).text
    change = only_self(text, method)
    if change is None:
        return found
    needed = {argument.arg for argument in needed_besides_self(method)}
    uses = uses_of(method, needed)
    words = {**found.words, "wanted": shown(def_after(text, method, change))}
    if not uses:
        return replace(found, variant="line", words=words)
    words |= {"found": uses[0].id, "line": str(min(use.lineno for use in uses))}
    words["wanted"] = shown(def_after(text, method, change, has_body=False))
    return replace(found, variant="used", words=words)


def _parameter(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    method = raised.source.methods.get(match["function"])
    if method is None or method is not raised.source.callback:
        return None
    if match["name"] == "self":
        return None  # (a decorator takes it away, or the method is called on the class)
    found = raised.finding("callback_parameter", at=method, name=match["name"])
    return _with_line(found, raised, method)


def _decorated(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The method that gets no self is a static one."""
    method = raised.source.methods.get(last_part(match["function"]))
    for decorator in method.decorator_list if method is not None else []:
        if match["name"] == "self" and dotted(decorator) == "staticmethod":
            return raised.finding("callback_decorated", at=decorator, name="staticmethod")
    return None


def _sleeps(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a sleep that delays the lines although the timer's period is right."""
    slept = longest_sleep(suspect.source)
    timers = [timer.seconds for timer in suspect.source.timers]
    if slept is None or slept[1] <= suspect.period or timers not in ([suspect.period], [None]):
        return None
    found = suspect.finding("sleeps_in_callback", slept[0], seconds=slept[1])
    method = suspect.source.function_around(slept[0])
    return replace(found, words={**found.words, "callback": method.name}) if method else found


def _never_ends(suspect: Suspect) -> RecognisedMistake | None:
    callback = suspect.source.callback
    found = never_ends_in(callback) if callback is not None else None
    name = "while" if isinstance(found, ast.While) else "input()"
    return suspect.finding("callback_never_ends", found, name=name) if found is not None else None


def never_ends_in(method: Function) -> ast.Call | ast.While | None:
    """Return what keeps a function from returning: an input, or a loop without an end."""
    for node in ast.walk(method):
        if isinstance(node, ast.Call) and dotted(node.func) == "input":
            return node
        if isinstance(node, ast.While) and goes_on(node):
            return node
    return None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "callback_no_self",
        "callback",
        msg("A method has no parameter self"),
        msg("Python passes the object as the first argument to each of its methods: self."),
        msg("Write: def {callback}(self):"),
        links.PYTHON_CLASSES,
        fixes={"line": msg("Write: {wanted}")},
        seen=r"(?<!__init__\(\) )takes 0 positional arguments but 1 was given|ValueError: invalid method signature",
        raised={NO_PARAMETER: _no_self},
        fixed_by=(node_timer.callback_self,),
        examples=(
            example(
                "callback_without_self",
                Replace(NODE, "def timer_callback(self)", "def timer_callback()"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "callback_decorated",
        "callback",
        msg("A decorator changes what the callback is"),
        msg("@staticmethod makes a function of the method: the timer calls it without self."),
        msg("Delete the line @{name} above the callback."),
        links.PYTHON_CLASSES,
        raised={MISSING_ARGUMENT: _decorated},
        examples=(
            example(
                "callback_is_static",
                Replace(
                    NODE, "    def timer_callback", "    @staticmethod\n    def timer_callback"
                ),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "callback_parameter",
        "callback",
        msg("The callback has more parameters than self"),
        ONLY_SELF,
        msg("Write: def {callback}(self): (only a subscription passes a message to its callback)."),
        fixes={
            "line": msg("Only a subscription passes a message to its callback. Write: {wanted}"),
            "used": msg(
                "Only a subscription passes a message to its callback. In line {line}, write the "
                "value that you mean instead of {found}. Then write: {wanted}"
            ),
        },
        seen=r"TypeError: [\w.]{0,200}\(\) missing \d{1,3} required positional arguments?: "
        r"'(?P<name>\w{1,120})'",
        raised={MISSING_ARGUMENT: _parameter},
        fixed_by=(node_timer.callback_self,),
        examples=(
            example(
                "callback_wants_message",
                Replace(NODE, "def timer_callback(self)", "def timer_callback(self, msg)"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "sleeps_in_callback",
        "callback",
        msg("The callback sleeps for longer than the period"),
        msg(
            "While a callback sleeps, it does not return, and the timer cannot call it again: the timer "
            "has to wait, and lines come late."
        ),
        msg("Remove the sleep from {callback}: the timer alone makes the pauses."),
        links.EXECUTORS,
        behind={"run.wrong_period": _sleeps},
        deletes=("",),
        fixed_by=(node_callback.without_sleeps,),
        examples=(
            example(
                "sleeps_in_callback",
                Replace(NODE, "import rclpy\nfrom", "import time\nimport rclpy\nfrom"),
                Replace(NODE, "self.counter_ += 1", "self.counter_ += 1\n        time.sleep(2)"),
                fails="run.period",
            ),
        ),
    ),
    _node(
        "callback_never_ends",
        "callback",
        msg("The callback does not return"),
        msg("The timer can call a callback again only after it has returned."),
        msg("Remove {name} from {callback}: the timer does the repeating."),
        links.EXECUTORS,
        behind={"run.no_lines": _never_ends, "run.stops": _never_ends},
        fixed_by=(node_callback.without_question,),
        examples=(
            example(
                "asks_in_callback",
                Replace(NODE, "self.counter_ += 1", "self.counter_ += 1\n        input('more?')"),
                fails="run.output",
                blocks=("run.period",),
            ),
        ),
    ),
)
