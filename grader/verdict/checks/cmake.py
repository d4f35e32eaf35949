"""The error with which CMake ends a build: its text, and the line of CMakeLists.txt."""

from __future__ import annotations

import re
from typing import NamedTuple

CMAKE = "CMakeLists.txt"
BEGIN = re.compile(r"^CMake Error at (\S+?):(\d+)\b.*:\n", re.MULTILINE)
PACKAGE = re.compile(r"^--- stderr: (\S+)$", re.MULTILINE)
CALLED_AT = re.compile(rf"^  {re.escape(CMAKE)}:(\d+) ", re.MULTILINE)
STACK = "Call Stack (most recent call first):"
MOST = 300  # characters


class CMakeError(NamedTuple):
    """An error in the CMakeLists.txt of a package, and its line."""

    package: str
    line: int
    text: str


def cmake_error(log: str) -> CMakeError | None:
    """Return the first error of CMake in colcon's output; None if no CMakeLists.txt is named.

    The error may be in a function of a package of ROS; the line is then that of its call.
    """
    begin = BEGIN.search(log)
    if begin is None:
        return None
    packages = PACKAGE.findall(log, 0, begin.start())
    text, _, stack = log[begin.end() :].partition("\n\n\n")[0].partition(STACK)
    called = CALLED_AT.search(stack)
    line = begin[2] if begin[1] == CMAKE else called[1] if called else ""
    if not packages or not line:
        return None
    return CMakeError(packages[-1], int(line), " ".join(text.split())[:MOST])
