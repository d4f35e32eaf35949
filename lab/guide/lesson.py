"""Reads a lesson: each section `## N. Title` of lesson.md is a step.

The line below the heading may name the test that recognises the step as done:
`<!-- done: package -->`, a name in `lab.guide.progress.STEPS`. Markdown does not show it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.ros.distro import distros

TEXT = "lesson.md"
HEADING = re.compile(r"^## (\d+)\. (.+)$", re.MULTILINE)
OF_TURTLESIM = re.compile(r"\bturtlesim(?=\.(?:msg|srv|action)\b|/(?:msg|srv|action)/|</depend>)")
"""The package of turtlesim's interfaces, where a lesson names it."""
DONE = re.compile(r"\A\s*<!-- done: ([^>\n]{1,80}?) -->\s*")


@dataclass(frozen=True)
class Step:
    """A step: `text` is Markdown without the heading.

    `done` names the test that recognises the step as done, "" if there is none (a step to read).
    """

    number: int
    title: str
    text: str
    done: str = ""


@dataclass(frozen=True)
class Lesson:
    """A lesson; `introduction` is the text before the first step, including the title."""

    introduction: str
    steps: tuple[Step, ...]


def lesson_file(folder: Path, lang: str) -> Path:
    """Return the lesson in a language, `lesson.<lang>.md`, or the English one if it is missing."""
    own = folder / f"lesson.{lang}.md"
    return own if own.is_file() else folder / TEXT


def read_lesson(file: Path, *, distro: str) -> Lesson:
    """Return the lesson, with the paths and documentation links of this distro.

    UsageError if the file cannot be read or has no steps.
    """
    try:
        text = file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        text = ""
    introduction, *parts = HEADING.split(_of_distro(text, distro))
    sections = zip(parts[0::3], parts[1::3], parts[2::3])
    steps = tuple(_step(int(number), title, body) for number, title, body in sections)
    if not steps:
        raise UsageError(
            say("there is no lesson with steps in {file}", file=str(file)),
            remedy=say("A step starts with a line '## 1. Title'. `check` works without a lesson."),
        )
    return Lesson(introduction.strip(), steps)


def _step(number: int, title: str, body: str) -> Step:
    mark = DONE.match(body)
    text = body[mark.end() :] if mark is not None else body
    return Step(number, title, text.strip(), mark[1].strip() if mark is not None else "")


def _of_distro(text: str, distro: str) -> str:
    """Return a text with the paths and documentation links of any distro replaced by this one's."""
    known = distros()
    for other in known.values():
        text = text.replace(f"/opt/ros/{other.name}", f"/opt/ros/{distro}")
        if distro in known:
            text = text.replace(other.documentation, known[distro].documentation)
    if distro in known:
        text = OF_TURTLESIM.sub(known[distro].turtlesim, text)
    return text
