"""What a text shows beside its message: whose file failed, and where a missing name is."""

from __future__ import annotations

import re

from grader.base.i18n.message import Message, say
from grader.base.shown import shown
from grader.course.interfaces import ros_interfaces

MOST = 50_000  # characters of a traceback that are searched
HEAD = "Traceback (most recent call last)"
FRAME = re.compile(
    r'^ +File "([^"\n]{1,500})", line (\d{1,7})[^\n]{0,200}(?:\n +([^\n]{0,300}))?', re.MULTILINE
)
NEUTRAL = re.compile(r"<|/opt/ros/|\S{0,200}/lib/python3(?:\.\d{1,2})?/(?!site-|dist-)")
"""Files of Python and of ROS: what they raise may be about the line that calls them."""
LIBRARY = re.compile(
    r"(?!\S{0,300}/install/)\S{0,300}(?:/site-packages/|/dist-packages/)|/usr/|<unknown>"
)
STARTS = re.compile(r"\S{0,300}/lib/([^/\s]{1,120})/[^/.\s]{1,120}$")
"""The script that ros2 run starts: it is made by the build, and nobody's to correct."""
NOT_THERE = re.compile(r"cannot import name '(\w{1,80})' from '\w{1,80}\.(msg|srv|action)'")
OF_PIP = re.compile(r"/(?:home|root|usr/local)\S{0,200}/(?:site|dist)-packages/(\w{1,80})")


def may_be_own(text: str, start: int) -> bool:
    """Whether an error can be a mistake of a student's source: a traceback above must lead there.

    An error inside of a library that is not of ROS says nothing about the student's line.
    """
    begin = text.rfind(HEAD, max(start - MOST, 0), start)
    above = text[begin:start].splitlines()[1:-1] if begin >= 0 else []
    frames = FRAME.findall("\n".join(above))
    if not frames or not all(line.startswith((" ", "|")) or not line for line in above):
        return True
    files = [file for file, _, _ in frames if file == "<unknown>" or not NEUTRAL.match(file)]
    return bool(files) and not LIBRARY.match(files[-1])


def where_it_failed(text: str) -> Message | None:
    """Return the last line of the student in the last traceback, or that there is none."""
    frames = FRAME.findall(text[text.rfind(HEAD) :][:MOST])
    own = [
        frame
        for frame in frames
        if not (NEUTRAL.match(frame[0]) or LIBRARY.match(frame[0]) or STARTS.match(frame[0]))
    ]
    if own:
        file, line, code = own[-1]
        return say("The last line of yours on the way is line {line} of {file}: {code}",
                   line=line, file=shown(file), code=shown(code.strip()))  # fmt: skip
    if frames:
        return say(
            "No line of yours is on the way. It failed in {file}.", file=shown(frames[-1][0])
        )
    return None


def packages_with(text: str) -> Message | None:
    """Return the packages of ROS that have an interface which was imported from another one."""
    found = NOT_THERE.search(text)
    packages = ros_interfaces().packages_with(*found.groups()) if found is not None else []
    if found is None or not packages:
        return None
    return say("{name} is in {packages}.", name=found[1], packages=", ".join(packages))


def from_pip(text: str) -> Message | None:
    """Return the package of pip in which it failed."""
    frames = FRAME.findall(text[text.rfind(HEAD) :][:MOST])
    found = OF_PIP.match(frames[-1][0]) if frames else None
    if found is None or "/install/" in frames[-1][0]:
        return None
    return say("{name} was installed with pip.", name=shown(found[1]))
