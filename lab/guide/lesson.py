"""Reads a lesson: each section `## N. Title` of lesson.md is a step.

The line below the heading may name the test that recognises the step as done:
`<!-- done: package -->`, a name in `lab.guide.predicates.STEPS`. Markdown does not show it. After a
semicolon, `optional` marks a step that nothing else waits for, and `needs: turtlesim` one that is
left out where the lab does not have this ROS package. `<!-- needs: turtlesim -->` above a paragraph
does the same for the paragraph.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.base.nearest import meant, nearest
from grader.ros.distro import distros
from lab.ros_packages import OPTIONAL_PACKAGES

TEXT = "lesson.md"
HEADING = re.compile(r"^## (\d+)\. (.+)$", re.MULTILINE)
OF_TURTLESIM = re.compile(r"\bturtlesim(?=\.(?:msg|srv|action)\b|/(?:msg|srv|action)/|</depend>)")
"""The package of turtlesim's interfaces, where a lesson names it."""
DONE = re.compile(r"\A\s*<!-- done: ([^>\n]{1,120}?) -->\s*")
NEEDS = re.compile(r"^<!-- needs: ([\w-]+) -->\n(.+?)(?:\n\n|\n?\Z)", re.MULTILINE | re.DOTALL)
NEEDED = "needs: "
OPTIONAL = "optional"
MARKS = (OPTIONAL, *(f"{NEEDED}{name}" for name in OPTIONAL_PACKAGES))
"""What may follow a step's condition."""


@dataclass(frozen=True)
class Step:
    """A step: `text` is Markdown without the heading.

    `done` names the test that recognises the step as done, "" if there is none (a step to read).
    `optional` is a step that may be left out, `needs` the ROS package without which it cannot be done.
    """

    number: int
    title: str
    text: str
    done: str = ""
    optional: bool = False
    needs: str = ""


@dataclass(frozen=True)
class Lesson:
    """A lesson; `introduction` is the text before the first step, including the title."""

    introduction: str
    steps: tuple[Step, ...]

    @property
    def count(self) -> int:
        """The number of the last step. A step 0, before the first one, is not counted."""
        return self.steps[-1].number


def lesson_file(folder: Path, lang: str) -> Path:
    """Return the lesson in a language, `lesson.<lang>.md`, or the English one if it is missing."""
    own = folder / f"lesson.{lang}.md"
    return own if own.is_file() else folder / TEXT


def read_lesson(file: Path, *, distro: str, packages: Collection[str] = ()) -> Lesson:
    """Return the lesson, with the paths and documentation links of this distro.

    Of what the lesson marks as needing a ROS package, only what needs one of `packages` is there.

    UsageError if the file cannot be read or has no steps, or if a step has an unknown mark.
    """
    try:
        text = file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        text = ""
    text = NEEDS.sub(lambda mark: f"{mark[2]}\n\n" if mark[1] in packages else "", text)
    introduction, *parts = HEADING.split(_of_distro(text, distro))
    sections = zip(parts[0::3], parts[1::3], parts[2::3])
    found = [_step(int(number), title, body) for number, title, body in sections]
    steps = tuple(step for step in found if not step.needs or step.needs in packages)
    if not steps:
        raise UsageError(
            say("there is no lesson with steps in {file}", file=str(file)),
            remedy=say("A step starts with a line '## 1. Title'. `check` works without a lesson."),
        )
    return Lesson(introduction.strip(), steps)


def _step(number: int, title: str, body: str) -> Step:
    mark = DONE.match(body)
    if mark is None:
        return Step(number, title, body.strip())
    done, *words = (word.strip() for word in mark[1].split(";"))
    for word in words:
        if word not in MARKS:
            raise UsageError(
                say("step {number} of the lesson: unknown mark '{word}'", number=number, word=word)
                + meant(nearest(word, MARKS)),
                remedy=say("Known: {names}.", names=", ".join(MARKS)),
            )
    needs = next((word.removeprefix(NEEDED) for word in words if word.startswith(NEEDED)), "")
    return Step(number, title, body[mark.end() :].strip(), done, OPTIONAL in words, needs)


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
