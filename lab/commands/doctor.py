"""`lab doctor`: what often goes wrong in a terminal or a workspace, and what to do about it."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import errors_in
from grader.cli import options

if TYPE_CHECKING:
    from grader.base.gated_console import GatedConsole
    from lab.guide.opened import OpenedLab
    from lab.guide.state import StudentState

LITTLE = 200_000_000  # bytes of free space
MOST_FILES = 2_000  # that are looked at

MARK = 6  # columns of the mark before a finding


@dataclass(frozen=True)
class Finding:
    """A thing that was looked at; `remedy` is "" if it is as it should be."""

    text: str
    remedy: str = ""


@click.command(
    help=msg(
        "Look for what often goes wrong: ROS not sourced, a wrong folder, an old build or one for "
        "another ROS, a workspace in a workspace, overlays in a wrong order. Exit status 1 if "
        "something is wrong."
    )
)
@options.lang
def doctor(lang: str | None) -> int:
    """Print each finding with what to do."""
    from lab.guide.opened import opened_lab  # noqa: PLC0415 - keeps --help fast
    from lab.guide.show import console_for  # noqa: PLC0415

    with errors_in(lang):
        lab = opened_lab(lang)
        console = console_for(sys.stdout)
        wrong = 0
        for finding in findings(lab, dict(os.environ), Path.cwd()):
            mark = say("wrong") if finding.remedy else say("ok")
            _print(console, lab.translate(mark), lab.translate(finding.text))
            if finding.remedy:
                wrong += 1
                _print(console, "", f"→ {lab.translate(finding.remedy)}")
        return 1 if wrong else 0


def _print(console: GatedConsole, mark: str, text: str) -> None:
    """Print a text beside a mark; on a terminal its lines stay beside it, but for commands."""
    from rich.cells import set_cell_size  # noqa: PLC0415 - keeps --help fast
    from rich.table import Table  # noqa: PLC0415
    from rich.text import Text  # noqa: PLC0415

    from grader.report.commands import is_command  # noqa: PLC0415

    line = Text(set_cell_size(mark, MARK) + text)
    if not console.is_terminal or is_command(text.removeprefix("→ ")):
        console.print(line, soft_wrap=True)
        return
    row = Table.grid()
    row.add_column(width=MARK)
    row.add_column(overflow="fold")
    row.add_row(mark, Text(text))
    console.print(row)


def findings(lab: OpenedLab, environment: dict[str, str], folder: Path) -> Iterator[Finding]:
    """Yield what is right and what is wrong with a terminal in this folder."""
    from lab.guide.owners import not_yours  # noqa: PLC0415 - keeps --help fast
    from lab.guide.runs import stopped  # noqa: PLC0415
    from lab.guide.state import StudentState  # noqa: PLC0415

    state = StudentState(lab.workspace, lab.assignment, environment, home=lab.home)
    yield _sourced(environment, lab.distro)
    yield from _overlays(environment, lab.workspace)
    yield _folder(folder, lab.workspace)
    yield from _builds(state)
    yield from _nested(lab.workspace)
    yield _newest(state)
    for action in (not_yours(state), stopped(state)):
        if action is not None:
            yield Finding(action.found, action.next)
    yield from _network(environment)
    yield _space(lab.workspace)


def _sourced(environment: dict[str, str], distro: str) -> Finding:
    paths = environment.get("AMENT_PREFIX_PATH", "")
    if not paths:
        return Finding(
            say("ROS is not sourced in this terminal"),
            say("Run: source /opt/ros/{distro}/setup.bash", distro=distro),
        )
    if f"/opt/ros/{distro}" not in paths.split(os.pathsep):
        return Finding(
            say("this terminal does not have ROS {distro}", distro=distro),
            say("Open a new terminal, then: source /opt/ros/{distro}/setup.bash", distro=distro),
        )
    return Finding(say("ROS {distro} is sourced", distro=distro))


def _overlays(environment: dict[str, str], workspace: Path) -> Iterator[Finding]:
    install = (workspace / "install").resolve()
    paths = [Path(p) for p in environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if p]
    own = [n for n, path in enumerate(paths) if path.resolve().is_relative_to(install)]
    under = [n for n, path in enumerate(paths) if str(path).startswith("/opt/ros/")]
    other = [p for n, p in enumerate(paths) if n not in own and n not in under]
    if not own:
        if install.is_dir():
            yield Finding(
                say("the workspace's overlay is not sourced in this terminal"),
                "cd ~/ros2_ws && source install/local_setup.bash",
            )
        return
    if under and min(under) < min(own):
        yield Finding(
            say("ROS comes before your workspace, so its packages hide yours"),
            say("Open a new terminal. Source ROS first, then your workspace."),
        )
    else:
        yield Finding(say("the workspace's overlay is sourced, on top of ROS"))
    gone = [str(path) for n, path in enumerate(paths) if n not in under and not path.exists()]
    if gone:
        yield Finding(
            say("this terminal has sourced a folder that is gone: {path}", path=gone[0]),
            say("Open a new terminal, and source again what you need."),
        )
    for path in other[:1]:
        yield Finding(
            say("this terminal has also sourced another workspace: {path}", path=str(path)),
            say("Open a new terminal if you do not need it."),
        )


def _folder(folder: Path, workspace: Path) -> Finding:
    inside = folder.resolve()
    root = workspace.resolve()
    if inside == root or not inside.is_relative_to(root):
        return Finding(say("you are in {path}", path=str(folder)))
    if inside == root / "src" or inside.is_relative_to(root / "src"):
        return Finding(say("you are in {path}; build in ~/ros2_ws", path=str(folder)))
    return Finding(
        say("you are in {path}, which the build makes", path=str(folder)), "cd ~/ros2_ws"
    )


def _builds(state: StudentState) -> Iterator[Finding]:
    from lab.guide.builds import built, elsewhere  # noqa: PLC0415
    from lab.guide.predicates import STEPS  # noqa: PLC0415
    from lab.other_ros import other_ros  # noqa: PLC0415

    wrong = elsewhere(state)
    if wrong is not None:
        yield Finding(wrong.found, wrong.next)
    if not (state.workspace / "install").is_dir():
        yield Finding(say("the workspace is not built yet"))
        return
    if (other := other_ros(state.workspace, state.environment)) is not None:
        yield Finding(*other)
        return
    action = built(state)
    entry = STEPS["entry_point"](state)
    early = entry is not None and entry.id == "setup.no_entry"
    if action is None or (early and action.id == "executable" and not action.found):
        yield Finding(say("the build is up to date"))
    elif action.found and action is not wrong:
        yield Finding(action.found, action.next)
    elif action.id == "executable":
        name = state.assignment.executable
        yield Finding(say("the build made no executable {name}", name=name), action.next)


def _nested(workspace: Path) -> Iterator[Finding]:
    for found in sorted((workspace / "src").glob("**/src/*/package.xml"))[:1]:
        inner = found.parent.parent.relative_to(workspace)
        yield Finding(
            say("there is a workspace in the workspace: {path}", path=f"~/ros2_ws/{inner}"),
            say("Move its packages to ~/ros2_ws/src."),
        )
    for mark in sorted((workspace / "src").glob("**/COLCON_IGNORE"))[:1]:
        if mark.parent.name not in ("build", "install", "log"):
            yield Finding(
                say("colcon skips {path}", path=f"~/ros2_ws/{mark.parent.relative_to(workspace)}"),
                say("If it is to be built, remove its file COLCON_IGNORE."),
            )


def _newest(state: StudentState) -> Finding:
    copy = state.submission.newer_copy
    if copy:
        return Finding(
            say("a newer copy of your node is in {path}", path=f"~/ros2_ws/{copy}"),
            say("You edited what the build makes. Copy your changes to the file in src."),
        )
    return Finding(say("your files in src are the newest"))


def _network(environment: dict[str, str]) -> Iterator[Finding]:
    domain = environment.get("ROS_DOMAIN_ID", "")
    if domain and not (domain.isdecimal() and int(domain) <= 232):
        yield Finding(
            say("ROS_DOMAIN_ID is '{value}'", value=domain),
            say("It must be a number from 0 to 101. Run: unset ROS_DOMAIN_ID"),
        )
    wanted = environment.get("RMW_IMPLEMENTATION", "")
    if wanted and wanted != "rmw_fastrtps_cpp":
        yield Finding(
            say("RMW_IMPLEMENTATION is {value}, which is not installed here", value=wanted),
            say("Run: unset RMW_IMPLEMENTATION"),
        )


def _space(workspace: Path) -> Finding:
    free = shutil.disk_usage(workspace).free
    if free < LITTLE:
        return Finding(
            say("the disk has only {free} MB left", free=free // 1_000_000),
            say("Remove ~/ros2_ws/log, and build again."),
        )
    return Finding(say("there is space on the disk"))
