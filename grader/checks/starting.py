"""The running stage, first part: does the node start, stay, and end when Ctrl+C is pressed?"""

from __future__ import annotations

from typing import TYPE_CHECKING

from grader.checks.faults import SPIN
from grader.checks.faults import flood
from grader.checks.faults import node_file
from grader.checks.faults import resource
from grader.checks.faults import traceback_of
from grader.checks.registry import Blocked
from grader.checks.registry import Failed
from grader.checks.registry import Inconclusive
from grader.checks.registry import Passed
from grader.checks.registry import check

if TYPE_CHECKING:
    from grader.evidence import Evidence

SIGNALLED = 240  # ros2 run passes on minus the number of the signal that ended the node, mod 256


@check("run.starts", depends=["entry_point.executable"])
def starts(evidence: Evidence) -> Passed:
    """`ros2 run` starts the node and it stays."""
    run = evidence.run
    if run.started:
        return Passed(actual=f"the node was on the ROS graph {run.node_seconds or 0:.1f} s later")
    if run.resource:
        raise resource(evidence, "the node starts within the limits of the sandbox")
    if run.flooded:
        raise flood(evidence, "the node starts")
    if run.ended_by_itself:
        for cause in ("source.node_file", "entry_point.mapping"):
            if evidence.has_failed(cause):
                raise Blocked(by=cause)
        if f"Package '{evidence.assignment.package}' not found" in run.transcript:
            raise Blocked(
                by="package.manifest" if evidence.has_failed("package.manifest") else "build.colcon"
            )
        error, where = traceback_of(evidence, run)
        if error:
            raise Failed(
                expected="the node starts and runs until Ctrl+C",
                actual=f"it stopped at its start with {error}",
                where=where,
                rationale="An exception that nobody catches ends the program; the last line of "
                "the traceback names it, the line above shows where it came from.",
                fix="Mend the line shown; then colcon build is not needed again (--symlink-install)"
                ", just run it again.",
                mistake="run.died_at_start",
                params={"error": error.partition(":")[0], "text": error},
            )
        if run.watch.counted and not run.nodes:
            raise _no_node(evidence, "lines came, but no node was ever on the graph")
        raise Failed(
            expected="the node runs until Ctrl+C",
            actual=f"it ended by itself at once, with status {run.status}",
            where=node_file(evidence),
            rationale=SPIN,
            fix="Call rclpy.spin(node) in main, after making the node (not spin_once).",
            mistake="run.exits_at_once",
        )
    seconds = run.seconds - (run.stop_seconds or 0)
    raise _no_node(evidence, f"the program runs, but no node was seen within {seconds:.0f} s")


def _no_node(evidence: Evidence, actual: str) -> Failed:
    return Failed(
        expected=f"a node {evidence.assignment.node_name} on the ROS graph",
        actual=actual,
        where=node_file(evidence),
        rationale="A node comes into being when its class (a Node) is made, after rclpy.init().",
        fix="See that main makes the node, and that nothing before it waits (input(), a loop).",
        mistake="run.no_node",
    )


@check("run.node_name", depends=["run.starts"])
def node_name(evidence: Evidence) -> Passed:
    """The node has the name that was asked for."""
    wanted = evidence.assignment.node_name
    names = [node.name for node in evidence.run.nodes]
    if f"/{wanted}" in names:
        return Passed(actual=f"/{wanted}")
    if not names:
        raise Inconclusive("the ROS graph could not be read")
    raise Failed(
        expected=f"/{wanted}",
        actual=", ".join(names),
        where=node_file(evidence),
        rationale="The name under which ros2 node list, topics and logs show a node is the one "
        "given to super().__init__(), not that of the file or the class.",
        fix=f"Write super().__init__('{wanted}').",
        mistake="run.wrong_node_name",
        params={"name": names[0].lstrip("/")},
    )


@check("run.interrupt", depends=["run.starts"])
def interrupt(evidence: Evidence) -> Passed:
    """Ctrl+C ends the node."""
    run = evidence.run
    if not run.interrupted:
        raise Blocked(by="run.output")
    expected = "the node ends soon after Ctrl+C"
    if run.stop_seconds is None:
        raise Failed(
            expected=expected,
            actual="it was still there and had to be killed",
            where=node_file(evidence),
            rationale="Ctrl+C sends SIGINT; Python turns it into KeyboardInterrupt, which ends "
            "rclpy.spin. Catching it and going on, or ignoring the signal, leaves the node behind.",
            fix="Catch KeyboardInterrupt around rclpy.spin only, and let main end after it.",
            mistake="run.ignores_interrupt",
        )
    last = run.transcript.rstrip()[-3000:]
    actual = f"ended {run.stop_seconds:.1f} s after Ctrl+C with status {run.status}"
    if run.status in (0, 130, 254) or run.signal == 2:
        advice = []
        if run.status == 254:
            advice = ["try: … except KeyboardInterrupt: around rclpy.spin spares the traceback."]
        return Passed(actual=actual, advice=advice)
    if run.status is not None and run.status > SIGNALLED:
        return Passed(
            actual=actual,
            advice=[
                "The program crashed in ROS's own clean-up after Ctrl+C: do not leave a thread "
                "spinning when main ends."
            ],
        )
    if "rcl_shutdown already called" in last:
        return Passed(
            actual=actual,
            advice=[
                "The traceback after Ctrl+C is known: ROS has shut down already when your "
                "rclpy.shutdown() is called. rclpy.try_shutdown() does it without."
            ],
        )
    if "ExternalShutdownException" in last or "KeyboardInterrupt" in last:
        return Passed(actual=actual)
    error, where = traceback_of(evidence, run)
    raise Failed(
        expected=expected + ", without an error of its own",
        actual=actual + (f": {error}" if error else ""),
        where=where,
        rationale="What runs after rclpy.spin is your clean-up; an error there hides the end.",
        fix="Mend the line shown, or leave it away.",
        mistake="run.error_at_stop",
        params={"error": error.partition(":")[0]},
    )
