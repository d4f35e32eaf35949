"""Mistakes in the callback that create_timer is given."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines, node_scope, node_timer
from grader.mistakes.kind import Family
from grader.mistakes.order import attribute_needed_early
from grader.mistakes.recognised import (
    NAME_ERROR,
    OWN_ATTRIBUTE,
    Raised,
    RecognisedMistake,
    Suspect,
    of_self,
)
from grader.mistakes.timer_period import TIMER
from grader.package.edit.tree import Replace
from grader.package.source.module import Function
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import function_at
from grader.package.source.timer import Timer

CALLED = msg(
    "create_timer takes the period in seconds and the callback itself, and calls it later. With () "
    "after its name this line calls the callback now, and passes its result (None) instead, if it has one."
)

KEPT = msg(
    "create_timer takes the period in seconds and the callback itself, and calls it later. {name} runs "
    "now, and its result (None) is passed instead. The timer calls its callback with nothing in the ()."
)


def _called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    called = [timer for timer in raised.source.timers if timer.called]
    return _without_brackets(raised, called[0]) if called else None


def _without_brackets(where: Raised | Suspect, timer: Timer) -> RecognisedMistake | None:
    """Return that a timer's callback is called where it should be passed, and how it is passed."""
    call, source = timer.callback, where.source
    if not isinstance(call, ast.Call) or not _is_own(source, call.func):
        return None  # (what a function of a library is for is not known)
    code, method = source.module_of(call).text.code, source.methods.get(timer.method)
    given = [*call.args, *(keyword.value for keyword in call.keywords)]
    takes = len(method.args.args) - 1 if method is not None else len(given)
    kept = bool(given) and takes >= len(given)
    if kept and any(isinstance(n, ast.Call) for part in given for n in ast.walk(part)):
        return None  # (each call of the timer would make the value anew)
    written = f"lambda: {code(call)}" if kept else code(call.func)
    params = {"name": code(call), "written": written}
    if isinstance(where, Suspect):
        found = where.finding("callback_called", timer.call, **params)
    else:
        found = where.finding("callback_called", at=timer.call, params=params)
    return replace(found, variant="lambda" if kept else "")


def _is_own(source: NodeSource, named: ast.expr) -> bool:
    """Whether a name is of a function or a method in the student's files."""
    functions = {n.name for m in source.modules for n in m.nodes if isinstance(n, Function)}
    return last_part(dotted(named)) in functions or isinstance(named, ast.Lambda)


def _called_with(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback is called with arguments where the timer is created."""
    for timer in raised.source.timers:
        if timer.called and timer.method == match["name"] and raised.line == timer.call.lineno:
            return _without_brackets(raised, timer)
    return None


def _called_early(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback runs in __init__, before the line that sets what it needs."""
    early = attribute_needed_early(raised, match)
    inside = list(ast.walk(early.needs)) if early is not None else []
    for timer in raised.source.timers:
        if timer.called and timer.call in inside:
            return _without_brackets(raised, timer)
    return None


def _calls_back_at_once(suspect: Suspect) -> RecognisedMistake | None:
    for timer in suspect.source.timers:
        if timer.called and not _makes_callback(suspect.source, timer):
            return _without_brackets(suspect, timer)
    return None


def _makes_callback(source: NodeSource, timer: Timer) -> bool:
    """Whether the method that is called returns a function, which the timer then calls."""
    method = source.methods.get(timer.method)
    parts = list(ast.walk(method)) if method is not None else []
    inner = {n.name for n in parts if isinstance(n, Function) and n is not method}
    returned = [n.value for n in parts if isinstance(n, ast.Return)]
    return any(isinstance(v, ast.Lambda) or (v and dotted(v) in inner) for v in returned)


def _is_callback(raised: Raised, match: re.Match[str]) -> bool:
    """Whether the missing attribute is what a timer calls."""
    name = match["name"]
    return of_self(raised, match) and any(t.method == name for t in raised.source.timers)


def _inside_init(raised: Raised, name: str) -> ast.FunctionDef | None:
    init = raised.source.methods.get("__init__")
    for node in ast.walk(init) if init else ():
        if isinstance(node, ast.FunctionDef) and node.name == name:
            return node
    return None


def _callback_in_init(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"]
    at = _inside_init(raised, name) if _is_callback(raised, match) else None
    return raised.finding("callback_in_init", at=at, name=name) if at is not None else None


def _class_ended(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for the callback inside of a function at the margin, which ends the class."""
    name = match["name"]
    for function in raised.source.module.functions.values():
        inner = [n for n in function.body if isinstance(n, ast.FunctionDef) and n.name == name]
        if inner and [a.arg for a in inner[0].args.args] == ["self"]:
            params = {"name": name, "function": function.name, "line": str(function.lineno)}
            return raised.finding("class_ended", at=function, params=params)
    return None


def _callback_misspelt(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if not _is_callback(raised, match):
        return None
    name = match["name"]
    if any(isinstance(n, Function) and n.name == name for n in raised.module.nodes):
        return None  # (it is there, and not in the class)
    close = nearest(name, [m for m in raised.source.methods if m != "__init__"])
    found = raised.finding("callback_misspelt", name=name, close=close)
    words = {**found.words, "callback": close or name}
    return replace(found, variant="" if close else "no_method", words=words)


def _no_self_dot(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name, function = match["name"], function_at(raised.module, raised.line)
    if all(timer.method != name for timer in raised.source.timers):
        return None
    if name not in raised.source.methods:
        return None
    inside = any(function in found.body for found in raised.module.classes)
    return raised.finding("callback_without_self_dot", name=name) if inside else None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "callback_called",
        "timer",
        msg("create_timer gets a call instead of the callback"),
        CALLED,
        msg("Remove the () after the callback's name: create_timer({period}, {written})"),
        fixes={
            "lambda": msg("Write {written} instead of {name}."),
        },
        whys={
            "lambda": KEPT,
        },
        seen=r"TypeError: 'NoneType' object is not callable"
        r"|UnboundLocalError: .{0,60}'arg_name'",
        raised={
            "'NoneType' object is not callable|'arg_name'|is not a callable object": _called,
            r"TypeError: \w{1,120}\.(?P<name>\w{1,120})\(\) takes": _called_with,
            OWN_ATTRIBUTE: _called_early,
        },
        behind={"run.by_hand": _calls_back_at_once},
        fixed_by=(node_timer.callback, lines.written),
        examples=(
            example(
                "callback_called_with_its_values",
                Replace(NODE, "self.timer_callback)", "self.timer_callback('Hello time: '))"),
                Replace(NODE, "def timer_callback(self)", "def timer_callback(self, text)"),
                Replace(NODE, "'Hello time: ' + str", "text + str"),
                fails="run.output",
                also={"run.period": "node.callback_called"},
                blocks=("run.interrupt",),
            ),
            example(
                "brackets_behind_callback",
                Replace(NODE, "self.timer_callback)", "self.timer_callback())"),
                fails="run.output",
                also={"run.period": "node.callback_called"},
                blocks=("run.interrupt",),
                note="one line at once, then 'NoneType' object is not callable",
            ),
            example(
                "callback_called_before_counter",
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(
                    NODE,
                    "self.timer_callback)\n",
                    "self.timer_callback())\n        self.counter_ = 0\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "callback_in_init",
        "timer",
        msg("The callback is indented into __init__"),
        msg("A function inside __init__ is not a method of the class, so self does not have it."),
        msg(
            "Indent def {callback}(self): as far as def __init__, and move its lines to the left "
            "by as much."
        ),
        links.PYTHON_CLASSES,
        raised={OWN_ATTRIBUTE: _callback_in_init},
        fixed_by=(node_scope.out_of_init,),
        examples=(
            example(
                "callback_inside_init",
                Replace(NODE, "    def timer_callback(self)", "        def timer_callback(self)"),
                Replace(
                    NODE,
                    (
                        '        """Say hello once; the timer calls this for as long as the node spins."""\n'
                        "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                        "        self.counter_ += 1\n"
                    ),
                    (
                        "            self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                        "            self.counter_ += 1\n"
                    ),
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "class_ended",
        "class",
        msg("A function at the margin ends the class"),
        msg(
            "def {function} in line {line} begins at the margin, and there the class ends. {name} below it "
            "is inside of {function}, and no method of the class."
        ),
        msg("Move def {function} with its own lines above the class. Leave {name} where it is."),
        raised={OWN_ATTRIBUTE: _class_ended},
        examples=(
            example(
                "function_at_the_margin_above_the_callback",
                Replace(
                    NODE,
                    "    def timer_callback(self)",
                    "def text_of(number):\n    return 'Hello time: ' + str(number)\n\n"
                    "    def timer_callback(self)",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "callback_misspelt",
        "timer",
        msg("The callback's name is misspelt"),
        msg("create_timer needs the method's exact name."),
        TIMER,
        fixes={
            "no_method": msg(
                "The class has no method {name}. Write def {name}(self): above the lines that the timer "
                "is to run, indented like the other methods, or pass the name of the method that is "
                "meant."
            ),
        },
        raised={OWN_ATTRIBUTE: _callback_misspelt},
        fixed_by=(node_timer.callback,),
        examples=(
            example(
                "callback_misspelt",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.create_timer(1.0, self.timer_calback)",
                ),
                fails="run.starts",
            ),
            example(
                "callback_of_nothing",
                Replace(NODE, "self.timer_callback)", "self.on_update)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "callback_without_self_dot",
        "timer",
        msg("The object is missing before the callback"),
        msg(
            "A method is reached through its object: self.name in the class, the node's variable outside."
        ),
        TIMER,
        links.PYTHON_CLASSES,
        raised={NAME_ERROR: _no_self_dot},
        fixed_by=(lines.written, node_timer.callback),
        examples=(
            example(
                "callback_without_self_dot",
                Replace(NODE, "self.timer_callback", "timer_callback"),
                fails="run.starts",
            ),
        ),
    ),
)
