"""What comes after a lesson: what it taught, where to read on, and the next lesson of the course.

A lesson may have a file `learned.md` (`learned.ko.md`): a line that says what was learned, and
below it the address of a page of the documentation.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from grader.base.errors import GraderError
from grader.base.i18n.message import Message, joined, say
from grader.course.find import GONE_ON, lessons_of
from grader.course.folder import course_folder
from grader.ros.distro import distros

LEARNED, TEXT = "learned", "lesson"
MOST = 2_000  # characters that are read of a file
HEADING = re.compile(r"^# (.+)$", re.MULTILINE)
ADDRESS = re.compile(r"^https://\S+$", re.MULTILINE)


@dataclass(frozen=True)
class After:
    """What was learned, the address of a page to read, and the next lesson's id and title.

    What there is not is "".
    """

    learned: str = ""
    documentation: str = ""
    id: str = ""
    title: str = ""

    def in_lab(self, environment: Mapping[str, str]) -> str:
        """Return how a student in a lab gets to the next lesson; "" if this is the last one."""
        if self.goes_on(environment):
            title = self.title or self.id
            return say("lab next goes on with the next lesson: {title}.", title=title)
        return "" if environment.get(GONE_ON) else say("The next lesson: exit, then make lab.")

    def goes_on(self, environment: Mapping[str, str]) -> bool:
        """Whether there is a next lesson, and `lab next` goes on with it."""
        return bool(self.id and environment.get(GONE_ON))


def hand_in(following: str, archive: str = "") -> Message:
    """Return what is left when a lesson is done: to hand in, and to go on (`After.in_lab`)."""
    if archive:
        return joined(
            say("The archive to hand in: {file}.", file=f"~/ros2_ws/{archive}"), following
        )
    return joined(say("lab submit makes the archive to hand in."), following)


def after_lesson(assignment: str, *, lang: str, distro: str) -> After:
    """Return what comes after a lesson of the course; nothing if it is not one of its lessons."""
    course = course_folder()
    try:
        lessons = lessons_of(course)
    except GraderError:  # a broken course.yaml is told where lessons are opened
        return After()
    if assignment not in lessons:
        return After()
    text = _text_of(course / assignment, LEARNED, lang)
    address = ADDRESS.search(text)
    learned = ADDRESS.sub("", text).strip().partition("\n")[0]
    following = lessons[lessons.index(assignment) + 1 :][:1]
    heading = HEADING.search(_text_of(course / following[0], TEXT, lang)) if following else None
    return After(
        learned,
        _of_distro(address[0], distro) if address else "",
        following[0] if following else "",
        heading[1].strip() if heading else "",
    )


def _text_of(lesson: Path, name: str, lang: str) -> str:
    for file in (lesson / f"{name}.{lang}.md", lesson / f"{name}.md"):
        try:
            with file.open(encoding="utf-8") as opened:
                return opened.read(MOST)
        except (OSError, UnicodeDecodeError):
            continue
    return ""


def _of_distro(address: str, distro: str) -> str:
    """Return an address in the documentation of this distro."""
    known = distros()
    for other in known.values():
        if distro in known and address.startswith(f"{other.documentation}/"):
            return address.replace(other.documentation, known[distro].documentation, 1)
    return address
