"""Names that rospy, rclcpp or Python have, and that are written as names of rclpy."""

from __future__ import annotations

import ast
import builtins
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, STEP_LINE, example
from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.names import dotted, last_part
from grader.package.source.node import LOG_METHODS
from grader.package.source.node_here import node_here
from grader.package.source.place import block_of, function_at

OF_RCLPY = r"module '(?P<module>rclpy(?:\.\w{1,60})?)' has no attribute '(?P<name>\w{1,120})'"
OF_ROSPY = ("ROSInterruptException", "ROSException", "ROSInitException")
"""Exceptions of rospy; Ctrl+C raises the first in a ROS 1 node."""
CTRL_C = "KeyboardInterrupt"
SHUTDOWN = "ExternalShutdownException"


def _used(raised: Raised, name: str) -> Iterator[ast.Attribute]:
    """Yield where the line reads a name of a module."""
    for part in raised.module.nodes:
        here = isinstance(part, ast.Attribute) and part.lineno == raised.line
        if not here or not isinstance(part, ast.Attribute) or part.attr != name:
            continue
        if dotted(part.value).partition(".")[0] in ("rclpy", "rospy"):
            yield part


def _looked_up(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    used = list(_used(raised, match["name"]))
    return _told(raised, used[0]) if len(used) == 1 else None


def _of_rospy(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """An exception of rospy, which is not imported, is caught."""
    if match["name"] != "rospy":
        return None
    used = [part for name in OF_ROSPY for part in _used(raised, name)]
    return _caught(raised, used[0]) if len(used) == 1 else None


def _told(raised: Raised, used: ast.Attribute) -> RecognisedMistake | None:
    caught = _caught(raised, used)
    if caught is not None:
        return caught
    text, parents, name = raised.module.text, raised.module.parents, used.attr
    code, around = text.code(used), parents.get(used)
    call = around if isinstance(around, ast.Call) and around.func is used else None
    if name == "sleep" and call is not None and isinstance(parents.get(call), ast.Expr):
        return _sleep(raised, call)
    if name == "Node":
        written = "Node" if "Node" in raised.module.imports else ""
        return _instead(raised, used, code, written) if written else None
    if name == "Time" and isinstance(around, ast.Attribute) and around.attr == "now":
        own = function_at(raised.module, raised.line) in raised.source.own_methods
        return _instead(raised, used, f"{code}.now", "self.get_clock().now") if own else None
    if last_part(dotted(used.value)) == "logging" and name in LOG_METHODS:
        own = function_at(raised.module, raised.line) in raised.source.own_methods
        return _instead(raised, used, code, f"self.get_logger().{name}") if own else None
    return _called(raised, used, call) if call is not None else None


def _called(raised: Raised, used: ast.Attribute, call: ast.Call) -> RecognisedMistake | None:
    text, parents = raised.module.text, raised.module.parents
    given = call.args[0] if call.args else None
    if used.attr == "signal_shutdown":
        return _instead(raised, used, text.code(call), "rclpy.try_shutdown()")
    if used.attr == "make_shared" and given is not None and raised.source.is_node_class(given):
        return _instead(raised, used, text.code(call), f"{dotted(given)}()")
    timer = parents.get(call)
    of_timer = isinstance(timer, ast.Call) and last_part(dotted(timer.func)) == "create_timer"
    if used.attr == "Duration" and of_timer and isinstance(given, ast.Constant):
        found = _instead(raised, used, text.code(call), text.code(given))
        return replace(found, variant="duration")
    return None


def _sleep(raised: Raised, call: ast.Call) -> RecognisedMistake | None:
    statement = raised.module.parents[call]
    if not isinstance(statement, ast.stmt):
        return None
    found = _instead(raised, call, raised.module.text.code(call), "")
    node = node_here(raised.source, raised.module, raised.line) or "node"
    looped = any(isinstance(n, ast.While | ast.For) for n in raised.module.around(statement))
    if looped and not raised.source.timers:
        return replace(found, variant="sleep_loop", words={**found.words, "node": node})
    if len(block_of(raised.module, statement)) > 1:
        return replace(found, variant="sleep")
    around = raised.module.parents.get(statement)
    if not isinstance(around, ast.While | ast.For | ast.If) or around.orelse:
        return None
    return replace(found, variant="sleep_alone", words={**found.words, "line": around.lineno})


def _caught(raised: Raised, used: ast.Attribute) -> RecognisedMistake | None:
    """The name is that of an exception that an except catches."""
    module, name = raised.module, used.attr
    around = list(module.around(used))
    handler = next((n for n in around if isinstance(n, ast.ExceptHandler)), None)
    block = next((n for n in around if isinstance(n, ast.Try)), None)
    if (
        handler is None
        or block is None
        or handler.type is None
        or used not in ast.walk(handler.type)
    ):
        return None
    known = isinstance(getattr(builtins, name, None), type)
    written = CTRL_C if name in OF_ROSPY else name if known else ""
    if name == SHUTDOWN:
        written = f"rclpy.executors.{SHUTDOWN}"
    if not written:
        return None
    code = module.text.code(used)
    others = [h for h in block.handlers if h is not handler and h.type is not None]
    if any(written in ast.unparse(h.type) for h in others if h.type is not None):
        found = _instead(raised, used, code, "")
        words = {**found.words, "exception": name}
        return replace(found, variant="caught_twice", words=words) if name in OF_ROSPY else None
    listed = handler.type.elts if isinstance(handler.type, ast.Tuple) else []
    rest = [module.text.code(n) for n in listed if n is not used]
    if written in rest:
        code = module.text.code(handler.type)
        written = rest[0] if len(rest) == 1 else f"({', '.join(rest)})"
    found = _instead(raised, used, code, written)
    words = {**found.words, "exception": name}
    return replace(found, variant="caught" if name in OF_ROSPY else "", words=words)


def _instead(
    raised: Raised, at: ast.Attribute | ast.Call, name: str, written: str
) -> RecognisedMistake:
    return raised.finding("not_in_rclpy", at=at, params={"name": name, "written": written})


def _without_sleep(case: Case) -> Files | None:
    asleep = str(case.finding.params.get("name", "")).partition("(")[0].endswith(".sleep")
    return lines.deleted(case) if asleep else None


_node = Family("node", links.RCLPY)
KINDS = (
    _node(
        "not_in_rclpy",
        "start",
        msg("rclpy does not have this name"),
        msg(
            "rclpy has nothing with the name {name}: it belongs to another module, object or library."
        ),
        msg("Write {written} instead of {name}."),
        whys={
            "caught": msg(
                "{exception} belongs to ROS 1, and ROS 2 does not have it. In ROS 2, Ctrl+C raises "
                "KeyboardInterrupt, as in every Python program."
            ),
            "caught_twice": msg("{exception} belongs to ROS 1, and ROS 2 does not have it."),
            "sleep": msg(
                "rclpy has no sleep. The timer calls the callback once in each period, without it."
            ),
            "sleep_alone": msg(
                "rclpy has no sleep. The timer calls the callback once in each period, without it."
            ),
            "sleep_loop": msg(
                "rclpy has no sleep. In ROS 2, a timer calls a function once in each period, and spin "
                "waits for the timer."
            ),
            "duration": msg("create_timer takes the period as a number of seconds."),
        },
        fixes={
            "caught_twice": msg(
                "Delete this except and the lines of its block: another except of this try catches "
                "what Ctrl+C raises."
            ),
            "sleep": msg("Delete this line."),
            "sleep_loop": msg(
                "Write the lines of the loop that log and count into a function of their own, and let "
                "a timer call it: {node}.create_timer({period}, and the name of that function). Then "
                "write rclpy.spin({node}) instead of the loop."
            ),
            "sleep_alone": msg(
                "Delete this line, and line {line}, which begins its block: the block has no other "
                "line."
            ),
        },
        raised={OF_RCLPY: _looked_up, NAME_ERROR: _of_rospy},
        fixed_by=(lines.written, _without_sleep),
        examples=(
            example(
                "interrupt_of_rospy",
                Replace(NODE, "except KeyboardInterrupt", "except rclpy.ROSInterruptException"),
                fails="run.interrupt",
            ),
            example(
                "sleep_of_rclpy",
                Replace(NODE, STEP_LINE, f"{STEP_LINE}        rclpy.sleep(1.0)\n"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "duration_of_rclpy",
                Replace(NODE, "create_timer(1.0,", "create_timer(rclpy.Duration(1.0),"),
                fails="run.starts",
            ),
            example(
                "logging_of_rclpy",
                Replace(NODE, "self.get_logger().info", "rclpy.logging.info"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
