"""Recognise mistakes in the output of a terminal."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import islice
from types import MappingProxyType

from grader.base.i18n.message import Message
from grader.explain import environment, terminal
from grader.explain.terminal_text import TerminalText
from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.kind import Kind

MOST = 200_000  # characters that are searched, at the end of the text: errors come last
MOST_OF_A_KIND = 20  # matches of one kind of mistake that are examined
LONGEST = 2_000  # characters of a line that are searched
MOST_TRACEBACK = 50_000  # characters of a traceback that are searched
ENTRIES: Mapping[str, Kind] = MappingProxyType(
    {
        kind.id: kind
        for kinds in (environment.KINDS, CATALOGUE.values(), terminal.KINDS)
        for kind in kinds
    }
)
"""All entries: what concerns the environment comes before what is said of a student's source."""
OF_LAUNCH = re.compile(r"^\[[\w.+-]{1,80}-\d{1,4}\] ?")
"""What `ros2 launch` writes before each line of a process."""
DISTRO = re.compile(r"/opt/ros/([a-z]{1,20})/")
FRAME = re.compile(r'^ +File "([^"\n]{1,500})", line \d', re.MULTILINE)
NEUTRAL = re.compile(r"<|/opt/ros/|\S{0,200}/lib/python3(?:\.\d{1,2})?/(?!site-|dist-)")
"""Files of Python and of ROS: what they raise may be about the line that calls them."""
LIBRARY = re.compile(r"(?!\S{0,300}/install/)\S{0,300}(?:/site-packages/|/dist-packages/)|/usr/")


@dataclass(frozen=True)
class Seen:
    """A mistake that a text shows, the line that shows it, and what else the text shows of it."""

    kind: Kind
    params: dict[str, str]
    line: str
    variant: str = ""
    shown: tuple[Message, ...] = ()


def seen_in(text: str) -> list[Seen]:
    """Return the mistakes that a text shows, root causes first.

    If several entries match the same words, the first entry gets them.
    """
    lines = (OF_LAUNCH.sub("", line[:LONGEST]) for line in text[-MOST:].splitlines())
    text = "\n".join(lines)
    distros = set(DISTRO.findall(text))
    common = {"distro": distros.pop()} if len(distros) == 1 else {}
    taken: list[tuple[int, int]] = []
    found: list[Seen] = []
    for kind in ENTRIES.values():
        matches = kind.pattern.finditer(text) if kind.pattern is not None else iter(())
        for match in islice(matches, MOST_OF_A_KIND):
            start, end = match.span()
            if any(start < other_end and other_start < end for other_start, other_end in taken):
                continue
            seen = _read(kind, text, match, common)
            if seen is None:
                continue
            taken.append((start, end))
            if all(other.kind is not kind or other.params != seen.params for other in found):
                found.append(seen)
    return found


def _read(kind: Kind, text: str, match: re.Match[str], common: Mapping[str, str]) -> Seen | None:
    """Return what a match shows; None if the rest of the text speaks against it."""
    start, end = match.span()
    groups = ((name, value) for name, value in match.groupdict("").items() if value)
    known = {**common, **{re.sub(r"_\d$", "", name): value for name, value in groups}}
    line = _line_around(text, start, end)
    if not isinstance(kind, TerminalText):
        of_source = kind.id.startswith("node.")
        return None if of_source and not _may_be_own(text, start) else Seen(kind, known, line)
    if kind.excluded_by(text):
        return None
    variant, values = kind.variant_in(text)
    return Seen(kind, {**values, **known}, line, variant, tuple(kind.shown_in(text)))


def _may_be_own(text: str, start: int) -> bool:
    """Whether an error can be a mistake of a student's source: a traceback above must lead there.

    An error inside of a library that is not of ROS says nothing about the student's line.
    """
    begin = text.rfind("Traceback (most recent call last)", max(start - MOST_TRACEBACK, 0), start)
    above = text[begin:start].splitlines()[1:-1] if begin >= 0 else []
    frames = FRAME.findall("\n".join(above))
    if not frames or not all(line.startswith((" ", "|")) or not line for line in above):
        return True
    frames = [frame for frame in frames if not NEUTRAL.match(frame)]
    return bool(frames) and not LIBRARY.match(frames[-1])


def _line_around(text: str, start: int, end: int) -> str:
    before = text.rfind("\n", 0, start + 1) + 1
    after = text.find("\n", max(end - 1, before))
    return text[before : after if after >= 0 else len(text)].strip()
