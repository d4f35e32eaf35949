"""Adds our own programs to a prefix that `wheels_tree` has made, in the image's build.

`python -m grader.ros.prefix_code DISTRO INTERPRETER` changes /opt/ros/DISTRO.
"""

from __future__ import annotations

import sys
from pathlib import Path

from grader.ros.prefix_build import install_command
from grader.ros.turtlesim_executables import install_programs


def main(distro: str, interpreter: str) -> None:
    """Install `ros2` and turtlesim's programs."""
    prefix = Path("/opt/ros") / distro
    install_command(distro, prefix, Path(interpreter))
    install_programs(prefix, Path(interpreter))


if __name__ == "__main__":
    main(*sys.argv[1:])
