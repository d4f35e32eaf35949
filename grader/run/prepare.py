"""What the probe makes for a run before its nodes are started."""

from __future__ import annotations

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.course.assignment import Assignment
from grader.course.scenario import RunPlan
from grader.run.observer import SECOND
from grader.run.probe_link import ProbeLink, in_probe

MODULES = ("messages", "senders", "hearing", "parameters", "graph", "goals", "scenario")
"""Of in_probe, in the order in which they need one another."""
PREPARE_SECONDS = 5.0  # of the run's time, to make the probe's ends


def prepare(
    probe: ProbeLink, assignment: Assignment, plan: RunPlan, *, plain: bool = False
) -> dict[str, str]:
    """Make the ends that the plan needs; UsageError for what ROS does not have.

    Return the types of the submission's packages that cannot be used, and why. With `plain` the
    probe shows no clock.
    """
    probe.ready()
    probe.extend([in_probe(name) for name in MODULES])
    said = probe.said(
        "prepare",
        seconds=PREPARE_SECONDS,
        watch=[one for one in plan.topics.items() if one[0] not in plan.kept_back],
        later=[one for one in plan.topics.items() if one[0] in plan.kept_back],
        publish=[[one.publish.topic, one.publish.type] for one in plan.do if one.publish],
        call=[[one.call.service, one.call.type] for one in plan.do if one.call],
        goal=[[one.goal.action, one.goal.type] for one in plan.do if one.goal],
        periods={name: round(s * SECOND) for name, s in plan.periods.items() if not plain},
        world=in_probe(plan.world) if plan.world else None,
        students=assignment.interface_packages,
        plain=plain,
    )
    for kind in said.get("unknown", ()):
        raise UsageError(
            say("there is no interface {type} in this ROS", type=kind),
            remedy=say("Correct the run '{name}' of the assignment.", name=plan.name),
        )
    return {str(kind): str(why) for kind, why in said.get("unusable", {}).items()}
