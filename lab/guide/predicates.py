"""The conditions by which a step of a lesson is done, from the workspace's files and this terminal.

A step names one (`<!-- done: package -->`), with arguments after a space where it takes some. It
returns the next action, or None if the step is done. It tests only whether the student can go on;
`check` tests whether the work is correct. Nothing is stored here.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import joined, say
from grader.base.nearest import meant, nearest
from grader.package.source.entry_points import from_setup_cfg, from_setup_py
from grader.package.source.python import PythonFault
from grader.package.source.setup_cfg import SetupCfgFault, read_setup_cfg
from grader.package.source.setup_py import read_setup_py
from grader.ros.distro import DEFAULT
from lab.guide.action import Action
from lab.guide.builds import BUILD, built, elsewhere
from lab.guide.code import code_action
from lab.guide.found import mistake, node_elsewhere, other_package, package_elsewhere
from lab.guide.lesson import Step
from lab.guide.state import StudentState, unseen


def next_actions(state: StudentState, steps: Iterable[Step]) -> tuple[Action | None, ...]:
    """Return the next action of each step, None if the step is done or has no condition.

    UsageError for a step that names an unknown condition.
    """
    actions: list[Action | None] = []
    for step in steps:
        if any(actions):  # the graph is asked for the current step only: that takes a second
            state = replace(state, saw=unseen)
        actions.append(_test(step)(state) if step.done else None)
    return tuple(actions)


def current(actions: Sequence[Action | None]) -> int:
    """Return the position (from 1) of the first step that is not done, else of the last step."""
    return next((n for n, action in enumerate(actions, start=1) if action), len(actions))


def _test(step: Step) -> Callable[[StudentState], Action | None]:
    name, *arguments = step.done.split()
    if name in STEPS and not arguments:
        return STEPS[name]
    if name in WITH_ARGUMENT and len(arguments) == 1:
        return lambda state: WITH_ARGUMENT[name](state, arguments[0])
    if name in STEPS or name in WITH_ARGUMENT:
        wrong = (
            say("'{name}' takes one argument", name=name)
            if name in WITH_ARGUMENT
            else say("'{name}' takes no argument", name=name)
        )
        raise UsageError(
            say("step {number} of the lesson: {problem}", number=step.number, problem=wrong)
        )
    known = [*STEPS, *WITH_ARGUMENT]
    raise UsageError(
        say(
            "step {number} of the lesson names '{name}', which the guide does not know",
            number=step.number,
            name=step.done,
        )
        + meant(nearest(name, known)),
        remedy=say("Known: {names}.", names=", ".join(known)),
    )


def _terminal(state: StudentState) -> Action | None:
    if state.environment.get("AMENT_PREFIX_PATH"):
        return None
    distro = state.environment.get("ROS_DISTRO") or DEFAULT
    return Action(f"source /opt/ros/{distro}/setup.bash", "terminal")


def _workspace(state: StudentState) -> Action | None:
    if (state.workspace / "src").is_dir():
        return None
    return Action("mkdir -p ~/ros2_ws/src", "workspace")


def _package(state: StudentState) -> Action | None:
    name = state.assignment.package
    create = f"ros2 pkg create --build-type ament_python {name} --dependencies rclpy"
    if (state.package / "package.xml").is_file() and (state.package / "setup.py").is_file():
        return mistake(state, *PACKAGE) or other_package(state)
    if (state.package / "CMakeLists.txt").is_file():
        again = say(
            "Delete ~/ros2_ws/src/{name}, then in ~/ros2_ws/src: {command}",
            name=name,
            command=create,
        )
        found = say("~/ros2_ws/src/{name} is a C++ package", name=name)
        return Action(again, "package.build_type", found=found)
    if state.package.exists():
        again = say(
            "Delete ~/ros2_ws/src/{name}, then in ~/ros2_ws/src: {command}",
            name=name,
            command=create,
        )
        found = say("~/ros2_ws/src/{name} is not complete", name=name)
        return Action(again, "package.incomplete", found=found)
    other = package_elsewhere(state) or mistake(state, "package.found", "package.manifest")
    return other or Action(f"cd ~/ros2_ws/src && {create}", "package.create")


PACKAGE = ("package.found", "package.manifest", "package.marker", "package.setup_cfg")
"""The kinds of check of the files that `ros2 pkg create` writes."""


def _first_build(state: StudentState) -> Action | None:
    if state.installed(f"share/ament_index/resource_index/packages/{state.assignment.package}"):
        return None
    return elsewhere(state) or Action(BUILD, "package_build")


def _file(state: StudentState) -> Action | None:
    package = state.assignment.package
    shown = f"~/ros2_ws/src/{package}/{package}/{state.assignment.node_file}"
    init = state.inner / "__init__.py"
    if state.inner.is_dir() and not init.is_file():
        found = say("{folder} has no __init__.py", folder=f"~/ros2_ws/src/{package}/{package}")
        why = say("Python recognises a package by this file; it may be empty.")
        command = f"touch ~/ros2_ws/src/{package}/{package}/__init__.py"
        return Action(command, "source.no_init_file", found=found, hints=(why,))
    if not state.node.is_file():
        return node_elsewhere(state) or Action(f"touch {shown} && chmod +x {shown}", "node_file")
    if not os.access(state.node, os.X_OK):
        return Action(f"chmod +x {shown}", "source.not_executable")
    return None


def _entry_point(state: StudentState) -> Action | None:
    assignment = state.assignment
    line = f"'{assignment.executable} = {assignment.target}',"
    try:
        found = from_setup_py(read_setup_py(state.read(state.package / "setup.py")))
        config = from_setup_cfg(read_setup_cfg(state.read(state.package / "setup.cfg")))
    except (PythonFault, SetupCfgFault) as fault:
        place: str = "setup.py"
        if fault.line:
            place = say("{file}, line {line}", file=place, line=fault.line)
        return Action(
            say("Correct {place}.", place=place),
            "setup.unreadable",
            found=say("setup.py or setup.cfg cannot be read: {reason}", reason=fault.text),
        )
    wrong = mistake(state, "entry_point.mapping")
    if wrong is not None:
        return wrong
    entries = found.group("console_scripts") + config.group("console_scripts")
    if not found.is_static and (state.package / "setup.py").is_file():
        return None  # (only a build shows the entry points)
    mine = [entry for entry in entries if entry.name == assignment.executable]
    if not mine:
        add = say("Add this line to console_scripts in setup.py: {line}", line=line)
        return Action(add, "setup.no_entry")
    if not any(entry.target == assignment.target for entry in mine):
        return Action(
            say("Change it to: {line}", line=line),
            "setup.other_target",
            found=say("the entry point runs {target}", target=mine[0].target),
        )
    return None


def _overlay(state: StudentState) -> Action | None:
    install = (state.workspace / "install").resolve()
    prefixes = state.environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    if any(Path(prefix).resolve().is_relative_to(install) for prefix in prefixes if prefix):
        return None
    return Action("cd ~/ros2_ws && source install/local_setup.bash", "overlay")


def _run(state: StudentState) -> Action | None:
    """Done after full marks: nothing else shows that the node was watched."""
    if state.passed:
        return None
    if state.failed is not None:
        return state.failed
    sourced = _overlay(state)
    if sourced is not None:
        return sourced
    run = f"ros2 run {state.assignment.package} {state.assignment.executable}"
    then = say("(watch it, stop it with Ctrl+C, then run: check)")
    return Action(joined(run, then, by="   "), "run")


def _interfaces(state: StudentState) -> Action | None:
    """Done if each interface package is there, built by CMake."""
    for name in state.assignment.interface_packages:
        folder = state.workspace / "src" / name
        create = f"ros2 pkg create --build-type ament_cmake {name}"
        if not (folder / "package.xml").is_file():
            return Action(f"cd ~/ros2_ws/src && {create}", "interfaces.create")
        if not (folder / "CMakeLists.txt").is_file():
            found = say("~/ros2_ws/src/{name} is not an ament_cmake package", name=name)
            again = say(
                "Delete ~/ros2_ws/src/{name}, then in ~/ros2_ws/src: {command}",
                name=name,
                command=create,
            )
            return Action(again, "interfaces.build_type", found=found)
    return None


def _dependencies(state: StudentState) -> Action | None:
    """Done if package.xml names the packages of the types in the checks."""
    types = (str(use.with_.get("type", "")) for use in state.assignment.checks)
    wanted = sorted({name.partition("/")[0] for name in types if "/" in name})
    text = state.read(state.package / "package.xml").decode("utf-8", "replace")
    named = re.findall(r"<(?:exec_|build_)?depend>\s*([\w-]+)\s*</", text)
    missing = [f"<depend>{name}</depend>" for name in wanted if name not in named]
    if not missing or not text:
        return None
    why = say("Whoever installs your package needs these packages too; colcon builds them first.")
    add = say("Add to package.xml: {lines}", lines=" ".join(missing))
    return Action(add, "dependencies", hints=(why,))


def _interfaces_build(state: StudentState) -> Action | None:
    for name in state.assignment.interface_packages:
        if not state.installed(f"share/{name}/package.xml", name):
            return Action(BUILD, "interfaces.build")
    return None


def _exists(state: StudentState, path: str) -> Action | None:
    """Done if a file or folder of the workspace exists."""
    place = state.workspace / path
    if place.resolve().is_relative_to(state.workspace.resolve()) and place.exists():
        return None
    return Action(say("Create {path}.", path=f"~/ros2_ws/{path}"), "exists")


def _passes(state: StudentState, kind: str) -> Action | None:
    """Done if a kind of check that the files decide passes."""
    result = state.results.get(kind)
    if result is not None and result.status == "passed":
        return None
    return mistake(state, kind) or Action(say("Do what this step says."), kind)


def _node_on_graph(state: StudentState, name: str) -> Action | None:
    """Done once a node with this full name was seen."""
    seen = say("the node {name} runs", name=name)
    return None if state.saw("node_on_graph", name) else _run_and_look(state, seen, name)


def _topic_published(state: StudentState, name: str) -> Action | None:
    """Done once a topic with this full name had a publisher."""
    seen = say("a node publishes {name}", name=name)
    return None if state.saw("topic_published", name) else _run_and_look(state, seen, name)


def _run_and_look(state: StudentState, seen: str, name: str) -> Action:
    sourced = _overlay(state)
    if sourced is not None:
        return sourced
    run = f"ros2 run {state.assignment.package} {state.assignment.executable}"
    then = say(
        "(leave it running, and run `guide` in a second terminal: it looks whether {seen})",
        seen=seen,
    )
    return Action(joined(run, then, by="   "), f"graph {name}")


STEPS: Mapping[str, Callable[[StudentState], Action | None]] = {
    "terminal": _terminal,
    "workspace": _workspace,
    "package": _package,
    "package_build": _first_build,
    "node_file": _file,
    "node": code_action,
    "entry_point": _entry_point,
    "executable": built,
    "overlay": _overlay,
    "run": _run,
    "dependencies": _dependencies,
    "interfaces": _interfaces,
    "interfaces_build": _interfaces_build,
}
"""The conditions by the name that a lesson uses."""

WITH_ARGUMENT: Mapping[str, Callable[[StudentState, str], Action | None]] = {
    "exists": _exists,
    "passes": _passes,
    "node_on_graph": _node_on_graph,
    "topic_published": _topic_published,
}
"""The conditions that take an argument."""
