"""The installed stage: is the executable where `ros2 run` looks for it?

"No executable found" has four causes (EXERCISE.md); each gets its own answer here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from grader.checks.build import python_error
from grader.checks.entry_point import mapping_from_source
from grader.checks.registry import Blocked
from grader.checks.registry import Failed
from grader.checks.registry import Passed
from grader.checks.registry import check
from grader.report.model import Where

if TYPE_CHECKING:
    from grader.evidence import Evidence

WHY = (
    "ros2 run looks only in install/<package>/lib/<package>/ for a file of exactly that name that "
    "may be executed; colcon puts it there from setup.py's entry_points, by setup.cfg's paths."
)


@check("entry_point.mapping", depends=["package.found"])
def mapping(evidence: Evidence) -> Passed:
    """setup.py maps the executable's name to the node's main function."""
    said = mapping_from_source(evidence)
    if said is not None:
        return said
    assignment = evidence.assignment
    if not evidence.build.is_installed(assignment.package):
        raise Blocked(by="build.colcon")
    for line in evidence.build.entry_points.splitlines():
        name, equals, target = (part.strip() for part in line.partition("="))
        if equals and name == assignment.executable:
            if target.replace(" ", "") == assignment.target:
                return Passed(actual=f"{name} = {target} (as setup.py computes it)")
            raise _computed(evidence, f"{name} = {target}")
    raise _computed(evidence, f"no entry of the name {assignment.executable}")


def _computed(evidence: Evidence, actual: str) -> Failed:
    assignment = evidence.assignment
    return Failed(
        expected=f"'{assignment.executable} = {assignment.target}' among the console_scripts",
        actual=actual,
        where=Where(file="setup.py"),
        rationale="The entry tells ros2 run which function of which module to start.",
        fix="Write the entry into setup.py's entry_points, under console_scripts: "
        f"'{assignment.executable} = {assignment.target}',",
        mistake="entry_point.computed_mapping",
    )


@check("entry_point.executable", depends=["build.colcon"])
def executable(evidence: Evidence) -> Passed:
    """`ros2 run` finds the executable where it looks for it."""
    package, name = evidence.assignment.package, evidence.assignment.executable
    files = evidence.build.files
    place = f"install/{package}/lib/{package}/{name}"
    there = evidence.build.installed(f"lib/{package}/{name}")
    found = files[there[0]] if there else None
    if found is not None and found.kind == "f" and found.mode & 0o111:
        return Passed(actual=there[0])
    if found is not None and found.kind == "f":
        raise Failed(
            expected=f"{place} with the exec bit",
            actual=f"its mode is {found.mode:04o}: ros2 run says No executable found",
            rationale=WHY,
            fix="Build again after removing what takes the bit away in setup.py; "
            "colcon itself writes the file with mode 0755.",
            mistake="entry_point.no_exec_bit",
        )
    for cause in ("entry_point.mapping", "package.setup_cfg"):
        if evidence.has_failed(cause):
            raise Blocked(by=cause)
    elsewhere = sorted(p for p in files if p.startswith("install/") and p.endswith(f"/{name}"))
    if elsewhere:
        raise Failed(
            expected=place,
            actual=f"it was installed as {elsewhere[0]}: ros2 run says No executable found",
            where=Where(file="setup.cfg"),
            rationale=WHY,
            fix="Give setup.cfg both of its sections back: [develop] with "
            f"script_dir=$base/lib/{package} and [install] with "
            f"install_scripts=$base/lib/{package}, then build again.",
            mistake="entry_point.elsewhere",
            params={"path": elsewhere[0]},
        )
    error, _ = python_error(evidence.build.log, "setup.py")
    raise Failed(
        expected=place,
        actual=f"nothing of the name {name} was installed"
        + (f" ({error})" if error else "")
        + ": ros2 run says No executable found",
        where=Where(file="setup.py"),
        rationale=WHY,
        fix="Check that entry_points is an argument of setup(), then build again.",
        mistake="entry_point.not_installed",
    )
