"""The run stage of a scenario: do the nodes go on until Ctrl+C?"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from grader.base.i18n.message import say
from grader.run.run import Program
from grader.verdict.checks.declare import RUN, check
from grader.verdict.checks.faults import (
    ended_program,
    file_of_program,
    flood,
    node_file,
    others_there,
    resource,
    traceback_of,
    words,
)
from grader.verdict.outcome import Failed, Passed

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence


@check("run.stays", stage=RUN, depends=["run.starts"], after=["run.spins"], quotes="before_ctrl_c")
def stays(evidence: Evidence) -> Passed:
    """The nodes run and answer until Ctrl+C."""
    expected = say("the nodes run and answer until Ctrl+C")
    for plan in evidence.assignment.runs:
        run = evidence.run_of(plan.name)
        if run.resource:
            raise resource(evidence, expected)
        if run.flooded:
            raise flood(evidence, expected)
        there = others_there(evidence, run)
        program = ended_program(replace(run, others=there))
        if program is not None:
            error, where = traceback_of(evidence, program)
            shown = error or say("status {status}", status=str(program.status))
            raise Failed(
                "run.ended_early",
                expected=expected,
                actual=say("{node} ended by itself ({error})", node=program.node, error=shown)
                if isinstance(program, Program)
                else say("the node ended by itself ({error})", error=shown),
                where=where or file_of_program(evidence, program),
                variant="callback" if error else "",
                params={"error": error.partition(":")[0]},
                words=words(evidence),
            )
        if run.seen is not None and run.seen.stuck is not None:
            raise Failed(
                "run.stuck",
                expected=expected,
                actual=say("from {at} s on, the node no longer answers", at=f"{run.seen.stuck:g}"),
                where=node_file(evidence),
                words=words(evidence),
            )
    return Passed()
