"""Mistakes in where and how often the timer is created."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, SILENT, STEP_LINE, example
from grader.mistakes.fixes import node_count, timer_place
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.after_spin import timer_after_spin
from grader.package.source.endless import calls_of_methods
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part


def _again(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a timer that is created in what a timer calls, also through a method of it."""
    source = suspect.source
    called = {timer.method for timer in source.timers}
    for timer in source.timers:
        function = timer.function
        if function is None or source.methods.get(function.name) is not function:
            continue
        others = [t for t in source.timers if t.function is not function]
        callers = [
            method.name
            for method in source.methods.values()
            if method is function or function in (m for _, m in calls_of_methods(source, method))
        ]
        by_timer = [name for name in callers if name in called]
        if not by_timer or not others or _ends_timers(function):
            continue
        if timer.method in by_timer and function.name in by_timer:
            return suspect.finding("timer_again", timer.call, name=function.name)
        if others[0].method == function.name and timer.method in source.methods:
            words = {"name": function.name, "method": timer.method}
            return replace(suspect.finding("timer_again", timer.call, **words), variant="other")
    return _again_by_call(suspect)


def _again_by_call(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a call of a method that only creates the timer, in that timer's own callback."""
    source, callback = suspect.source, suspect.source.callback
    timer = source.timers[0] if len(source.timers) == 1 else None
    if timer is None or callback is None or timer.method != callback.name:
        return None
    maker = timer.function
    if maker is None or maker is callback or source.methods.get(maker.name) is not maker:
        return None
    code = [s for s in maker.body if not _is_text(s)]
    calls = [s for s in callback.body if isinstance(s, ast.Expr) and _calls(s.value, maker)]
    made_first = any(
        _calls(call, maker) for call, _ in source.calls if call not in ast.walk(callback)
    )
    if len(code) != 1 or len(calls) != 1 or not made_first or _ends_timers(callback):
        return None
    return suspect.finding("timer_again", calls[0], name=callback.name)


def _calls(call: ast.expr, method: Function) -> bool:
    return isinstance(call, ast.Call) and last_part(dotted(call.func)) == method.name


def _is_text(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)


def _ends_timers(function: Function) -> bool:
    return any(last_part(name) in ("cancel", "destroy_timer") for _, name in calls_in(function))


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


def _two(suspect: Suspect) -> RecognisedMistake | None:
    timers = suspect.source.timers
    return suspect.finding("two_timers", timers[1].call) if len(timers) > 1 else None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "timer_again",
        "timer",
        msg("Each call of the callback creates one more timer"),
        msg(
            "A timer repeats by itself: it calls its callback in each period, not only once. With one "
            "more timer from each call of {name} there are more and more timers, and as many lines "
            "at a time."
        ),
        msg("Delete this line. The timer that is created first goes on by itself."),
        fixes={
            "other": msg(
                "Delete this line, and give {method} instead of {name} to the timer that calls "
                "{name}."
            )
        },
        behind={
            "run.twice": _again,
            "run.wrong_period": _again,
            "run.too_much_output": _again,
        },
        fixed_by=(timer_place.only_first,),
        examples=(
            example(
                "timer_again_in_callback",
                Replace(
                    NODE,
                    STEP_LINE,
                    f"{STEP_LINE}        self.create_timer(1.0, self.timer_callback)  # next\n",
                ),
                fails="run.output",
            ),
            example(
                "timer_again_by_method",
                Replace(NODE, "self.create_timer(1.0, self.timer_callback)", "self.start()"),
                Replace(NODE, STEP_LINE, f"{STEP_LINE}        self.start()  # next\n"),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def start(self):\n"
                    "        self.create_timer(1.0, self.timer_callback)\n\n"
                    "    def timer_callback",
                ),
                fails="run.output",
            ),
            example(
                "timer_of_timer",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.create_timer(1.0, self.start)",
                ),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def start(self):\n"
                    "        self.create_timer(1.0, self.timer_callback)\n\n"
                    "    def timer_callback",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "timer_hides_method",
        "timer",
        msg("The timer is assigned to the name of its own callback"),
        msg(
            "It works, because create_timer gets the method before the name is assigned. From then "
            "on, self.{name} is the timer, and the method can no longer be called by this name."
        ),
        msg("Use another name for the timer, for example self.timer_."),
    ),
    _node(
        "timer_after_spin",
        "timer",
        msg("The timer is created below rclpy.spin"),
        msg(
            "rclpy.spin on line {line} waits until Ctrl+C. The lines below it run only after that: "
            "{name} comes too late, and while the node spins there is no timer."
        ),
        msg("Move this line above line {line}, the call of rclpy.spin."),
        links.EXECUTORS,
        raised={r"failed to create timer: the given context is not valid": _created_at_end},
        behind={"run.no_lines": _after_spin},
        fixed_by=(timer_place.above_spin,),
        examples=(
            example(
                "timer_started_after_spin",
                Replace(NODE, "        self.create_timer(1.0, self.timer_callback)\n", ""),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def start(self):\n"
                    "        self.create_timer(1.0, self.timer_callback)\n\n"
                    "    def timer_callback",
                ),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        rclpy.spin(node)\n        node.start()\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
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
    _node(
        "two_timers",
        "timer",
        msg("Two timers call the callback"),
        msg("Each timer calls its callback on its own: two timers make two lines at a time."),
        msg("Keep only one create_timer."),
        behind={"run.twice": _two},
        fixed_by=(node_count.twice,),
        examples=(
            example(
                "two_timers",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    (
                        "self.create_timer(1.0, self.timer_callback)\n"
                        "        self.create_timer(1.0, self.timer_callback)"
                    ),
                ),
                fails="run.output",
            ),
        ),
    ),
)
