"""Recognise mistakes in the output of a terminal."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import islice
from types import MappingProxyType

from grader.base.i18n.message import Message
from grader.explain.frames import may_be_own
from grader.explain.machine import Machine
from grader.explain.terminal_text import TerminalText, groups
from grader.explain.texts import TEXTS
from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.kind import Kind

MOST = 200_000  # characters that are searched, at the end of the text: errors come last
MOST_OF_A_KIND = 20  # matches of one kind of mistake that are examined
LONGEST = 2_000  # characters of a line that are searched
ENTRIES: Mapping[str, Kind] = MappingProxyType(
    {
        kind.id: kind
        for kinds in (
            (text for text in TEXTS if text.stage == "environment"),
            CATALOGUE.values(),
            (text for text in TEXTS if text.stage == "terminal"),
            (text for text in TEXTS if text.stage == "general"),
        )
        for kind in kinds
    }
)
"""All entries: what concerns the environment comes before what is said of a student's source."""
OF_LAUNCH = re.compile(r"^\[[\w.+-]{1,80}-\d{1,4}\] ?")
"""What `ros2 launch` writes before each line of a process."""
DISTRO = re.compile(
    r"(?:/opt/ros/|\bROS_DISTRO=|\$\{?ROS_DISTRO\}?\n|printenv ROS_DISTRO\n)([a-z]{1,20})(?![\w.-])"
)
ABSENT = re.compile(
    r"/opt/ros/([a-z]{1,20})/\S{1,40}: No such file|no such file or directory: /opt/ros/([a-z]{1,20})/"
)
"""What shows that the ROS of a path is not there."""


WORKSPACE = "~/ros2_ws"
"""How the texts call the workspace."""
IN_WORKSPACE = re.compile(
    r"(?:~|/home/[\w.-]{1,40}|/root)/([\w.-]{1,60}(?:/[\w.-]{1,60}){0,2}?)/(?:install|build|src)\b"
    r"|:~/([\w.-]{0,50}ws)(?=[/$ ])"
)
"""A path below a workspace, or a prompt in one."""


@dataclass(frozen=True)
class Seen:
    """A mistake that a text shows, the line that shows it, and what else the text shows of it."""

    kind: Kind
    params: dict[str, str]
    line: str
    variant: str = ""
    shown: tuple[Message, ...] = ()
    here: tuple[Message, ...] = ()


def seen_in(text: str, machine: Machine | None = None) -> list[Seen]:
    """Return the mistakes that a text shows, root causes first, and what a machine shows of them.

    If several entries match the same words, the first entry gets them. A general entry is told only
    if there is nothing else.
    """
    lines = (OF_LAUNCH.sub("", line[:LONGEST]) for line in text[-MOST:].splitlines())
    text = "\n".join(lines)
    common = _distro_in(text)
    taken: list[tuple[int, int]] = []
    found: list[Seen] = []
    for kind in ENTRIES.values():
        if found and kind.stage == "general":
            break
        matches = kind.pattern.finditer(text) if kind.pattern is not None else iter(())
        for match in islice(matches, MOST_OF_A_KIND):
            start, end = match.span("told" if "told" in match.re.groupindex else 0)
            if any(start < other_end and other_start < end for other_start, other_end in taken):
                continue
            seen = _read(kind, text, match, common, machine)
            if seen is None:
                continue
            taken.append((start, end))
            if not any(_same(seen, other) for other in found):
                found.append(seen)
    return found


def _distro_in(text: str) -> dict[str, str]:
    """Return the only ROS that is named and there, as a value of the texts."""
    distros = set(DISTRO.findall(text)) - {name for one in ABSENT.findall(text) for name in one}
    return {"distro": distros.pop()} if len(distros) == 1 else {}


def workspace_in(text: str) -> str:
    """Return the only workspace that a text names, from the home folder on; "" if it is not clear."""
    found = {first or second for first, second in IN_WORKSPACE.findall(text[-MOST:])}
    return f"~/{found.pop()}" if len(found) == 1 else ""


def _same(seen: Seen, other: Seen) -> bool:
    """Whether both say the same: an entry of a terminal is told once."""
    told_once = isinstance(seen.kind, TerminalText)
    return seen.kind is other.kind and (told_once or seen.params == other.params)


def _read(
    kind: Kind,
    text: str,
    match: re.Match[str],
    common: Mapping[str, str],
    machine: Machine | None,
) -> Seen | None:
    """Return what a match shows; None if the rest of the text, or the machine, speaks against it."""
    known = {**common, **groups(match)}
    told = known.pop("told", None)
    line = told.strip() if told else _line_around(text, *match.span())
    if not isinstance(kind, TerminalText):
        of_source = kind.id.startswith(("node.", "source.syntax_error"))
        return (
            None if of_source and not may_be_own(text, match.start()) else Seen(kind, known, line)
        )
    if kind.excluded_by(text):
        return None
    case, values = kind.case_in(text)
    known = {**known, **values}
    here = kind.found_on(machine, {**kind.values, **known}) if machine is not None else []
    if kind.only_if_found and not here:
        return None
    return Seen(kind, known, line, case, tuple(kind.shown_in(text)), tuple(here))


def _line_around(text: str, start: int, end: int) -> str:
    before = text.rfind("\n", 0, start + 1) + 1
    after = text.find("\n", max(end - 1, before))
    return text[before : after if after >= 0 else len(text)].strip()
