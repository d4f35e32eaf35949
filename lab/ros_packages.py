"""The ROS packages that a lab has only where they can be had: turtlesim, which has no wheel."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path

TURTLESIM = "turtlesim"
"""The package of turtlesim's programs, in every distro."""
OPTIONAL_PACKAGES = (TURTLESIM,)
INSTALLED = "/opt/ros"


def has_package(name: str, environment: Mapping[str, str]) -> bool:
    """Whether the ROS of a terminal, or of the lab that it is in, has a package."""
    return any((prefix / "share" / name / "package.xml").is_file() for prefix in _of(environment))


def _of(environment: Mapping[str, str]) -> Iterator[Path]:
    """Yield the prefixes of a terminal; the lab's first, which is there before it is sourced."""
    distro = environment.get("ROS_DISTRO")
    if distro and environment.get("LAB_WORKSPACE"):
        yield Path(INSTALLED, distro)
    for prefix in environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep):
        if prefix:
            yield Path(prefix)
