"""The names that a package uses for itself, if they are not those of the assignment.

A package that has another name throughout builds and runs under that name, and is marked under it:
only the name costs points.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from grader.course.assignment import Assignment
from grader.package.source.manifest import name_in
from grader.package.submission import Submission

if TYPE_CHECKING:
    from grader.run.workspace import Build

VALID = re.compile(r"[a-z][a-z0-9_]{1,99}")  # REP 144
EXECUTABLE = re.compile(r"[\w.][\w.-]{0,99}", re.ASCII)
GROUP = re.compile(r"\[(.{1,100})\]")
SCRIPTS = "console_scripts"


def with_own_names(assignment: Assignment, submission: Submission) -> Assignment:
    """Return the assignment with the package's own name, if ROS finds the package by it."""
    name, wanted = _own_name(submission), assignment.package
    if name in ("", wanted):
        return assignment
    marker, other = (submission.file(f"resource/{each}") for each in (name, wanted))
    if marker is None or marker.kind != "file" or other is not None:
        return assignment
    target, nodes = assignment.target, assignment.nodes
    if assignment.folder == wanted and _is_inner_folder(submission, name, assignment):
        target = name + target.removeprefix(wanted)
        nodes = {
            key: node.model_copy(update={"target": name + node.target.removeprefix(wanted)})
            if node.target.partition(".")[0] == wanted
            else node
            for key, node in nodes.items()
        }
    return assignment.model_copy(update={"package": name, "target": target, "nodes": nodes})


def _own_name(submission: Submission) -> str:
    """Return the valid name in package.xml, else ""."""
    manifest = submission.file("package.xml")
    name = name_in(manifest.data) if manifest is not None else None
    return name if name is not None and VALID.fullmatch(name) else ""


def _is_inner_folder(submission: Submission, name: str, assignment: Assignment) -> bool:
    has_own, has_wanted = (
        any(file.path.startswith(f"{folder}/") for file in submission.files)
        for folder in (name, assignment.folder)
    )
    if has_own and has_wanted:
        return submission.file(f"{assignment.folder}/{assignment.node_file}") is None
    return has_own


def own_executable(assignment: Assignment, entry_points: str) -> str:
    """Return the executable to run, from the entry points that the build installed.

    It is the assignment's, or the only one that leads to the assignment's function.
    """
    names = {
        name
        for name, target in scripts(entry_points)
        if target == assignment.target and EXECUTABLE.fullmatch(name)
    }
    if assignment.executable in names or len(names) != 1:
        return assignment.executable
    return names.pop()


def with_own_executables(assignment: Assignment, build: Build) -> Assignment:
    """Return the assignment with the executables that the build installed for its nodes.

    A node of several has none ("") if its executable starts another node of the assignment: what
    that one does beside itself would be judged of neither.
    """
    name = _installed(assignment, build)
    nodes = {
        key: node.model_copy(update={"executable": _of_node(assignment, key, build)})
        for key, node in assignment.nodes.items()
    }
    return assignment.model_copy(update={"executable": name, "nodes": nodes})


def _installed(assignment: Assignment, build: Build) -> str:
    name = own_executable(assignment, build.entry_points)
    there = build.installed(f"lib/{assignment.package}/{name}")
    return name if there else assignment.executable


def _of_node(assignment: Assignment, key: str, build: Build) -> str:
    about = assignment.about(key)
    name = _installed(about, build)
    leads_to = {target for script, target in scripts(build.entry_points) if script == name}
    others = {node.target for node in assignment.nodes.values()} - {about.target}
    return "" if leads_to and leads_to <= others else name


def scripts(entry_points: str) -> list[tuple[str, str]]:
    """Return names and targets of the executables in the text of an entry_points.txt."""
    found, group = [], ""
    for line in entry_points.splitlines():
        heading = GROUP.fullmatch(line.strip())
        group = heading[1].strip() if heading else group
        name, equals, target = line.partition("=")
        if equals and group == SCRIPTS:
            found.append((name.strip(), "".join(target.split())))
    return found
