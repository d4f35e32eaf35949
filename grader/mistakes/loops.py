"""Mistakes in which a loop of the node does what a timer does, so that nothing spins."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, LOG_LINE, NODE, SILENT, STEP_LINE, example
from grader.mistakes.fixes import node_loops
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.endless import Loop, calls_of_methods, endless_loop, sleeps_in
from grader.package.source.names import calls_in, last_part

IMPORT = Replace(NODE, "import rclpy\nfrom", "import rclpy\nfrom time import sleep\nfrom")
TIMER_LINE = "        self.create_timer(1.0, self.timer_callback)\n"
WHILE_OK = Replace(
    NODE,
    LOG_LINE + STEP_LINE,
    f"        while rclpy.ok():\n    {LOG_LINE}    {STEP_LINE}            sleep(1.0)\n",
)


def _word(loop: Loop) -> str:
    return "while" if isinstance(loop, ast.While) else "for"


def _in_callback(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a loop that does not end, or that logs and sleeps, in what the timer calls."""
    source, callback = suspect.source, suspect.source.callback
    if callback is None or callback.name not in {timer.method for timer in source.timers}:
        return None
    if source.calls_of("create_rate"):
        return None  # (node.rate_sleep)
    for function in (callback, *(method for _, method in calls_of_methods(source, callback))):
        loop = endless_loop(source, function)
        made = any(isinstance(n, ast.Yield) for n in ast.walk(function))
        if made or source.calls_of("cancel", within=function):
            continue  # (a generator, or the work of one call)
        if loop is not None and (isinstance(loop, ast.While) or source.logs(loop)):
            found = suspect.finding("callback_repeats", loop, name=_word(loop))
            return replace(found, variant="sleep" if sleeps_in(source, loop) else "")
    return None


def _waits_for_an_answer(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a loop of the callback that waits until a future is done."""
    callback = suspect.source.callback
    for loop in ast.walk(callback) if callback is not None else ():
        for call, name in calls_in(loop.test) if isinstance(loop, ast.While) else ():
            if last_part(name) == "done" and not call.args and isinstance(call.func, ast.Attribute):
                module = suspect.source.module_of(loop)
                future = module.text.code(call.func.value)
                return suspect.finding("answer_waited", call, name=future)
    return None


def _in_constructor(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a loop that keeps __init__ from returning, in it or in a method that it calls."""
    source, init = suspect.source, suspect.source.methods.get("__init__")
    inner = [method for _, method in calls_of_methods(source, init)] if init is not None else []
    for function in (init, *inner):
        loop = endless_loop(source, function) if function is not None else None
        if loop is None or not (isinstance(loop, ast.While) or source.logs(loop)):
            continue
        found = suspect.finding("constructor_repeats", loop, name=_word(loop))
        spins = any(last_part(name).startswith("spin") for _, name in source.calls)
        variants = ("timer", "timer_unspun") if source.timers else ("", "unspun")
        return replace(found, variant=variants[0 if spins else 1])
    return None


UNSPUN = ("unspun", "timer_unspun")
NOT_SPUN = msg(
    "While this loop runs, __init__ does not return, and ROS can call no callback of the node. No line "
    "of the program spins the node: there is no rclpy.spin."
)
_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "answer_waited",
        "callback",
        msg("A callback waits for an answer"),
        msg(
            "This loop waits until {name} is done. ROS runs one callback at a time: what brings the answer "
            "can run only when {callback} has returned, so the loop never ends."
        ),
        msg(
            "Delete the loop. Put what needs the answer into a method of its own that gets the future, and "
            "pass this method to {name}.add_done_callback(…): ROS calls it when the answer has come."
        ),
        behind=dict.fromkeys(
            ("run.never_spins", "run.no_lines", "run.stops"), _waits_for_an_answer
        ),
        examples=(
            example(
                "callback_waits_for_a_future",
                IMPORT,
                Replace(
                    NODE,
                    "from rclpy.node import Node\n",
                    "from rclpy.node import Node\nfrom rclpy.task import Future\n",
                ),
                Replace(
                    NODE,
                    LOG_LINE,
                    "        future = Future()\n"
                    "        self.create_timer(0.1, lambda: future.set_result(1))\n"
                    "        while not future.done():\n"
                    f"            sleep(0.01)\n{LOG_LINE}",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "callback_repeats",
        "callback",
        msg("The callback repeats in a loop what the timer repeats"),
        msg(
            "The timer calls {callback} again in each period. While the loop in it runs, it does "
            "not return, and the timer cannot call it again."
        ),
        msg("Delete this {name}, and indent its lines as far as the {name} is indented now."),
        fixes={
            "sleep": msg(
                "Delete this {name} and the sleep in it, and indent its other lines as far as the "
                "{name} is indented now: the timer repeats them already."
            ),
        },
        behind=dict.fromkeys(
            ("run.never_spins", "run.no_lines", "run.stops", "run.twice", "run.too_much_output"),
            _in_callback,
        ),
        fixed_by=(node_loops.without_loop,),
        examples=(
            example(
                "while_and_sleep_in_callback",
                IMPORT,
                WHILE_OK,
                fails="run.spins",
            ),
            example(
                "while_ok_logs_in_callback",
                Replace(NODE, LOG_LINE, f"        while rclpy.ok():\n    {LOG_LINE}"),
                fails="run.output",
                blocks=("run.spins", *DEAD),
            ),
        ),
    ),
    _node(
        "constructor_repeats",
        "spin",
        msg("A loop keeps __init__ from returning, so spin is not reached"),
        msg(
            "{function} creates the node and then spins it. While this loop runs, __init__ does "
            "not return: rclpy.spin is not called, and ROS can call no callback of the node."
        ),
        msg(
            "Put the lines of the loop into a method, without the {name} and without a sleep, and "
            "create a timer here that calls it: self.create_timer({period}, self.{callback})"
        ),
        whys=dict.fromkeys(UNSPUN, NOT_SPUN),
        fixes={
            "unspun": msg(
                "Put the lines of the loop into a method, without the {name} and without a sleep, and "
                "create a timer here that calls it: self.create_timer({period}, self.{callback}) Then "
                "call rclpy.spin with the node in {function}."
            ),
            "timer_unspun": msg(
                "Delete this {name} with all its lines, and call rclpy.spin with the node in {function}: "
                "the timer calls {callback} in each period then."
            ),
            "timer": msg(
                "Delete this {name} with all its lines: the timer calls {callback} in each period."
            ),
        },
        deletes=("timer", "timer_unspun"),
        behind={
            "run.never_spins": _in_constructor,
            "run.no_lines": _in_constructor,
            "run.twice": _in_constructor,
        },
        examples=(
            example(
                "while_in_method_of_constructor",
                IMPORT,
                WHILE_OK,
                Replace(NODE, TIMER_LINE, "        self.timer_callback()\n"),
                fails="run.spins",
            ),
            example(
                "while_in_constructor_beside_timer",
                IMPORT,
                Replace(
                    NODE,
                    TIMER_LINE,
                    f"{TIMER_LINE}        while rclpy.ok():\n            self.timer_callback()\n"
                    "            sleep(1.0)\n",
                ),
                fails="run.spins",
            ),
            example(
                "while_in_constructor",
                IMPORT,
                Replace(
                    NODE,
                    TIMER_LINE,
                    "        while True:\n            self.timer_callback()\n"
                    "            sleep(1.0)\n",
                ),
                fails="run.spins",
            ),
        ),
    ),
)
