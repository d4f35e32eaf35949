"""Mistakes in where and how often the timer is created."""

from __future__ import annotations

import ast
import re

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, SILENT, example
from grader.mistakes.fixes import node_callback, timer_place
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.after_spin import timer_after_spin
from grader.package.source.names import dotted


def _after_spin(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only timers in lines that do not run before spin returns."""
    found = timer_after_spin(suspect.source)
    return suspect.finding("timer_after_spin", found[0], **_words(*found)) if found else None


def _created_at_end(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The same after Ctrl+C has shut ROS down: now the line runs, and fails."""
    del match
    found = timer_after_spin(raised.source)
    return raised.finding("timer_after_spin", at=found[0], params=_words(*found)) if found else None


def _words(call: ast.Call, spin: ast.Call) -> dict[str, str]:
    name = f"{dotted(call.func)}(…)" if call.args else f"{dotted(call.func)}()"
    return {"name": name, "line": str(spin.lineno)}


def _in_callback(suspect: Suspect) -> RecognisedMistake | None:
    timers, callback = suspect.source.timers, suspect.source.callback
    if callback is None or not timers or any(t.function is not callback for t in timers):
        return None
    return suspect.finding("timer_in_callback", timers[0].call)


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "timer_after_spin",
        "timer",
        msg("The timer is created below rclpy.spin"),
        msg(
            "rclpy.spin on line {line} waits until Ctrl+C. No line below it runs before that: "
            "{name} comes too late, and while the node spins there is no timer."
        ),
        msg(
            "Move this line above line {line}, the call of rclpy.spin, indented as far as that line."
        ),
        links.EXECUTORS,
        raised={r"failed to create timer: the given context is not valid": _created_at_end},
        behind={"run.no_lines": _after_spin},
        deletes=("",),
        fixed_by=(timer_place.above_spin,),
        examples=(
            example(
                "timer_created_after_try",
                Replace(NODE, "        self.create_timer(1.0, self.timer_callback)\n", ""),
                Replace(
                    NODE,
                    "    finally:\n        node.destroy_node()\n        rclpy.try_shutdown()\n",
                    "    node.timer_ = node.create_timer(1.0, node.timer_callback)\n"
                    "    rclpy.try_shutdown()\n",
                ),
                fails="run.output",
                also={"run.interrupt": "node.timer_after_spin"},
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "timer_in_callback",
        "timer",
        msg("The timer is created in its own callback"),
        msg("The timer calls the callback: as long as there is no timer, nothing calls it."),
        msg("Move create_timer to __init__."),
        behind={"run.no_lines": _in_callback},
        fixed_by=(node_callback.into_constructor,),
        examples=(
            example(
                "timer_in_callback",
                Replace(NODE, "        self.create_timer(1.0, self.timer_callback)\n", ""),
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    (
                        "self.create_timer(1.0, self.timer_callback)\n"
                        "        self.get_logger().info('Hello time: ' + str(self.counter_))"
                    ),
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
)
