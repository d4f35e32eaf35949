"""Mistakes in the pace of the lines: a timer of another period, which something else holds back."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG_LINE, NODE, STEP_LINE, example
from grader.mistakes.fixes import node_pace, node_timer
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.measured import measured
from grader.package.source.period import is_right, seconds_of
from grader.package.source.sleeps import longest_sleep

SAME = 0.001  # seconds by which two equal periods differ at most


def _throttled(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a timer of another period whose lines the logger leaves out in part."""
    source, period = suspect.source, node_pace.period_of(suspect.source)
    option = node_pace.throttled(source)
    if period is None or option is None or abs(period[1] - suspect.period) < SAME:
        return None
    return suspect.finding(
        "timer_throttled", period[0], seconds=f"{period[1]:g}", line=option.value.lineno
    )


def _paced_by_sleep(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a timer of another period whose callback sleeps for at least that period."""
    source, period = suspect.source, node_pace.period_of(suspect.source)
    slept = longest_sleep(source)
    if period is None or slept is None or abs(period[1] - suspect.period) < SAME:
        return None
    if slept[1] < period[1]:
        return None
    return suspect.finding(
        "sleep_for_timer",
        period[0],
        seconds=f"{period[1]:g}",
        slept=f"{slept[1]:g}",
        line=slept[0].lineno,
    )


def _measures_time(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a callback that compares times where the timer itself waits."""
    source = suspect.source
    found = measured(source)
    given = source.timers[0].period if len(source.timers) == 1 else None
    if found is None or given is None or not found.needed:
        return None
    seconds = seconds_of(source, given)
    written = node_timer.value_of(source, given) or given
    mistake = suspect.finding(
        "measures_time",
        found.block,
        name=ast.unparse(found.block.test)[:60],
        line=written.lineno,
        others=", ".join(str(s.lineno) for s in found.needed),
    )
    right = is_right(seconds, suspect.period)
    variant = ("returns" if found.returns else "") + ("_right" if right else "")
    return replace(mistake, variant=variant.lstrip("_"))


_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "timer_throttled",
        "timer",
        msg("The timer has another period, and the logger leaves out lines"),
        msg(
            "The timer calls {callback} every {seconds} s. throttle_duration_sec only leaves out "
            "lines, and the count goes on without them."
        ),
        msg(
            "Write {period} as the period in this line, and remove throttle_duration_sec=… from "
            "line {line}."
        ),
        behind={
            "run.stops": _throttled,
            "run.wrong_step": _throttled,
            "run.wrong_period": _throttled,
        },
        fixed_by=(node_pace.unthrottled,),
        examples=(
            example(
                "timer_throttled",
                Replace(NODE, "create_timer(1.0,", "create_timer(0.1,"),
                Replace(
                    NODE, "str(self.counter_))", "str(self.counter_), throttle_duration_sec=60.0)"
                ),
                fails="run.output",
                blocks=("run.period",),
            ),
        ),
    ),
    _node(
        "sleep_for_timer",
        "timer",
        msg("A sleep holds back a timer of another period"),
        msg(
            "The timer is set to {seconds} s. Only the sleep of {slept} s in {callback} delays the "
            "next line: while a callback sleeps, the timer cannot call it again."
        ),
        msg(
            "Write {period} as the period in this line, and delete the sleep in line {line}: the "
            "timer alone makes the pauses."
        ),
        behind={"run.wrong_period": _paced_by_sleep},
        fixed_by=(node_pace.without_sleep,),
        examples=(
            example(
                "sleep_for_timer",
                Replace(NODE, "import rclpy\nfrom", "import time\nimport rclpy\nfrom"),
                Replace(NODE, "create_timer(1.0,", "create_timer(0.1,"),
                Replace(NODE, STEP_LINE, f"{STEP_LINE}        time.sleep(1)\n"),
                fails="run.period",
            ),
        ),
    ),
    _node(
        "measures_time",
        "timer",
        msg("The callback measures the time itself"),
        msg(
            "The timer calls {callback} when its period is over: no clock has to be read for that. "
            "The condition {name} measures the time once more. If it measures in another unit or from "
            "another moment, lines come too early, too late or not at all."
        ),
        msg(
            "Write {period} as the period in line {line}. Delete the line of this if, and indent its "
            "lines as far as the if is indented now. Delete what only the if needs (line {others})."
        ),
        fixes={
            "right": msg(
                "Delete the line of this if, and indent its lines as far as the if is indented now. "
                "Delete what only the if needs (line {others})."
            ),
            "returns": msg(
                "Write {period} as the period in line {line}. Delete this if with its return, and "
                "what only the if needs (line {others})."
            ),
            "returns_right": msg(
                "Delete this if with its return, and what only the if needs (line {others})."
            ),
        },
        behind={
            "run.wrong_period": _measures_time,
            "run.stops": _measures_time,
            "run.no_lines": _measures_time,
        },
        fixed_by=(node_pace.unmeasured,),
        examples=(
            example(
                "measures_milliseconds",
                Replace(NODE, "import rclpy\nfrom", "import time\nimport rclpy\nfrom"),
                Replace(NODE, "create_timer(1.0,", "create_timer(0.01,"),
                Replace(
                    NODE,
                    "        self.counter_ = 0\n",
                    "        self.counter_ = 0\n        self.last = 0\n",
                ),
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        now = time.time() * 1000\n"
                    "        if now - self.last >= 1000:\n"
                    "            self.last = now\n"
                    f"    {LOG_LINE}    {STEP_LINE}",
                ),
                fails="run.period",
            ),
        ),
    ),
)
