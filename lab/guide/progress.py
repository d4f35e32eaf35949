"""How far a workspace is, told from its files and from this terminal; nothing else is remembered.

A step of a lesson names one function here (`<!-- done: package -->`). It returns the next thing to
do, or "" if the step is done. It asks only whether the student can go on; whether it is right is what
`check` tells.
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
MOST_BYTES = 200_000


@dataclass(frozen=True)
class Place:
    """Where to look: the workspace, what the exercise asks for, and this terminal's variables."""

    workspace: Path
    wanted: Assignment
    environment: Mapping[str, str]

    @property
    def package(self) -> Path:
        """The package's folder."""
        return self.workspace / "src" / self.wanted.package

    @property
    def node(self) -> Path:
        """The node's file."""
        return self.package / self.wanted.package / self.wanted.node_file

    def installed(self, path: str) -> bool:
        """Whether a build has installed this, in a folder of the package's own or in a merged one."""
        install = self.workspace / "install"
        return any((place / path).exists() for place in (install / self.wanted.package, install))


def progress(place: Place, steps: Iterable[Step]) -> tuple[str, ...]:
    """Return for each step the next thing to do in it, "" where it is done or nothing tells.

    UsageError for a step that names what the guide cannot tell.
    """
    return tuple(_told(step)(place) if step.done else "" for step in steps)


def current(found: Sequence[str]) -> int:
    """Return the place (from 1) of the first step that is not done; the last one if all are."""
    return next((n for n, action in enumerate(found, start=1) if action), len(found))


def _told(step: Step) -> Told:
    if step.done in STEPS:
        return STEPS[step.done]
    raise UsageError(
        say(
            "step {number} of the lesson names '{name}', which the guide cannot tell",
            number=step.number,
            name=step.done,
        )
        + meant(nearest(step.done, STEPS)),
        remedy=say("Known: {names}.", names=", ".join(STEPS)),
    )


def _terminal(place: Place) -> str:
    if place.environment.get("AMENT_PREFIX_PATH"):
        return ""
    distro = place.environment.get("ROS_DISTRO") or DEFAULT
    return f"source /opt/ros/{distro}/setup.bash"


def _workspace(place: Place) -> str:
    return "" if (place.workspace / "src").is_dir() else "mkdir -p ~/ros2_ws/src"


def _package(place: Place) -> str:
    name = place.wanted.package
    create = f"ros2 pkg create --build-type ament_python {name} --dependencies rclpy"
    if (place.package / "package.xml").is_file() and (place.package / "setup.py").is_file():
        return ""
    if (place.package / "CMakeLists.txt").is_file():
        return say(
            "Delete ~/ros2_ws/src/{name} (it is a C++ package), then in ~/ros2_ws/src: {command}",
            name=name,
            command=create,
        )
    if place.package.exists():
        return say(
            "~/ros2_ws/src/{name} is not complete. Delete it, then in ~/ros2_ws/src: {command}",
            name=name,
            command=create,
        )
    return f"cd ~/ros2_ws/src && {create}"


def _first_build(place: Place) -> str:
    if place.installed(f"share/ament_index/resource_index/packages/{place.wanted.package}"):
        return ""
    if (place.workspace / "src" / "install").is_dir():
        return say(
            "You built in src. Delete build, install and log there, then: {command}", command=BUILD
        )
    return BUILD


def _file(place: Place) -> str:
    shown = f"~/ros2_ws/src/{place.wanted.package}/{place.wanted.package}/{place.wanted.node_file}"
    if not place.node.is_file():
        return f"touch {shown} && chmod +x {shown}"
    return "" if os.access(place.node, os.X_OK) else f"chmod +x {shown}"


def _code(place: Place) -> str:
    name = place.wanted.node_file
    text = _read(place.node)
    if not text.strip():
        return say("Write the node in {file}.", file=name)
    try:
        parse_python(text)
    except PythonFault as fault:
        fault_there = say("Python cannot read {file}: {reason}.", file=name, reason=fault.text)
        line = say("Look at line {line}.", line=fault.line) if fault.line else ""
        return joined(fault_there, line)
    if not text.startswith(b"#!"):
        return say(
            "The first line of {file} must say what runs it: {line}",
            file=name,
            line="#!/usr/bin/env python3",
        )
    node = _node(place)
    if node is None:
        return ""  # (only a file that is too large: whether it works, the checks can tell)
    calls = {called_name(call) for call, _ in node.calls}
    if not any(derives_from_node(each) for each in node.module.classes):
        return say("{file} has no class that inherits from Node yet.", file=name)
    if "create_timer" not in calls:
        return say("The node in {file} has no timer yet.", file=name)
    if node.main is None:
        function = place.wanted.function
        return say("{file} has no function {function} yet.", file=name, function=function)
    if not any(call.startswith("spin") for call in calls):
        return say("Nothing in {file} spins yet: the node would end at once.", file=name)
    return ""


def _entry_point(place: Place) -> str:
    wanted = place.wanted
    line = f"'{wanted.executable} = {wanted.target}',"
    try:
        found = from_setup_py(read_setup_py(_read(place.package / "setup.py")))
        config = from_setup_cfg(read_setup_cfg(_read(place.package / "setup.cfg")))
    except (PythonFault, SetupCfgFault) as fault:
        return say("setup.py or setup.cfg cannot be read: {reason}", reason=fault.text)
    entries = found.group("console_scripts") + config.group("console_scripts")
    if not found.told and (place.package / "setup.py").is_file():
        return ""  # (only the build can tell)
    mine = [entry for entry in entries if entry.name == wanted.executable]
    if not mine:
        return say("Add this line to console_scripts in setup.py: {line}", line=line)
    if not any(entry.target == wanted.target for entry in mine):
        return say(
            "The entry point leads to {target}. Make it: {line}", target=mine[0].target, line=line
        )
    return ""


def _second_build(place: Place) -> str:
    name = place.wanted.package
    return "" if place.installed(f"lib/{name}/{place.wanted.executable}") else BUILD


def _overlay(place: Place) -> str:
    install = (place.workspace / "install").resolve()
    prefixes = place.environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    if any(Path(prefix).resolve().is_relative_to(install) for prefix in prefixes if prefix):
        return ""
    return "cd ~/ros2_ws && source install/local_setup.bash"


def _run(place: Place) -> str:
    """Return what is left to do: that somebody has watched it cannot be told."""
    run = f"ros2 run {place.wanted.package} {place.wanted.executable}"
    then = say("(count along, stop it with Ctrl+C; then run: check)")
    return joined(run, then, by="   ")


Told = Callable[[Place], str]
STEPS: Mapping[str, Told] = {
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
"""What the guide can tell, by the name that a lesson gives to it."""


def _read(path: Path) -> bytes:
    try:
        with path.open("rb") as stream:
            return stream.read(MOST_BYTES)
    except OSError:
        return b""


def _node(place: Place) -> NodeSource | None:
    """Return the node's source; its file, and the modules of the package that it imports."""
    wanted = place.wanted
    path = f"{wanted.package}/{wanted.node_file}"
    return read_node(lambda path: _read(place.package / path) or None, path, wanted.function)
