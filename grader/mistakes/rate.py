"""The mistake of waiting for a rate, which only spin wakes."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.names import dotted


def _rates(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a rate that sleeps on the thread that must spin."""
    source = suspect.source
    rates = {
        target
        for node in source.all_nodes
        if isinstance(node, ast.Assign) and dotted(node.value).endswith("create_rate()")
        for target in map(dotted, node.targets)
    }
    for call, name in source.calls:
        owner, _, method = name.rpartition(".")
        if method != "sleep" or (owner not in rates and not owner.endswith("create_rate()")):
            continue
        if source.calls_of("Thread", "MultiThreadedExecutor"):
            return None  # (another thread can spin while this one waits)
        found = suspect.finding("rate_sleep", call, name=name)
        around = source.module_of(call).around(call)
        loops = any(isinstance(part, ast.While | ast.For) for part in around)
        if not source.timers:
            return found
        if not loops:
            return replace(found, variant="alone")
        made = sorted({row.lineno for row in source.calls_of("create_rate")})
        function = source.function_around(call)
        own = function.name if function is not None else ""
        words = {**found.words, "line": ", ".join(map(str, made)), "method": own}
        return replace(found, words=words, variant="spins" if function is source.main else "timer")
    return None


ALONE = msg(
    "Remove this line, and the line that creates the rate if it is another one. The timer already calls "
    "{callback} in each period."
)
_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "rate_sleep",
        "timer",
        msg("A rate waits forever"),
        msg(
            "rclpy.spin wakes a rate. While {name}() waits, nothing spins, so nothing ever wakes "
            "it."
        ),
        msg(
            "Remove the rate and the loop around it, and keep what the loop does once. A timer "
            "repeats it: write self.create_timer({period}, self.{callback}) in __init__, and call "
            "rclpy.spin with the node in {function}."
        ),
        links.EXECUTORS,
        fixes={
            "spins": msg(
                "Write rclpy.spin({node}) instead of the whole loop, and delete the line that creates "
                "the rate (line {line}). The timer already calls {callback} in each period."
            ),
            "timer": msg(
                "Delete the loop and the rate (lines {line}), and keep what the loop does once. "
                "The timer already calls {method} in each period."
            ),
            "alone": ALONE,
        },
        behind={
            "run.no_lines": _rates,
            "run.stops": _rates,
            "run.no_node": _rates,
            "run.never_spins": _rates,
        },
        examples=(
            example(
                "rate_in_place_of_spin_beside_a_timer",
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n    except",
                    "        rate = node.create_rate(1)\n        while rclpy.ok():\n"
                    "            rate.sleep()\n    except",
                ),
                fails="run.spins",
                blocks=("run.output", "run.logger", "run.period"),
            ),
            example(
                "rate_in_callback",
                Replace(
                    NODE,
                    "self.counter_ += 1",
                    "self.counter_ += 1\n        self.create_rate(1.0).sleep()",
                ),
                fails="run.output",
                blocks=("run.period",),
            ),
            example(
                "rate_sleeps_in_main",
                Replace(NODE, "        self.create_timer(1.0, self.timer_callback)\n", ""),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    (
                        "        rate = node.create_rate(1.0)\n"
                        "        while rclpy.ok():\n"
                        "            node.timer_callback()\n"
                        "            rate.sleep()\n"
                    ),
                ),
                fails="run.spins",
                also={"run.output": "node.rate_sleep"},
                blocks=("run.period",),
            ),
        ),
    ),
)
