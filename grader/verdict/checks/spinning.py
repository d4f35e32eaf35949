"""The run stage: does the node spin, so that ROS calls its callbacks?

A node that never spins can write right lines at right instants from a loop with sleep(). But its
parameters and services never answer, no message reaches it, and it does not follow ROS time.
"""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from grader.base.i18n.message import say
from grader.package.source.names import dotted, last_part
from grader.verdict.checks.declare import RUN, check
from grader.verdict.checks.faults import going_on, line_of, node_file, only_here, words
from grader.verdict.node_files import source_of_node
from grader.verdict.outcome import Blocked, Failed, Inconclusive, Passed

if TYPE_CHECKING:
    from grader.package.source.timer import Timer
    from grader.verdict.evidence import Evidence


@check("run.spins", stage=RUN, depends=["run.starts"], quotes="before_ctrl_c", covers="runs")
def spins(evidence: Evidence) -> Passed:
    """The node spins, so that ROS calls its callbacks."""
    run = evidence.run
    # a flood ends the run: whether the node answered before that would be chance
    if run.confirmed is False and run.seen is not None:
        raise _only_when_marked(evidence)
    if run.confirmed is False or run.flooded:
        raise Blocked(by=going_on(evidence))
    if run.done:
        return Passed(actual=say("it ended by itself, as it must"))
    if not run.is_spun:
        raise Blocked(by="run.stays") if run.exits else _never(evidence)
    # of a single line, the instant is chance; log.counts says that no more came
    if not run.watch.while_still or len(run.watch.counted) == 1:
        return Passed(actual=say("the node answers while it counts"))
    if timer_of_other_clock(evidence) is not None:
        return Passed(actual=say("the node answers, but its timer does not use the node's clock"))
    raise Failed(
        "run.never_spins",
        expected=say("the lines come from a callback that spin calls"),
        actual=say("lines come while ROS time stands still: no timer of the node makes them"),
        where=line_of(evidence, run.watch.counted[0].record),
        variant="beside",
        words=words(evidence),
    )


def _only_when_marked(evidence: Evidence) -> Failed:
    """Return the failure of a node of which nothing is seen where a person runs it."""
    return Failed(
        "run.only_when_marked",
        expected=say("a node that works in a plain ros2 run too"),
        actual=say("it works under simulated time, but does nothing in a plain ros2 run"),
        where=only_here(evidence),
        words=words(evidence),
    )


def _never(evidence: Evidence) -> Failed | Blocked | Inconclusive:
    """Return the outcome of a node of which nothing answered."""
    run = evidence.run
    if run.resource or run.ended_by_itself:
        return Blocked(by=going_on(evidence))
    node = run.counting_node
    if node is not None and not node.services and not node.clock:
        return Inconclusive(
            say("the node has no services and does not follow /clock: nothing of it can be asked")
        )
    return Failed(
        "run.never_spins",
        expected=say("a node that spins: it answers, and ROS calls its callbacks"),
        actual=say("the node does not answer: nothing calls its callbacks"),
        where=node_file(evidence),
        variant=_what_is_there(evidence),
        words=words(evidence),
    )


def _what_is_there(evidence: Evidence) -> str:
    """Return which text asks only for what the source lacks."""
    source = source_of_node(evidence)
    if source is None:
        return ""
    parts = source.all_nodes
    spins = any(isinstance(n, ast.Attribute | ast.Name) and _named(n) == "spin" for n in parts)
    if source.timers:
        return "there" if spins else "timer"
    return "spins" if spins else ""


def _named(node: ast.AST) -> str:
    return last_part(dotted(node))


def timer_of_other_clock(evidence: Evidence) -> Timer | None:
    """Return the node's timer that has a clock of its own, if its source has one."""
    source = source_of_node(evidence)
    timers = source.timers if source is not None else []
    return next((timer for timer in timers if timer.has_other_clock), None)
