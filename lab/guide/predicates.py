"""The conditions by which a step of a lesson is done, from the workspace's files and this terminal.

A step names one (`<!-- done: package -->`), with arguments after a space where it takes some. It
returns the next action, or None if the step is done. It tests only whether the student can go on;
`check` tests whether the work is correct. Nothing is stored here.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import joined, say
from grader.base.nearest import meant, nearest
from grader.base.shown import shown
from grader.package.source.entry_points import from_setup_cfg, from_setup_py
from grader.package.source.python import PythonFault
from grader.package.source.setup_cfg import SetupCfgFault, read_setup_cfg
from grader.package.source.setup_py import read_setup_py
from grader.ros.distro import DEFAULT
from lab.guide.action import Action
from lab.guide.builds import BUILD, built, elsewhere
from lab.guide.code import code_action
from lab.guide.found import (
    mistake,
    nested_package,
    node_elsewhere,
    other_package,
    package_elsewhere,
    unreadable_setup,
)
from lab.guide.lesson import Step
from lab.guide.ran import PROGRAM_RAN, last_run
from lab.guide.runs import CHECK, NODE_RUNS, crashed, has_run, not_run, quoted
from lab.guide.state import StudentState

GIVEN = ("terminal", "workspace")
"""The conditions that hold in a new lab."""


def next_actions(state: StudentState, steps: Iterable[Step]) -> tuple[Action | None, ...]:
    """Return the next action of each step, None if the step is done or has no condition.

    UsageError for a step that names an unknown condition.
    """
    steps = tuple(steps)
    actions: list[Action | None] = []
    asks = state  # the graph is asked for the current step only: that takes a second
    for step in steps:
        if any(actions):
            asks = state.but(saw=state.had_seen)
        actions.append(_test(step)(asks) if step.done and not step.optional else None)
    for n, step in enumerate(steps):
        if step.done and step.optional:
            left = _is_left(n, steps, actions)
            actions[n] = _test(step)(state.but(saw=state.had_seen) if left else state)
    return tuple(actions)


def current(
    actions: Sequence[Action | None], steps: Sequence[Step], *, is_begun: bool = False
) -> int:
    """Return the position (from 1) of the first step that is not done, else of the last step.

    An optional step is passed over as soon as the student has begun the work that follows it
    (`is_begun`: that is known for another reason).
    """
    for n, action in enumerate(actions):
        is_left = steps[n].optional and (is_begun or _is_left(n, steps, actions))
        if action is not None and not is_left:
            return n + 1
    return len(actions)


def _is_left(place: int, steps: Sequence[Step], actions: Sequence[Action | None]) -> bool:
    """Whether a student works already on what follows an optional step."""
    for step, action in zip(steps[place + 1 :], actions[place + 1 :]):
        if step.done and not step.optional and step.done not in GIVEN:
            return action is None or bool(action.found)
    return False


def _test(step: Step) -> Callable[[StudentState], Action | None]:
    name, *arguments = step.done.split()
    if name in STEPS and not arguments:
        return STEPS[name]
    if name in WITH_ARGUMENT and len(arguments) == 1:
        return lambda state: WITH_ARGUMENT[name](state, arguments[0])
    if name == PROGRAM_RAN and len(arguments) == 3:
        return lambda state: _program_ran(state, *arguments)
    if name in STEPS or name in WITH_ARGUMENT or name == PROGRAM_RAN:
        wrong = say("'{name}' takes no argument", name=name)
        if name in WITH_ARGUMENT:
            wrong = say("'{name}' takes one argument", name=name)
        if name == PROGRAM_RAN:
            wrong = say("'{name}' takes a package, an executable and a node", name=name)
        raise UsageError(
            say("step {number} of the lesson: {problem}", number=step.number, problem=wrong)
        )
    known = [*STEPS, *WITH_ARGUMENT, PROGRAM_RAN]
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
    why = say("Each terminal has to read this file before it knows where ROS is.")
    return Action(f"source /opt/ros/{distro}/setup.bash", "terminal", hints=(why,))


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
        why = say("Without --build-type, ros2 pkg create makes a package for C++.")
        return Action(again, "package.created_as_cmake", found=found, hints=(why,))
    inside = nested_package(state)
    if inside is not None:
        return inside
    if state.package.exists():
        again = say(
            "Delete ~/ros2_ws/src/{name}, then in ~/ros2_ws/src: {command}",
            name=name,
            command=create,
        )
        found = say("~/ros2_ws/src/{name} is not complete", name=name)
        why = say("A Python package has package.xml and setup.py; ros2 pkg create writes both.")
        return Action(again, "package.incomplete", found=found, hints=(why,))
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
    place = f"~/ros2_ws/src/{package}/{package}/{state.assignment.node_file}"
    init = state.inner / "__init__.py"
    if state.inner.is_dir() and not init.is_file():
        found = say("{folder} has no __init__.py", folder=f"~/ros2_ws/src/{package}/{package}")
        why = say("Python recognises a package by this file; it may be empty.")
        command = f"touch ~/ros2_ws/src/{package}/{package}/__init__.py"
        return Action(command, "source.no_init_file", found=found, hints=(why,))
    if not state.node.is_file():
        return node_elsewhere(state) or Action(f"touch {place} && chmod +x {place}", "node_file")
    if not os.access(state.node, os.X_OK):
        found = say("{file} is not executable", file=state.assignment.node_file)
        why = say(
            "chmod +x lets you start the file itself: ./{file}", file=state.assignment.node_file
        )
        return Action(f"chmod +x {place}", "source.not_executable", found, (why,))
    return None


def _entry_point(state: StudentState) -> Action | None:
    assignment = state.assignment
    line = f"'{assignment.executable} = {assignment.target}',"
    broken = unreadable_setup(state)
    if broken is not None:
        return broken
    try:
        found = from_setup_py(read_setup_py(state.read(state.package / "setup.py")))
        config = from_setup_cfg(read_setup_cfg(state.read(state.package / "setup.cfg")))
    except (PythonFault, SetupCfgFault) as fault:
        file = "setup.cfg" if isinstance(fault, SetupCfgFault) else "setup.py"
        place: str = file
        if fault.line:
            place = say("{file}, line {line}", file=file, line=fault.line)
        return Action(
            say("Correct {place}.", place=place),
            "setup.unreadable",
            found=say("{file} cannot be read: {reason}", file=file, reason=fault.text),
            hints=(say("The build reads this file first: it stops where the file is wrong."),),
            place=f"{file}:{fault.line}" if fault.line else file,
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
        why = say("Without an entry point, the build makes no program that ros2 run could start.")
        return Action(add, "setup.no_entry", hints=(why,), place="setup.py")
    if not any(entry.target == assignment.target for entry in mine):
        return Action(
            say("Change it to: {line}", line=line),
            "setup.other_target",
            found=say("the entry point runs {target}", target=mine[0].target),
            hints=(say("The entry point names the package, the file and the function."),),
            place="setup.py",
        )
    return None


def _overlay(state: StudentState) -> Action | None:
    install = (state.workspace / "install").resolve()
    prefixes = state.environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    if any(Path(prefix).resolve().is_relative_to(install) for prefix in prefixes if prefix):
        return None
    why = say(
        "A terminal knows your packages only after it has read this file, which the build makes."
    )
    return Action("cd ~/ros2_ws && source install/local_setup.bash", "overlay", hints=(why,))


def _run(state: StudentState) -> Action | None:
    """Done after full marks: nothing else shows that the node was watched."""
    if state.passed:
        return None
    if (error := crashed(state)) is not None:
        return _overlay(state) or error
    if not has_run(state) and _runs(state):
        found = say("the node {name} is running", name=f"/{state.assignment.node_name}")
        then = say("(watch the node, stop it with Ctrl+C in its terminal, and run this)")
        return Action(joined("check", then, by="   "), CHECK.id, found, CHECK.hints)
    sourced = _overlay(state)
    if sourced is not None:
        return sourced
    if has_run(state):
        return CHECK
    run = f"ros2 run {state.assignment.package} {state.assignment.executable}"
    then = say("(watch it, stop it with Ctrl+C, then run: check)")
    return Action(joined(run, then, by="   "), "run", hints=(NODE_RUNS,))


def _ran(state: StudentState) -> Action | None:
    """Done if the overlay is sourced, and the node ran since its files were saved last.

    If it runs in another terminal, that is seen on the ROS graph.
    """
    if state.passed:
        return None
    unsourced, error = _overlay(state), crashed(state)
    if error is not None:
        return unsourced or error
    action = unsourced or not_run(state)
    return None if action is None or _runs(state) else action


def _runs(state: StudentState) -> bool:
    """Whether the node was seen on the graph, with the files as they are."""
    return built(state) is None and state.saw("node_on_graph", f"/{state.assignment.node_name}")


def _interfaces(state: StudentState) -> Action | None:
    """Done if each interface package is there, built by CMake."""
    for name in state.assignment.interface_packages:
        folder = state.workspace / "src" / name
        create = f"ros2 pkg create --build-type ament_cmake {name}"
        if not (folder / "package.xml").is_file():
            why = say("Messages are built by CMake, so they have a package of their own.")
            return Action(f"cd ~/ros2_ws/src && {create}", "interfaces.create", hints=(why,))
        if not (folder / "CMakeLists.txt").is_file():
            found = say("~/ros2_ws/src/{name} is not an ament_cmake package", name=name)
            again = say(
                "Delete ~/ros2_ws/src/{name}, then in ~/ros2_ws/src: {command}",
                name=name,
                command=create,
            )
            why = say("Messages are built by CMake, so they have a package of their own.")
            return Action(again, "interfaces.build_type", found=found, hints=(why,))
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
    for name in [name for name in wanted if name not in named]:
        if own := nearest(name, [each for each in named if each not in wanted]):
            found = say("package.xml names '{own}', not '{name}'", own=shown(own), name=name)
            write = say("Write in package.xml: {lines}", lines=f"<depend>{name}</depend>")
            return Action(write, "dependencies", found, (why,), place="package.xml")
    add = say("Add to package.xml: {lines}", lines=" ".join(missing))
    return Action(add, "dependencies", hints=(why,), place="package.xml")


def _interfaces_build(state: StudentState) -> Action | None:
    for name in state.assignment.interface_packages:
        if not state.installed(f"share/{name}/package.xml", name):
            why = say("The build makes Python code of your messages.")
            return Action(BUILD, "interfaces.build", hints=(why,))
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
    sourced = _overlay(state) or crashed(state)
    if sourced is not None:
        return sourced
    run = f"ros2 run {state.assignment.package} {state.assignment.executable}"
    then = say(
        "(leave it running, and run `guide` in a second terminal: it looks whether {seen})",
        seen=seen,
    )
    return Action(joined(run, then, by="   "), f"graph {name}", hints=(NODE_RUNS,))


def _program_ran(state: StudentState, package: str, executable: str, node: str) -> Action | None:
    """Done once the node of a program was seen, or the program ran and ended without an error."""
    program = f"{package} {executable}"
    if state.saw(PROGRAM_RAN, program) or state.saw("node_on_graph", node):
        return None
    command = f"ros2 run {program}"
    ran = last_run(state.workspace)
    found, why = "", say("The lab looks on the ROS graph whether the program runs.")
    if ran is not None and ran.is_of(package, executable):
        found = say(
            "{command} ended with an error (exit status {status})",
            command=quoted(command),
            status=ran.status,
        )
    then = say("(leave it running, and go on in a second terminal)")
    return _terminal(state) or Action(joined(command, then, by="   "), PROGRAM_RAN, found, (why,))


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
    "ran": _ran,
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
