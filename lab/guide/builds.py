"""What a build left: in the wrong folder, missing, or older than the source."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from grader.base.i18n.message import say
from lab.guide.action import Action
from lab.guide.state import StudentState
from lab.other_ros import other_ros

BUILD = "cd ~/ros2_ws && colcon build --symlink-install"
ENTRIES = say("The build reads the entry points from setup.py and makes a program of each.")


def built(state: StudentState) -> Action | None:
    """Done if a build installed the node's executable, and nothing of it is older than the source."""
    name = state.assignment.package
    if not state.installed(f"lib/{name}/{state.assignment.executable}"):
        return elsewhere(state) or Action(BUILD, "executable", hints=(ENTRIES,))
    if (misplaced := elsewhere(state)) is not None:
        return misplaced
    if _other_entry(state):
        found = say("setup.py has changed since the last build")
        return Action(BUILD, "build.stale", found=found, hints=(ENTRIES,))
    if _other_copy(state):
        found = say("the build has an older copy of {file}", file=state.assignment.node_file)
        why = say("With --symlink-install the build links to your file instead of copying it.")
        return Action(BUILD, "build.old_copy", found=found, hints=(why,))
    return None


def elsewhere(state: StudentState) -> Action | None:
    """Return the action for a build in another folder than the workspace.

    Beside a good one it does harm too: colcon finds a package's copy in it, and its overlay may be
    the one that is sourced.
    """
    built_well = state.program.exists() or state.installed(
        f"share/ament_index/resource_index/packages/{state.assignment.package}"
    )
    folders = {"~/ros2_ws/src": state.workspace / "src"}
    folders[f"~/ros2_ws/src/{state.assignment.package}"] = state.package
    if state.home is not None and not built_well:
        folders["~"] = state.home
    for name, folder in folders.items():
        if (folder / "install").is_dir() and (folder / "build").is_dir():
            made = [each for each in ("build", "install", "log") if (folder / each).is_dir()]
            delete = f"cd {name} && rm -r {' '.join(made)}"
            return Action(
                delete if built_well else f"{delete}; {BUILD}",
                "build.elsewhere",
                found=say("you built in {folder}", folder=name),
                hints=(say("colcon builds in the folder in which it is called."),),
            )
    return None


def for_other_ros(state: StudentState) -> Action | None:
    """Return the action for a build whose programs cannot start with the ROS that is here."""
    found = other_ros(state.workspace, state.environment)
    if found is None:
        return None
    why = say(
        "A build belongs to one release of ROS and one Python: it writes their paths into the programs "
        "that it installs. Your files in src stay as they are."
    )
    return Action(found[1], "build.other_ros", found=found[0], hints=(why,))


def _other_entry(state: StudentState) -> bool:
    """Whether the last build read another target of the executable from setup.py."""
    assignment = state.assignment
    line = f"{assignment.executable}={assignment.target}"
    texts = [state.read(file).decode("utf-8", "replace") for file in _entry_files(state)]
    return bool(texts) and not any(line in text.replace(" ", "") for text in texts)


def _entry_files(state: StudentState) -> Iterator[Path]:
    name = state.assignment.package
    yield from (state.workspace / "build" / name).glob("*.egg-info/entry_points.txt")
    yield from _site(state, "*-info/entry_points.txt")


def _other_copy(state: StudentState) -> bool:
    """Whether the build installed a copy of the node's file that differs from it."""
    inner = f"{state.assignment.package}/{state.assignment.node_file}"
    copies = [file for file in _site(state, inner) if not file.is_symlink()]
    return any(state.read(file) != state.read(state.node) for file in copies)


def _site(state: StudentState, pattern: str) -> Iterator[Path]:
    install = state.workspace / "install"
    for folder in (install / state.assignment.package, install):
        yield from folder.glob(f"lib/python3*/site-packages/{pattern}")
