"""The mistake of waiting for a rate, which only spin wakes."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import Value, msg
from grader.mistakes import links
from grader.mistakes.example import LOG_LINE, NODE, STEP_LINE, example
from grader.mistakes.fixes import node_rates
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.names import SPINS, calls_in, dotted, last_part, own_name
from grader.package.source.node import NodeSource


def _rates(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a rate that sleeps on the thread that must spin."""
    rates = {
        target
        for node in suspect.source.all_nodes
        if isinstance(node, ast.Assign) and dotted(node.value).endswith("create_rate()")
        for target in map(dotted, node.targets)
    }
    threads = any(last_part(name) == "Thread" for _, name in suspect.source.calls)
    several = bool(suspect.source.calls_of("MultiThreadedExecutor"))
    for call, name in suspect.source.calls if not threads else []:
        before, _, method = name.rpartition(".")
        if method == "sleep" and (before in rates or before.endswith("create_rate()")):
            found = suspect.finding("rate_sleep", call, name=name)
            around = suspect.source.module_of(call).around(call)
            loops = [part for part in around if isinstance(part, ast.While | ast.For)]
            if not loops:
                return _without_loop(suspect, found, call, several=several)
            if several:
                return None  # (another thread can spin while the loop waits)
            spun = _spun(suspect, before)
            if spun.startswith("self"):
                spun = next(iter(sorted(suspect.source.node_variables)), "node")
            found = replace(found, words={**found.words, "node": spun})
            return _in_loop(suspect, found, loops[0])
    return None


def _without_loop(
    suspect: Suspect, found: RecognisedMistake, call: ast.Call, *, several: bool
) -> RecognisedMistake | None:
    """Return the finding of a rate in a method that a timer calls, or a loop of the entry function."""
    source = suspect.source
    if source.timers:
        return replace(found, variant="threads" if several else "alone")
    function = source.function_around(call)
    loops = [n for n in ast.walk(source.main or ast.Module([], [])) if isinstance(n, ast.While)]
    for loop in loops if function is not None else []:
        for _, name in calls_in(loop):
            owner, _, method = name.rpartition(".")
            if function is source.methods.get(method) and owner in source.node_variables:
                rows = {call.lineno, *_rows_of_rates(source)}
                words: dict[str, Value] = {
                    **found.words,
                    "method": method,
                    "node": owner,
                    "line": ", ".join(map(str, sorted(rows))),
                    "at": loop.lineno,
                }
                return replace(found, variant="looped", words=words)
    return None


def _in_loop(
    suspect: Suspect, found: RecognisedMistake, loop: ast.While | ast.For
) -> RecognisedMistake:
    """Return the finding of a rate in a loop, with what to write in its place."""
    source = suspect.source
    function = source.function_around(loop)
    once = [call for call, name in calls_in(loop) if last_part(name) in SPINS]
    only_sleeps = len(loop.body) == 1 and isinstance(loop.body[0], ast.Expr)
    if function is source.main and (once or only_sleeps) and source.timers:
        made = ", ".join(map(str, _rows_of_rates(source)))
        words_of: dict[str, Value] = {**found.words, "line": made}
        if once and once[0].args:
            words_of["node"] = ast.unparse(once[0].args[0])
        return replace(found, words=words_of, variant="spins")
    if function is source.main:
        return replace(found, variant="main" if _calls_method(source, loop) else "inline")
    method = function.name if function is not None else ""
    if function is None or source.methods.get(method) is not function:
        return replace(found, variant="inline")
    if method == "__init__":
        return replace(found, variant="constructor")
    rows = {found.where.line if found.where else None, loop.lineno, *_rows_of_rates(source)}
    lines = ", ".join(map(str, sorted(row for row in rows if row)))
    words: dict[str, Value] = {**found.words, "method": method, "line": lines}
    if any(timer.method == method for timer in source.timers):
        return replace(found, variant="timer", words=words)
    in_main = list(calls_in(source.main)) if source.main is not None else []
    for call, name in in_main:
        if last_part(name) == method:
            owner = call.func.value if isinstance(call.func, ast.Attribute) else None
            node = ast.unparse(owner) if owner is not None else "node"
            spins = any(last_part(name) == "spin" for _, name in in_main)
            words |= {"written": ast.unparse(call), "at": call.lineno, "node": node}
            return replace(found, variant="method_spun" if spins else "method", words=words)
    init = source.methods.get("__init__")
    for call, _ in calls_in(init) if init is not None else ():
        if own_name(call.func) == method:
            words |= {"written": ast.unparse(call), "at": call.lineno}
            return replace(found, variant="called", words=words)
    return replace(found, words=words)


def _calls_method(source: NodeSource, loop: ast.While | ast.For) -> bool:
    """Whether a loop calls a method of the node's class."""
    return any(last_part(name) in source.methods for _, name in calls_in(loop))


def _rows_of_rates(source: NodeSource) -> set[int]:
    """Return the lines that create a rate."""
    return {call.lineno for call, name in source.calls if last_part(name) == "create_rate"}


def _spun(suspect: Suspect, rate: str) -> str:
    """Return the variable of the node that made a rate."""
    for node in suspect.source.all_nodes:
        if isinstance(node, ast.Assign) and rate in map(dotted, node.targets):
            return dotted(node.value).removesuffix(".create_rate()") or "node"
    return rate.removesuffix(".create_rate()") or "node"


MAIN_CALLS = msg(
    "Delete the loop and the rate (lines {line}), and keep what the loop does once: a timer repeats "
    "it. Write self.create_timer({period}, self.{method}) in __init__, and rclpy.spin({node}) in "
    "{function} in the place of {written} (line {at})."
)
ALONE = msg(
    "Remove this line, and the line that creates the rate if it is another one. The timer already calls "
    "{callback} in each period."
)
IN_METHOD = (
    Replace(NODE, "        self.create_timer(1.0, self.timer_callback)\n", ""),
    Replace(NODE, "    def timer_callback(self):\n", "    def run(self):\n"),
    Replace(
        NODE,
        f"{LOG_LINE}{STEP_LINE}",
        "        rate = self.create_rate(1.0)\n"
        "        while rclpy.ok():\n"
        f"    {LOG_LINE}    {STEP_LINE}"
        "            rate.sleep()\n",
    ),
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
        whys={
            "threads": msg(
                "{name}() waits in a callback, and the callback does not return as long as it waits: the "
                "timer cannot call it again."
            ),
            "method": msg(
                "rclpy.spin wakes a rate. {function} calls {written} in its place, and the loop of "
                "{method} waits in {name}(): nothing spins, so nothing ever wakes the rate."
            ),
        },
        fixes={
            "spins": msg(
                "Write rclpy.spin({node}) instead of the whole loop, and delete the line that creates "
                "the rate (line {line}). The timer already calls {callback} in each period."
            ),
            "main": msg(
                "Delete the loop and the line that creates the rate. Write "
                "self.create_timer({period}, self.{callback}) in __init__: the timer calls it "
                "again and again. Write rclpy.spin({node}) in {function} in the place of the loop."
            ),
            "inline": msg(
                "Delete the loop and the line that creates the rate. Put what the loop does into "
                "a method {callback} of the node's class, write self.create_timer({period}, "
                "self.{callback}) in __init__, and call rclpy.spin with the node in {function}."
            ),
            "constructor": msg(
                "Put what the loop does into a method {callback}. Write self.create_timer({period}, "
                "self.{callback}) in __init__ instead of the loop, and delete the line that "
                "creates the rate. rclpy.spin in {function} then calls {callback} again and again."
            ),
            "timer": msg(
                "Delete the loop and the rate (lines {line}), and keep what the loop does once. "
                "The timer already calls {method} in each period."
            ),
            "looped": msg(
                "Delete the rate (lines {line}). Write self.create_timer({period}, self.{method}) in "
                "__init__: the timer calls it again and again. Write rclpy.spin({node}) in {function} in "
                "the place of the loop (line {at})."
            ),
            "method": MAIN_CALLS,
            "method_spun": msg(
                "Delete the loop and the rate (lines {line}), and keep what the loop does once: "
                "a timer repeats it. Write self.create_timer({period}, self.{method}) in "
                "__init__. Delete {written} in {function} (line {at}), so that rclpy.spin is "
                "reached."
            ),
            "called": msg(
                "Write self.create_timer({period}, self.{method}) instead of {written} (line {at}). "
                "Delete the loop and the rate (lines {line}), and keep what the loop does once: the "
                "timer repeats it."
            ),
            "alone": ALONE,
            "threads": ALONE,
        },
        behind={
            "run.no_lines": _rates,
            "run.stops": _rates,
            "run.no_node": _rates,
            "run.never_spins": _rates,
        },
        fixed_by=(node_rates.spin_for_rate, node_rates.timer_for_loop),
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
                "rate_beside_spin_once",
                Replace(
                    NODE,
                    "node = MyFirstNode()",
                    "node = MyFirstNode()\n    rate = node.create_rate(1)",
                ),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        while rclpy.ok():\n            rclpy.spin_once(node)\n            rate.sleep()\n",
                ),
                fails="run.spins",
                blocks=("run.output", "run.logger", "run.period"),
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
            example(
                "rate_sleeps_in_a_method",
                *IN_METHOD,
                Replace(NODE, "rclpy.spin(node)", "node.run()"),
                fails="run.spins",
                also={"run.output": "node.rate_sleep"},
                blocks=("run.period",),
                note="as in ROS 1: main calls the loop, and nothing spins",
            ),
            example(
                "rate_sleeps_in_a_method_of_mains_loop",
                Replace(NODE, "        self.create_timer(1.0, self.timer_callback)\n", ""),
                Replace(
                    NODE,
                    "        self.counter_ = 0\n",
                    "        self.counter_ = 0\n        self.rate_ = self.create_rate(1.0)\n",
                ),
                Replace(NODE, LOG_LINE, f"        self.rate_.sleep()\n{LOG_LINE}"),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        while rclpy.ok():\n            node.timer_callback()\n",
                ),
                fails="run.spins",
                blocks=("run.output", "run.logger", "run.period"),
            ),
            example(
                "rate_sleeps_before_spin",
                *IN_METHOD,
                Replace(NODE, "    try:\n", "    node.run()\n    try:\n"),
                fails="run.spins",
                also={"run.output": "node.rate_sleep"},
                blocks=("run.period",),
            ),
        ),
    ),
)
