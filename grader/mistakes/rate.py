"""The mistake of waiting for a rate, which only spin wakes."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import node_rates
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.names import dotted, last_part


def _rates(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a rate that sleeps on the thread that must spin."""
    rates = {
        target
        for node in suspect.source.all_nodes
        if isinstance(node, ast.Assign) and dotted(node.value).endswith("create_rate()")
        for target in map(dotted, node.targets)
    }
    threads = any(last_part(name) == "Thread" for _, name in suspect.source.calls)
    for call, name in suspect.source.calls if not threads else []:
        before, _, method = name.rpartition(".")
        if method == "sleep" and (before in rates or before.endswith("create_rate()")):
            found = suspect.finding("rate_sleep", call, name=name)
            around = suspect.source.module_of(call).around(call)
            looped = any(isinstance(part, ast.While | ast.For) for part in around)
            if not looped:
                return replace(found, variant="alone")
            in_main = suspect.source.function_around(call) is suspect.source.main
            spun = {"node": _spun(suspect, before)}
            return replace(found, variant="main" if in_main else "", words={**found.words, **spun})
    return None


def _spun(suspect: Suspect, rate: str) -> str:
    """Return the variable of the node that made a rate."""
    for node in suspect.source.all_nodes:
        if isinstance(node, ast.Assign) and rate in map(dotted, node.targets):
            return dotted(node.value).removesuffix(".create_rate()") or "node"
    return rate.removesuffix(".create_rate()") or "node"


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
            "Remove the rate and its loop. A timer calls the callback again and again: "
            "self.create_timer({period}, self.{callback})"
        ),
        links.EXECUTORS,
        fixes={
            "main": msg(
                "Delete the loop and the line that creates the rate. Write "
                "self.create_timer({period}, self.{callback}) in __init__: the timer calls it "
                "again and again. Write rclpy.spin({node}) in {function} in the place of the loop."
            ),
            "alone": msg(
                "Remove this line, and the line that creates the rate. The timer already calls "
                "{callback} in each period."
            ),
        },
        behind={
            "run.no_lines": _rates,
            "run.stops": _rates,
            "run.no_node": _rates,
            "run.never_spins": _rates,
        },
        fixed_by=(node_rates.spin_for_rate,),
        examples=(
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
