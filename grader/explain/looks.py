"""What can be looked at on this machine: each returns one sentence, or None if there is nothing."""

from __future__ import annotations

import grp
import os
from collections.abc import Mapping
from pathlib import Path

from grader.base.i18n.message import Message, Value, say
from grader.base.shown import shown
from grader.explain.machine import Machine

LAST_WITH_EDITABLE = 79  # setuptools; from 80 on, develop has no --editable
MOST_NAMES = 8
OF_THE_GRAPH = (
    "ROS_DOMAIN_ID",
    "ROS_LOCALHOST_ONLY",
    "ROS_AUTOMATIC_DISCOVERY_RANGE",
    "ROS_STATIC_PEERS",
    "RMW_IMPLEMENTATION",
    "ROS_DISCOVERY_SERVER",
)


def ros_sourced(machine: Machine, values: Mapping[str, Value]) -> Message | None:
    """Which ROS there is, if the terminal has sourced none or the text names another one."""
    del values
    names = ", ".join(machine.installed)
    if not names:
        return say("There is no ROS in /opt/ros.")
    if "ROS_DISTRO" in machine.environment:
        return say("ROS 2 {distro} is sourced here.", distro=machine.environment["ROS_DISTRO"])
    return say("/opt/ros has {names}, and none is sourced here.", names=names)


def package_built(machine: Machine, values: Mapping[str, Value]) -> Message | None:
    """How far the package has come: in src, built, sourced."""
    package, workspace = str(values.get("package", "")), machine.workspace
    if not package or "/" in package or workspace is None:
        return None
    built = workspace / "install" / package
    if not built.is_dir():
        return say("{folder} has no {package}: it is not built.",
                   folder=f"{workspace.name}/install", package=shown(package))  # fmt: skip
    if str(built) not in machine.prefixes and str(built.parent) not in machine.prefixes:
        return say(
            "{package} is built, but this terminal has not sourced it.", package=shown(package)
        )
    return say("{package} is built, and sourced in this terminal.", package=shown(package))


def executables(machine: Machine, values: Mapping[str, Value]) -> Message | None:
    """The executables that the package has."""
    package, workspace = str(values.get("package", "")), machine.workspace
    if not package or "/" in package or workspace is None:
        return None
    folder = workspace / "install" / package / "lib" / package
    names = [shown(path.name) for path in _in(folder) if os.access(path, os.X_OK)]
    if not names:
        return package_built(machine, values)
    return say("{package} has these executables: {names}.",
               package=shown(package), names=", ".join(names[:MOST_NAMES]))  # fmt: skip


def python(machine: Machine, values: Mapping[str, Value]) -> Message | None:
    """The Python that the terminal finds, if it is not the system's."""
    del values
    name = machine.environment.get("CONDA_DEFAULT_ENV")
    if name:
        return say("The conda environment {name} is active in this terminal.", name=shown(name))
    folder = machine.environment.get("VIRTUAL_ENV")
    if folder:
        return say("The venv {folder} is active in this terminal.", folder=shown(folder))
    return (
        say("python3 is {path} here.", path=shown(str(machine.python))) if machine.python else None
    )


def setuptools(machine: Machine, values: Mapping[str, Value]) -> Message | None:
    """The version of setuptools."""
    del values
    version = machine.version("setuptools")
    return say("setuptools is {version} here.", version=shown(version)) if version else None


def copied(machine: Machine, values: Mapping[str, Value]) -> Message | None:
    """The package of the workspace that was copied by a setuptools without --editable."""
    del values
    version, workspace = machine.version("setuptools"), machine.workspace
    major = version.split(".")[0]
    if workspace is None or not major.isdecimal() or int(major) <= LAST_WITH_EDITABLE:
        return None
    for package in (path.name for path in _in(workspace / "install")):
        found = (workspace / "install" / package).glob(f"lib/python3*/site-packages/{package}/*.py")
        if any(not path.is_symlink() for path in found):
            return say("setuptools is {version} here, and the files of {package} were copied.",
                       version=shown(version), package=shown(package))  # fmt: skip
    return None


def screen(machine: Machine, values: Mapping[str, Value]) -> Message | None:
    """Whether the terminal has a screen."""
    del values
    display = machine.environment.get("DISPLAY") or machine.environment.get("WAYLAND_DISPLAY")
    if display:
        return say("The screen of this terminal is {display}.", display=shown(display))
    return say("DISPLAY is not set in this terminal.")


def graph_settings(machine: Machine, values: Mapping[str, Value]) -> Message | None:
    """The variables that decide which nodes the terminal sees."""
    del values
    found = [f"{name}={machine.environment[name]}" for name in OF_THE_GRAPH
             if machine.environment.get(name)]  # fmt: skip
    if not found:
        return None
    return say("This terminal has {settings}. The other one must have the same.",
               settings=shown(" ".join(found)))  # fmt: skip


def not_own_files(machine: Machine, values: Mapping[str, Value]) -> Message | None:
    """The folder of the workspace that belongs to somebody else."""
    del values
    if machine.workspace is None:
        return None
    for path in (machine.workspace, *_in(machine.workspace)):
        if path.stat().st_uid != os.getuid():
            return say("{path} belongs to another user.", path=shown(str(path)))
    return None


def groups_of_user(machine: Machine, values: Mapping[str, Value]) -> Message | None:
    """Whether the user is in the group of the device."""
    del machine
    group = str(values.get("group", ""))
    try:
        inside = grp.getgrnam(group).gr_gid in os.getgroups()
    except KeyError:
        return None
    if inside:
        return say("This terminal is in the group {group}.", group=group)
    return say("This terminal is not in the group {group}.", group=group)


def ubuntu(machine: Machine, values: Mapping[str, Value]) -> Message | None:
    """The release of the system."""
    del values
    try:
        lines = (machine.root / "etc/os-release").read_text(errors="replace").splitlines()
    except OSError:
        return None
    name = next((line.partition("=")[2] for line in lines if line.startswith("PRETTY_NAME=")), "")
    return say("This is {system}.", system=shown(name.strip('"'))) if name else None


def _in(folder: Path) -> list[Path]:
    try:
        return sorted(folder.iterdir())
    except OSError:
        return []
