"""Whether ROS has the packages of interfaces that an assignment names, asked before it is used."""

from __future__ import annotations

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.course.assignment import Assignment
from grader.sandbox.base import Sandbox

SECONDS = 20.0  # of wall time to list a folder


def require_interfaces(sandbox: Sandbox, assignment: Assignment) -> None:
    """Raise UsageError if ROS has no package of that name; those of students come later."""
    named = {name.partition("/")[0] for name in assignment.types()}
    needed = sorted(named - {*assignment.interface_packages})
    if not needed:
        return
    command = ["ls", "-1", f"{sandbox.ros_path}/share"]
    outcome = sandbox.run(command, role="probe", seconds=SECONDS)
    there = set(outcome.output.decode(errors="replace").split("\n"))
    missing = [name for name in needed if name not in there]
    if outcome.status == 0 and missing:
        raise UsageError(
            say(
                "ROS {distro} has no package {package}, whose interfaces the assignment uses",
                distro=sandbox.ros.distro.name,
                package=missing[0],
            ),
            remedy=say(
                "If students write it, add it to interface_packages. Otherwise correct the name, or "
                "use a ROS that has it (an image: docs/images.md)."
            ),
        )
