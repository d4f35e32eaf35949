"""Folds the calls inside ROS and Python in a traceback: a student looks for their own lines."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from grader.base.i18n.message import say_plural

FRAME = re.compile(r' {2}File "(?P<path>[^"\n]{1,500})", line \d{1,9}(?:, in .*)?')
INSIDE = 4  # columns: how far the code of a frame is indented at least
LIBRARY = re.compile(r"/lib/python3[\d.]{0,4}/(?:(?:site|dist)-packages/(?P<package>[a-z]{1,40}))?")
OWN = "/install/"  # in the path of a student's package that was built without --symlink-install
FROZEN = "<frozen "
EXECUTABLE = re.compile(r"/install/[^/]{1,200}/lib/[^/]{1,200}/[^/.]{1,200}\Z")
COLCON = "colcon"
PYTHON = "Python"


def folded(text: str, *, translate: Callable[[str], str] = str) -> str:
    """Return a text in which successive calls inside ROS's and Python's files are one line each.

    So are those in the executable that colcon makes. Calls in the student's files stay, and so does
    the last line, the error.
    """
    if FRAME.search(text) is None:
        return text
    return "\n".join(_lines(text.replace("\r\n", "\n").split("\n"), translate))


def _lines(lines: list[str], translate: Callable[[str], str]) -> Iterator[str]:
    names: list[str] = []  # of what the successive frames are in, one for each
    number = 0
    while number < len(lines):
        end = _end_of_frame(lines, number)
        name = _library(lines[number]) if end else ""
        if name:
            names.append(name)
            number = end
            continue
        if names:
            yield _left_out(names, translate)
            names = []
        yield from lines[number : max(end, number + 1)]
        number = max(end, number + 1)
    if names:
        yield _left_out(names, translate)


def _end_of_frame(lines: list[str], number: int) -> int:
    """Return the number of the line after the frame that begins at a line; 0 if none begins."""
    if FRAME.fullmatch(lines[number]) is None:
        return 0
    number += 1
    while number < len(lines) and lines[number].startswith((" " * INSIDE, "  [Previous line")):
        number += 1
    return number


def _library(line: str) -> str:
    """Return the name of what a frame is in: a package of ROS, or Python; "" for other files."""
    frame = FRAME.fullmatch(line)
    path = frame["path"] if frame else ""
    if path.startswith(FROZEN):
        return PYTHON
    if EXECUTABLE.search(path) is not None:
        return COLCON
    found = LIBRARY.search(path)
    if found is None or OWN in path[: found.start()]:
        return ""
    return found["package"] or PYTHON


def _left_out(names: list[str], translate: Callable[[str], str]) -> str:
    text = say_plural(
        "[... 1 call inside {names} left out ...]",
        "[... {count} calls inside {names} left out ...]",
        len(names),
        names=", ".join(dict.fromkeys(names)),
    )
    return f"  {translate(text)}"
