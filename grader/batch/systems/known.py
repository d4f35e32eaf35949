"""The systems that are known, and which of them a class' folder comes from."""

from __future__ import annotations

import difflib
from typing import Protocol, cast, get_args

from grader.base.errors import UsageError
from grader.base.shown import shown
from grader.batch.model import System
from grader.batch.systems import plain
from grader.batch.systems.canvas import read as canvas
from grader.batch.systems.github_classroom import read as github_classroom
from grader.batch.systems.gradescope import read as gradescope
from grader.batch.systems.layout import Layout, Read, Reading
from grader.batch.systems.moodle import read as moodle


class Reader(Protocol):
    """What each system's module has."""

    def recognise(self, layout: Layout) -> bool:
        """Whether a folder looks like this system's."""

    def read(self, layout: Layout, reading: Reading) -> Read:
        """Return what was handed in, and what does not look like this system's."""


READERS: dict[System, Reader] = {
    "gradescope": gradescope,
    "moodle": moodle,
    "canvas": canvas,
    "github_classroom": github_classroom,
    "folders": plain,
    "archives": plain,
}
WORDS: dict[System, str] = {
    "gradescope": "Gradescope's export",
    "moodle": "Moodle's download of all submissions",
    "canvas": "Canvas' download of all submissions",
    "github_classroom": "clones of GitHub Classroom's repositories",
    "folders": "a folder for each student, called after him or her",
    "archives": "an archive for each student, called after him or her",
}
LAYOUTS = "Known are: " + "; ".join(f"{words} ({name})" for name, words in WORDS.items()) + "."
SYSTEMS: tuple[System, ...] = get_args(System)
NAMED_BY_HAND = ("folders", "archives")


def check_system(name: str) -> None:
    """Raise UsageError (with a "did you mean") if there is no system of that name."""
    if name == "auto" or name in SYSTEMS:
        return
    close = difflib.get_close_matches(name.lower(), SYSTEMS, n=1)
    hint = f"did you mean '{close[0]}'? " if close else ""
    known = ", ".join(("auto", *SYSTEMS))
    raise UsageError(f"no course system '{shown(name)}'", remedy=f"{hint}Known: {known}.")


def is_named_as_in(system: str, layout: Layout) -> bool:
    """Whether a folder's names are those of the system (of any, for "auto") and nobody's own."""
    return any(
        reader.recognise(layout)
        for name, reader in READERS.items()
        if name not in NAMED_BY_HAND and system in ("auto", name)
    )


def recognised(system: str, layout: Layout) -> System | None:
    """Return the system that a layout is of, or the one that was asked for."""
    if system != "auto":
        return cast("System", system)
    for name, reader in READERS.items():
        if reader.recognise(layout):
            if name not in NAMED_BY_HAND:
                return name
            archives = all(item.kind == "archive" for item in layout.submissions())
            return "archives" if archives else "folders"
    return None
