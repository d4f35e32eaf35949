"""Finds the steps that are done from the workspace's files and this terminal; stores nothing.

A step of a lesson names a function here (`<!-- done: package -->`). It returns the next action, or
"" if the step is done. It tests only whether the student can go on; `check` tests whether the work
is correct.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import joined, say
from grader.base.nearest import meant, nearest
from grader.course.assignment import Assignment
from grader.package.source.entry_points import from_setup_cfg, from_setup_py
from grader.package.source.names import called_name
from grader.package.source.node import NodeSource, read_node
from grader.package.source.node_class import derives_from_node
from grader.package.source.python import PythonFault, parse_python
from grader.package.source.setup_cfg import SetupCfgFault, read_setup_cfg
from grader.package.source.setup_py import read_setup_py
from grader.ros.distro import DEFAULT
from lab.guide.lesson import Step

BUILD = "cd ~/ros2_ws && colcon build --symlink-install"
MAX_BYTES = 200_000


@dataclass(frozen=True)
class StudentState:
    """The input of the tests: workspace, assignment and this terminal's environment."""

    workspace: Path
    assignment: Assignment
    environment: Mapping[str, str]

    @property
    def package(self) -> Path:
        """The package's folder."""
        return self.workspace / "src" / self.assignment.package

    @property
    def node(self) -> Path:
        """The node's file."""
        return self.package / self.assignment.package / self.assignment.node_file

    def installed(self, path: str) -> bool:
        """Whether a build has installed this path (isolated or merged install layout)."""
        install = self.workspace / "install"
        return any(
            (folder / path).exists() for folder in (install / self.assignment.package, install)
        )


def next_actions(state: StudentState, steps: Iterable[Step]) -> tuple[str, ...]:
    """Return the next action of each step, "" if the step is done or has no test.

    UsageError for a step that names an unknown test.
    """
    return tuple(_step_test(step)(state) if step.done else "" for step in steps)


def current(actions: Sequence[str]) -> int:
    """Return the position (from 1) of the first step that is not done, else of the last step."""
    return next((n for n, action in enumerate(actions, start=1) if action), len(actions))


def _step_test(step: Step) -> StepTest:
    if step.done in STEPS:
        return STEPS[step.done]
    raise UsageError(
        say(
            "step {number} of the lesson names '{name}', which the guide does not know",
            number=step.number,
            name=step.done,
        )
        + meant(nearest(step.done, STEPS)),
        remedy=say("Known: {names}.", names=", ".join(STEPS)),
    )


def _terminal(state: StudentState) -> str:
    if state.environment.get("AMENT_PREFIX_PATH"):
        return ""
    distro = state.environment.get("ROS_DISTRO") or DEFAULT
    return f"source /opt/ros/{distro}/setup.bash"


def _workspace(state: StudentState) -> str:
    return "" if (state.workspace / "src").is_dir() else "mkdir -p ~/ros2_ws/src"


def _package(state: StudentState) -> str:
    name = state.assignment.package
    create = f"ros2 pkg create --build-type ament_python {name} --dependencies rclpy"
    if (state.package / "package.xml").is_file() and (state.package / "setup.py").is_file():
        return ""
    if (state.package / "CMakeLists.txt").is_file():
        return say(
            "Delete ~/ros2_ws/src/{name} (it is a C++ package), then in ~/ros2_ws/src: {command}",
            name=name,
            command=create,
        )
    if state.package.exists():
        return say(
            "~/ros2_ws/src/{name} is not complete. Delete it, then in ~/ros2_ws/src: {command}",
            name=name,
            command=create,
        )
    return f"cd ~/ros2_ws/src && {create}"


def _first_build(state: StudentState) -> str:
    if state.installed(f"share/ament_index/resource_index/packages/{state.assignment.package}"):
        return ""
    if (state.workspace / "src" / "install").is_dir():
        return say(
            "You built in src. Delete build, install and log there, then: {command}", command=BUILD
        )
    return BUILD


def _file(state: StudentState) -> str:
    package = state.assignment.package
    shown = f"~/ros2_ws/src/{package}/{package}/{state.assignment.node_file}"
    if not state.node.is_file():
        return f"touch {shown} && chmod +x {shown}"
    return "" if os.access(state.node, os.X_OK) else f"chmod +x {shown}"


NEEDS = {
    "topic.subscribes": "create_subscription",
    "topic.publishes": "create_publisher",
    "service.offers": "create_service",
    "service.calls": "create_client",
    "action.offers": "ActionServer",
    "parameter.declared": "declare_parameter",
    "topic.period": "create_timer",
}
"""What a node must call for a kind of check."""


def _code(state: StudentState) -> str:
    name = state.assignment.node_file
    text = _read(state.node)
    if not text.strip():
        return say("Write the node in {file}.", file=name)
    try:
        parse_python(text)
    except PythonFault as fault:
        problem = say("Python cannot read {file}: {reason}.", file=name, reason=fault.text)
        line = say("Look at line {line}.", line=fault.line) if fault.line else ""
        return joined(problem, line)
    if not text.startswith(b"#!"):
        return say(
            "The first line of {file} must name its interpreter: {line}",
            file=name,
            line="#!/usr/bin/env python3",
        )
    node = _node(state)
    if node is None:
        return ""  # (only if the file is too large; the checks test whether it works)
    calls = {called_name(call) for call, _ in node.calls}
    if not any(derives_from_node(each) for each in node.module.classes):
        return say("{file} has no class that inherits from Node yet.", file=name)
    kinds = {use.kind for use in state.assignment.checks}
    for kind, call in NEEDS.items():
        if kind in kinds and call not in calls:
            return say("The node in {file} does not call {call} yet.", file=name, call=call)
    if not state.assignment.runs and "create_timer" not in calls:
        return say("The node in {file} has no timer yet.", file=name)
    if node.main is None:
        function = state.assignment.function
        return say("{file} has no function {function} yet.", file=name, function=function)
    if not any(call.startswith("spin") for call in calls):
        return say("{file} does not spin the node yet, so the node would end at once.", file=name)
    return ""


def _entry_point(state: StudentState) -> str:
    assignment = state.assignment
    line = f"'{assignment.executable} = {assignment.target}',"
    try:
        found = from_setup_py(read_setup_py(_read(state.package / "setup.py")))
        config = from_setup_cfg(read_setup_cfg(_read(state.package / "setup.cfg")))
    except (PythonFault, SetupCfgFault) as fault:
        return say("setup.py or setup.cfg cannot be read: {reason}", reason=fault.text)
    entries = found.group("console_scripts") + config.group("console_scripts")
    if not found.is_static and (state.package / "setup.py").is_file():
        return ""  # (only a build shows the entry points)
    mine = [entry for entry in entries if entry.name == assignment.executable]
    if not mine:
        return say("Add this line to console_scripts in setup.py: {line}", line=line)
    if not any(entry.target == assignment.target for entry in mine):
        return say(
            "The entry point runs {target}. Change it to: {line}", target=mine[0].target, line=line
        )
    return ""


def _second_build(state: StudentState) -> str:
    name = state.assignment.package
    return "" if state.installed(f"lib/{name}/{state.assignment.executable}") else BUILD


def _overlay(state: StudentState) -> str:
    install = (state.workspace / "install").resolve()
    prefixes = state.environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    if any(Path(prefix).resolve().is_relative_to(install) for prefix in prefixes if prefix):
        return ""
    return "cd ~/ros2_ws && source install/local_setup.bash"


def _run(state: StudentState) -> str:
    """Return the last action; it is never done, because nothing shows that the node was watched."""
    run = f"ros2 run {state.assignment.package} {state.assignment.executable}"
    then = say("(count along, stop it with Ctrl+C, then run: check)")
    return joined(run, then, by="   ")


StepTest = Callable[[StudentState], str]
STEPS: Mapping[str, StepTest] = {
    "terminal": _terminal,
    "workspace": _workspace,
    "package": _package,
    "package_build": _first_build,
    "node_file": _file,
    "node": _code,
    "entry_point": _entry_point,
    "executable": _second_build,
    "overlay": _overlay,
    "run": _run,
}
"""The tests by the name that a lesson uses."""


def _read(path: Path) -> bytes:
    try:
        with path.open("rb") as stream:
            return stream.read(MAX_BYTES)
    except OSError:
        return b""


def _node(state: StudentState) -> NodeSource | None:
    """Return the source of the node: its file, and the modules of the package that it imports."""
    assignment = state.assignment
    path = f"{assignment.package}/{assignment.node_file}"
    return read_node(lambda path: _read(state.package / path) or None, path, assignment.function)
