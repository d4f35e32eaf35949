"""Mistakes in the pace of the lines: a timer of another period, which something else holds back."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, STEP_LINE, example
from grader.mistakes.fixes import node_pace
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.sleeps import longest_sleep

SAME = 0.001  # seconds by which two equal periods differ at most


def _throttled(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a timer of another period whose lines the logger leaves out in part."""
    source, period = suspect.source, node_pace.period_of(suspect.source)
    option = node_pace.throttled(source)
    if period is None or option is None or abs(period[1] - suspect.output.period) < SAME:
        return None
    return suspect.finding(
        "timer_throttled", period[0], seconds=f"{period[1]:g}", line=option.value.lineno
    )


def _paced_by_sleep(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a timer of another period whose callback sleeps for at least that period."""
    source, period = suspect.source, node_pace.period_of(suspect.source)
    slept = longest_sleep(source)
    if period is None or slept is None or abs(period[1] - suspect.output.period) < SAME:
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
            "next line, and while a callback sleeps, the node can do nothing else."
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
)
