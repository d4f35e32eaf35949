"""Errors that are raised inside of what a line calls: one of its arguments does not fit."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.module import Function
from grader.package.source.names import called_name, dotted, last_part
from grader.package.source.place import statement_at

ATTRIBUTE = r"AttributeError: '(?P<type>\w{1,120})' object has no attribute '(?P<name>\w{1,120})'"
MISSING = (
    r"TypeError: (?P<type>[\w.]{1,200})\(\) missing \d{1,3} required positional arguments?: "
    r"'(?P<name>\w{1,120})'"
)
GROUPS = ("ReentrantCallbackGroup", "MutuallyExclusiveCallbackGroup")
TIMERS = ("Timer.__init__", "WallTimer.__init__")
OF_TIMER = ("callback", "callback_group", "timer_period_ns", "clock")
"""The parameters of rclpy's class; Python's threading.Timer has others."""


def _calls(raised: Raised) -> Iterator[ast.Call]:
    """Yield the calls of the statement that the traceback shows."""
    statement = statement_at(raised.module, raised.line)
    for node in ast.walk(statement) if statement is not None else ():
        if isinstance(node, ast.Call):
            yield node


def _class_of_group(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A class of callback groups is passed where an object of it is needed."""
    del match
    for call in _calls(raised):
        given = [*call.args, *(keyword.value for keyword in call.keywords)]
        for part in given:
            if last_part(dotted(part)) in GROUPS:
                code = raised.module.text.code(part)
                return raised.finding("group_class", at=part, name=code, written=f"{code}()")
    return None


def _missing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    function = match["type"]
    if (
        function in TIMERS
        and match["name"] in OF_TIMER
        and "Timer" not in raised.source.known_classes
    ):
        return raised.finding("timer_class")
    if match["name"] == "self" or function.partition(".")[0] in raised.source.known_classes:
        return None
    if any(
        isinstance(n, Function) and n.name == last_part(function) for n in raised.source.all_nodes
    ):
        return None
    for call in _calls(raised):
        owner, _, name = dotted(call.func).rpartition(".")
        if name == "destroy_timer" == last_part(function) and not call.args:
            params = {"name": f"{owner}.destroy_timer()", "written": f"{owner}.destroy_node()"}
            return raised.finding("destroys_timer", at=call, params=params)
    called = {last_part(called_name(call)) for call in _calls(raised)}
    wanted = {last_part(function), *function.removesuffix(".__init__").rsplit(".", 1)[-1:]}
    return None if called & wanted or not called or not raised.inside else _inside(raised)


def _attribute(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """An attribute is looked for that the student's line does not have."""
    if match["type"] in (*raised.source.known_classes, "NoneType", "super"):
        return None
    if match["name"] in raised.module.line(raised.line) or not any(_calls(raised)):
        return None
    calls = [call for call in _calls(raised) if called_name(call).endswith("create_rate")]
    if calls and match["type"] in ("function", "method") and len(calls[0].args) == 2:
        code = raised.module.text.code(calls[0])
        written = code.replace("create_rate", "create_timer", 1)
        return raised.finding("rate_for_timer", at=calls[0], name=code, written=written)
    if not raised.inside:
        return None
    params = {"name": match["type"], "attribute": match["name"]}
    return replace(raised.finding("inside_call", params=params), variant="type")


def _inside(raised: Raised) -> RecognisedMistake:
    return raised.finding("inside_call")


_node = Family("node", links.RCLPY)
KINDS = (
    _node(
        "group_class",
        "timer",
        msg("A class is passed where an object of it is needed"),
        msg("{name} is a class. {written} makes an object of it, with the () behind its name."),
        msg("Write {written} instead of {name}."),
        raised={MISSING: _class_of_group},
        fixed_by=(lines.written,),
        examples=(
            example(
                "callback_group_not_called",
                Replace(
                    NODE,
                    "from rclpy.node import Node",
                    "from rclpy.callback_groups import ReentrantCallbackGroup\n"
                    "from rclpy.node import Node",
                ),
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.create_timer(1.0, self.timer_callback, callback_group=ReentrantCallbackGroup)",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "timer_class",
        "timer",
        msg("A timer is created without the node"),
        msg(
            "create_timer of the node creates the timer, and lets the node call its callback. The "
            "class of rclpy's timers is made for create_timer, and takes other arguments."
        ),
        msg(
            "Write self.create_timer({period}, self.{callback}), and remove the import of the class."
        ),
        raised={MISSING: _missing},
        examples=(
            example(
                "timer_of_rclpy_by_its_class",
                Replace(NODE, "import Node\n", "import Node\nfrom rclpy.timer import Timer\n"),
                Replace(NODE, "self.create_timer(1.0,", "self.timer_ = Timer(1.0,"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "destroys_timer",
        "shutdown",
        msg("A timer is to be destroyed, but which one is not said"),
        msg(
            "destroy_timer destroys one timer, which it is given. destroy_node ends the whole node."
        ),
        msg("Write {written} instead of {name}."),
        raised={MISSING: _missing},
        fixed_by=(lines.written,),
        examples=(
            example(
                "destroy_timer_for_node",
                Replace(NODE, "node.destroy_node()", "node.destroy_timer()"),
                fails="run.interrupt",
            ),
        ),
    ),
    _node(
        "rate_for_timer",
        "timer",
        msg("create_rate is called with a callback"),
        msg(
            "A rate lets a loop sleep and calls nothing. A timer calls the callback again and again."
        ),
        msg("Write {written} instead of {name}."),
        raised={ATTRIBUTE: _attribute},
        fixed_by=(lines.written,),
        examples=(
            example(
                "create_rate_with_a_callback",
                Replace(NODE, "create_timer(1.0,", "create_rate(1.0,"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "inside_call",
        "start",
        msg("The error comes from inside of what this line calls"),
        msg(
            "The line is not wrong in itself: what it calls cannot work with a value that it gets here, or "
            "that an earlier line has given to the same object."
        ),
        msg(
            "Compare the arguments on this line with the documentation: their order, their number, "
            "and whether each one is an object, a class or a function. If they are right, look at what "
            "earlier lines give to the same object."
        ),
        whys={
            "type": msg(
                "What this line calls needs a value that has {attribute}, and gets one of the type {name}. "
                "This value comes from this line, or from an earlier line that gives it to the same object."
            )
        },
        raised={MISSING: _missing, ATTRIBUTE: _attribute},
    ),
)
