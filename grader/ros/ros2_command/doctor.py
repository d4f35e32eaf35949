"""Check the ROS setup of this terminal and the workspace.

These checks are our own; those of the real command are about its packages and networks.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from . import distro
from .ament_index import search_paths

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Iterator

    from .parsing import Parser

RANGES = ("SUBNET", "LOCALHOST", "OFF", "SYSTEM_DEFAULT")
RMW = "rmw_fastrtps_cpp"  # the only one on the wheels
MOST_PROBLEMS = 20


class Finding(NamedTuple):
    """A fact (`advice` is empty), or a problem with what to do about it."""

    text: str
    advice: str = ""


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 doctor`."""
    parser.add_argument(
        "-r", "--report", action="store_true", help="Print what was found, even if all is well"
    )
    parser.add_argument(
        "-iw", "--include-warnings", action="store_true", help="No effect: warnings are included"
    )


def main(args: Namespace) -> int:
    """Print the problems and what to do about each; return 1 if there are any, else 0."""
    findings = [finding for check in CHECKS for finding in check()]
    problems = [finding for finding in findings if finding.advice]
    for finding in findings if args.report else []:
        print(f"  {finding.text}")
    for problem in problems[:MOST_PROBLEMS]:
        print(f"WARNING: {problem.text}\n  {problem.advice}", file=sys.stderr)
    if problems:
        print(f"\n{len(problems)} problem{'s' if len(problems) > 1 else ''} found")
        return 1
    print(f"\nAll {len(CHECKS)} checks passed")
    return 0


def sourced() -> Iterator[Finding]:
    """Check that a ROS environment was sourced, of one distro."""
    name = distro.current()
    setup = f"source /opt/ros/{name}/setup.bash"
    if not os.environ.get("AMENT_PREFIX_PATH"):
        yield Finding("No ROS environment is sourced in this terminal", f"Run: {setup}")
        return
    yield Finding(f"distro: {name}")
    for path in os.environ["AMENT_PREFIX_PATH"].split(os.pathsep):
        if path and not Path(path).exists():
            yield Finding(
                f"AMENT_PREFIX_PATH names {path}, which does not exist (any more)",
                "Build the workspace again, then open a new terminal",
            )


def middleware() -> Iterator[Finding]:
    """Check that the middleware that is asked for is here."""
    asked = os.environ.get("RMW_IMPLEMENTATION", RMW)
    if asked == RMW:
        yield Finding(f"middleware: {asked}")
    else:
        yield Finding(
            f"RMW_IMPLEMENTATION is {asked}, but only {RMW} is here",
            "Run: unset RMW_IMPLEMENTATION",
        )


def domain() -> Iterator[Finding]:
    """Check the domain id: https://docs.ros.org/en/jazzy/Concepts/Intermediate/About-Domain-ID.html."""
    text = os.environ.get("ROS_DOMAIN_ID", "0") or "0"
    if text.isdecimal() and (int(text) <= 101 or 215 <= int(text) <= 232):
        yield Finding(f"domain id: {int(text)}")
    else:
        yield Finding(
            f"ROS_DOMAIN_ID is {text}; a domain id is a number from 0 to 101",
            "Run: export ROS_DOMAIN_ID=0 (the same number in all terminals)",
        )


def discovery_range() -> Iterator[Finding]:
    """Check with which machines nodes find each other."""
    text = os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET")
    if text.upper() not in RANGES:
        yield Finding(
            f"ROS_AUTOMATIC_DISCOVERY_RANGE is {text}; it can be {', '.join(RANGES)}",
            "Run: export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST",
        )
    elif text.upper() == "OFF":
        yield Finding(
            "ROS_AUTOMATIC_DISCOVERY_RANGE is OFF: nodes do not find each other",
            "Run: export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST",
        )
    else:
        yield Finding(f"discovery range: {text.upper()}")


def overlays() -> Iterator[Finding]:
    """Check that overlays come before the underlay, and that no package is there twice."""
    if not os.environ.get("AMENT_PREFIX_PATH"):
        return
    paths = search_paths()
    underlay = [_is_underlay(path) for path in paths]
    if True in underlay and not all(underlay[underlay.index(True) :]):
        late = paths[underlay.index(True) + underlay[underlay.index(True) :].index(False)]
        yield Finding(
            f"The workspace's {late} comes after ROS itself in AMENT_PREFIX_PATH",
            "Open a new terminal, source ROS first, then the workspace's install/setup.bash",
        )
    else:
        yield Finding(f"overlays: {underlay.index(True) if True in underlay else len(paths)}")


def builds() -> Iterator[Finding]:
    """Check that the sources of the sourced packages are not newer than their builds."""
    packages = 0
    for prefix in search_paths() if os.environ.get("AMENT_PREFIX_PATH") else []:
        workspace = Path(prefix).parents[1]
        source = workspace / "src" / Path(prefix).name
        marker = Path(prefix, "share", "colcon-core", "packages", Path(prefix).name)
        if _is_underlay(prefix) or not source.is_dir() or not marker.exists():
            continue
        packages += 1
        newer = _newer_than(source, marker.stat().st_mtime)
        if newer is not None:
            yield Finding(
                f"{newer.relative_to(workspace)} was changed after the last build of {source.name}",
                f"Run in {workspace}: colcon build --packages-select {source.name}",
            )
    yield Finding(f"built packages: {packages}")


def _newer_than(source: Path, built: float) -> Path | None:
    for name in ("setup.py", "setup.cfg", "package.xml"):
        file = source / name
        if file.is_file() and file.stat().st_mtime > built:
            return file
    return None


def _is_underlay(prefix: str) -> bool:
    return Path(prefix, "setup.bash").is_file() and Path(prefix, "bin", "ros2").exists()


CHECKS = (sourced, middleware, domain, discovery_range, overlays, builds)
