"""Methods that objects of rclpy do not have: start of a timer, spin_some, info of a node."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import OWN_ATTRIBUTE, Raised, RecognisedMistake
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.names import dotted
from grader.package.source.node import LOG_METHODS
from grader.package.source.place import function_at, statement_at

OF_TIMER = r"AttributeError: '(?P<type>Timer)' object has no attribute '(?P<name>\w{1,120})'"
SPINNING = (
    r"AttributeError: (?:module )?'(?P<type>\w{1,120})'(?: object)? has no attribute "
    r"'(?P<name>spin_some|spin_all|spinOnce|spinSome|spin_forever)'"
)
STARTS = ("start", "Start", "run", "begin", "start_timer", "startTimer", "enable", "schedule")
OTHERWISE = {
    **dict.fromkeys(("stop", "Stop", "shutdown", "pause", "disable", "end", "close"), "cancel"),
    **dict.fromkeys(("restart", "resume"), "reset"),
}
"""Methods of other timers, and those of rclpy's that do it."""
OF_LOGGER = {
    **{name: name for name in LOG_METHODS},
    **{f"log_{name}": name for name in ("info", "warn", "error", "debug", "fatal")},
    **{"loginfo": "info", "logwarn": "warn", "logerr": "error", "logdebug": "debug"},
}


def _call_of(raised: Raised, name: str) -> ast.Call | None:
    """Return the only call of a method of this name in the statement of the line."""
    statement = statement_at(raised.module, raised.line)
    found = [
        n
        for n in (ast.walk(statement) if statement is not None else ())
        if isinstance(n, ast.Call) and isinstance(n.func, ast.Attribute) and n.func.attr == name
    ]
    return found[0] if len(found) == 1 else None


def _owner(call: ast.Call) -> ast.expr:
    return call.func.value if isinstance(call.func, ast.Attribute) else call.func


def _of_timer(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    module, name = raised.module, match["name"]
    if "Timer" in raised.source.known_classes or "threading" in module.imports:
        return None
    call = _call_of(raised, name)
    if call is None:
        return None
    code, owner = module.text.code(call), module.text.code(_owner(call))
    if name in OTHERWISE:
        written = f"{owner}.{OTHERWISE[name]}"
        params = {"name": f"{owner}.{name}", "written": written}
        return raised.finding("timer_method", at=call, params=params)
    if name not in STARTS:
        return None
    statement = statement_at(module, raised.line)
    alone = isinstance(statement, ast.Expr) and statement.value is call
    if alone and isinstance(_owner(call), ast.Name | ast.Attribute):
        return replace(raised.finding("timer_method", at=call, name=name), variant="starts")
    if not isinstance(_owner(call), ast.Call) or "\n" in code:
        return None
    params = {"name": code, "written": owner}
    return replace(raised.finding("timer_method", at=call, params=params), variant="chained")


def _without_start(case: Case) -> Files | None:
    """Delete the line that starts the timer."""
    return lines.deleted(case) if case.finding.params.get("name") in STARTS else None


def _spins(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A function of rclcpp or of ROS 1 spins the node."""
    module, name, source = raised.module, match["name"], raised.source
    call = _call_of(raised, name)
    owner = dotted(_owner(call)) if call is not None else ""
    own = match["type"] in source.class_names
    if call is None or call.keywords or not owner or owner == "self":
        return None
    if match["type"] != "rclpy" and not own and not match["type"].endswith("Executor"):
        return None
    given = [owner] if own else [module.text.code(a) for a in call.args]
    before = "rclpy" if own else owner
    function = function_at(module, raised.line)
    loops = [n for n in module.around(call) if isinstance(n, ast.While | ast.For)]
    inside = [n for n in loops if function is None or n in ast.walk(function)]
    once = bool(inside) and name != "spin_forever"
    if once and len(inside[0].body) > 1:
        given.append("timeout_sec=0.0")
    written = f"{before}.{'spin_once' if once else 'spin'}({', '.join(given)})"
    params = {"name": module.text.code(call), "written": written}
    found = raised.finding("spin_of_others", at=call, params=params)
    return replace(found, words={**found.words, "call": name})


def _of_logger(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A method of the logger is called on the node."""
    name, source = match["name"], raised.source
    call = _call_of(raised, name)
    owner = dotted(_owner(call)) if call is not None else ""
    if match["type"] not in source.class_names or name not in OF_LOGGER or call is None:
        return None
    if not owner or owner not in {"self", *source.node_variables} or name in source.methods:
        return None
    params = {"name": f"{owner}.{name}", "written": f"{owner}.get_logger().{OF_LOGGER[name]}"}
    return raised.finding("logger_of_node", at=call, params=params)


_node = Family("node", links.RCLPY)
KINDS = (
    _node(
        "timer_method",
        "timer",
        msg("A timer of ROS does not have this method"),
        msg(
            "A timer of rclpy runs from the moment when create_timer makes it. It has cancel(), "
            "which stops it, and reset(), which lets it begin again."
        ),
        msg("Write {written} instead of {name}."),
        fixes={
            "starts": msg("Delete this line: the timer runs already."),
            "chained": msg("Write {written} instead of {name}: the timer runs already."),
        },
        raised={OF_TIMER: _of_timer},
        fixed_by=(lines.written, _without_start),
        deletes=("starts",),
        examples=(
            example(
                "timer_started",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.timer_ = self.create_timer(1.0, self.timer_callback)\n"
                    "        self.timer_.start()",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "spin_of_others",
        "spin",
        msg("A spin function is called that rclpy does not have"),
        msg(
            "rclpy has no {call}. Its spin() runs callbacks until Ctrl+C; its spin_once() waits for "
            "one callback, runs it and returns, and belongs in a loop."
        ),
        msg("Write {written} instead of {name}."),
        links.EXECUTORS,
        raised={SPINNING: _spins},
        fixed_by=(lines.written,),
        examples=(
            example(
                "spin_some_of_cpp",
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin_some(node)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "logger_of_node",
        "logger",
        msg("A method of the logger is called on the node"),
        msg("A node does not log by itself: get_logger() returns its logger, which does."),
        msg("Write {written} instead of {name}."),
        links.LOGGING,
        raised={OWN_ATTRIBUTE: _of_logger},
        fixed_by=(lines.written,),
        examples=(
            example(
                "info_of_node",
                Replace(NODE, "self.get_logger().info", "self.info"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
