"""The run stage of a scenario: do the nodes go on until Ctrl+C?"""

from __future__ import annotations

from typing import TYPE_CHECKING

from grader.base.i18n.message import say
from grader.verdict.checks.declare import RUN, check
from grader.verdict.checks.faults import flood, node_file, resource, traceback_of, words
from grader.verdict.node_files import source_of_node
from grader.verdict.outcome import Blocked, Failed, Passed

if TYPE_CHECKING:
    from grader.run.run import Run
    from grader.verdict.evidence import Evidence


@check(
    "run.stays",
    stage=RUN,
    depends=["run.starts"],
    after=["run.spins"],
    quotes="before_ctrl_c",
    covers="runs",
)
def stays(evidence: Evidence) -> Passed:
    """The nodes run and answer until Ctrl+C."""
    expected, run = say("the nodes run and answer until Ctrl+C"), evidence.run
    if run.done:
        return Passed(actual=say("it ended by itself, as it must"))
    if run.exits:
        expected = say("the program ends by itself, with status 0")
    if run.resource:
        raise resource(evidence, expected)
    if run.flooded:
        raise flood(evidence, expected)
    if run.ended_by_itself:
        error, where = traceback_of(evidence, run)
        shown = error or say("status {status}", status=str(run.status))
        raise Failed(
            "run.ended_early",
            expected=expected,
            actual=say("the node ended by itself ({error})", error=shown),
            where=where or node_file(evidence),
            variant="callback" if error else "",
            params={"error": error.partition(":")[0]},
            words=words(evidence),
        )
    if run.exits:
        raise Failed(
            "run.does_not_end",
            expected=expected,
            actual=say("it was still running at the end"),
            where=node_file(evidence),
            words=words(evidence),
        )
    if run.seen is not None and run.seen.stuck is not None and _is_stuck(run):
        if evidence.has_failed("run.spins"):
            raise Blocked(by="run.spins")
        raise Failed(
            "run.stuck",
            expected=expected,
            actual=say(
                "after {at} s of ROS time, the node no longer answers", at=f"{run.seen.stuck:g}"
            ),
            where=node_file(evidence),
            words=words(evidence),
            variant="service" if _asks_a_service(evidence) else "",
        )
    return Passed()


def _is_stuck(run: Run) -> bool:
    """Whether it is this node of a run that does not answer; each, if it is not known which."""
    silent = run.seen.silent if run.seen is not None else []
    return not silent or any(node.name in silent for node in run.nodes)


def _asks_a_service(evidence: Evidence) -> bool:
    """Whether the node has a client of a service, whose answer it may wait for."""
    source = source_of_node(evidence)
    return source is not None and bool(source.calls_of("create_client"))
