"""The program that a script's first line names, where it is not on this machine."""

from __future__ import annotations

import os

LONGEST = 512  # bytes of a first line
REBUILD = """\
{path} cannot start: its first line names {program}, which is not here.
The workspace was built with another Python. Build it again:
  cd ~/ros2_ws && rm -r build install log && colcon build --symlink-install"""


def missing_program(script: str) -> str:
    """Return the program of the first line if it is an absolute path and not here, else ""."""
    try:
        with open(script, "rb") as file:  # noqa: PTH123 (pathlib would delay the message)
            line = file.readline(LONGEST).decode("utf-8", "replace")
    except OSError:
        return ""
    words = line[2:].split() if line.startswith("#!") else []
    return words[0] if words and not os.path.exists(words[0]) else ""  # noqa: PTH110
