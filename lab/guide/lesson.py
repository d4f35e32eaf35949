"""The lesson as its steps; each is a section `## N. Title` of lesson.md."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

HEADING = re.compile(r"^## (\d+)\. (.+)$", re.MULTILINE)
WRITTEN_FOR = "/opt/ros/jazzy"


@dataclass(frozen=True)
class Step:
    """One step: `text` is Markdown, without the heading."""

    number: int
    title: str
    text: str


@dataclass(frozen=True)
class Lesson:
    """A lesson: `introduction` is what comes before the first step, its title included."""

    introduction: str
    steps: tuple[Step, ...]


def lesson_file(course: Path, lang: str) -> Path:
    """Return the lesson in a language, `lesson.<lang>.md`; without one, the English."""
    own = course / f"lesson.{lang}.md"
    return own if own.is_file() else course / "lesson.md"


def read_lesson(file: Path, *, distro: str) -> Lesson:
    """Return the lesson, with the commands of this distro."""
    text = file.read_text(encoding="utf-8").replace(WRITTEN_FOR, f"/opt/ros/{distro}")
    introduction, *parts = HEADING.split(text)
    sections = zip(parts[0::3], parts[1::3], parts[2::3])
    steps = tuple(Step(int(number), title, body.strip()) for number, title, body in sections)
    return Lesson(introduction.strip(), steps)
