"""`grader explain`: prints an entry of the catalogue, or the mistakes in a terminal's output."""

from __future__ import annotations

import string
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TextIO

from grader.base.errors import UsageError
from grader.base.gate import show
from grader.base.i18n.message import Message, Value, msg, say
from grader.base.i18n.translator import Translator, errors_in
from grader.base.nearest import meant, nearest
from grader.base.shown import shown
from grader.base.stream import takes_styles, width_of
from grader.course.assignment import Assignment
from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.example_values import example_values, lesson_values
from grader.mistakes.from_terminal import seen_in
from grader.mistakes.kind import Kind
from grader.mistakes.links import address
from grader.report.page import Page
from grader.ros.distro import Distro

WITH_ERRORS = msg(
    "Put 2>&1 before the pipe: error messages do not go through it otherwise. For example: ros2 run "
    "my_package my_node 2>&1 | explain -"
)
MOST_ROOTS = 3  # mistakes explained at once; nobody reads more


@dataclass(frozen=True)
class Reader:
    """The reader: their language, the distro whose documentation is linked, and their lesson.

    Without a lesson, the texts have example values where only a lesson has the real ones.
    """

    lang: str
    distro: Distro
    assignment: Assignment | None = None

    def words(self, kind: Kind) -> dict[str, Value]:
        """Return the values that the lesson and the distro give to an entry's placeholders."""
        known = {} if self.assignment is None else lesson_values(kind.id, self.assignment)
        return {**known, "distro": self.distro.name}


def print_entry(mistake: str, *, file: TextIO, reader: Reader) -> None:
    """Print one entry; UsageError, which suggests the nearest id, if it does not exist."""
    kind = CATALOGUE.get(mistake)
    if kind is None:
        slugs = {name.partition(".")[2]: name for name in CATALOGUE}
        close = slugs.get(mistake) or nearest(mistake, CATALOGUE)
        none = say("there is no mistake '{id}' in the catalogue", id=shown(mistake))
        remedy = say("Run grader explain without an id to list them all.")
        with errors_in(reader.lang):
            raise UsageError(none + meant(close), remedy=remedy)
    page = _page(file, reader)
    _entry(page, kind, {}, reader)
    show(str(page), file)


def print_recognised(text: str, *, file: TextIO, reader: Reader) -> bool:
    """Print the entries of the mistakes in a text, root causes first; return whether there are any."""
    page = _page(file, reader)
    found = seen_in(text)
    if not text.strip():
        page.line(say("Nothing came through the pipe."))
        page.field(say("fix"), Message(WITH_ERRORS))
    elif not found:
        page.line(say("This text shows no mistake of the catalogue."))
    for number, seen in enumerate(found[:MOST_ROOTS]):
        if number:
            page.gap()
        page.quote([shown(seen.line)])
        _entry(page, seen.kind, seen.params, reader)
    if len(found) > MOST_ROOTS:
        page.gap()
        names = ", ".join(seen.kind.id for seen in found[MOST_ROOTS:])
        page.field(say("also"), names)
    show(str(page), file)
    return bool(found)


def print_list(*, file: TextIO, reader: Reader) -> None:
    """Print the ids and titles of all entries."""
    page = _page(file, reader)
    for kind in CATALOGUE.values():
        page.line((kind.id, "bold"), ": ", Message(kind.title))
    show(str(page), file)


def _entry(page: Page, kind: Kind, params: Mapping[str, str], reader: Reader) -> None:
    known = {**reader.words(kind), **params}
    if "package" in params:  # the names of Debian's packages have dashes
        known["debian"] = params["package"].replace("_", "-")
    values = {**example_values(kind.id), **known}
    page.line((kind.id, "bold"), ": ", Message(kind.title))
    page.field(say("why"), kind.rationale(values))
    page.field(say("fix"), kind.fix_text(values), "bold")
    if _names(kind) - known.keys():
        page.field(say("note"), say("The names in this text are an example. Yours may differ."))
    if close := _nearest_package(params, reader):
        page.field(say("also"), say("Did you mean the package {package}?", package=close))
    page.code(say("docs"), [address(kind.link, reader.distro)])


def _names(kind: Kind) -> set[str]:
    """Return the placeholders of an entry's texts."""
    parts = [part for text in (kind.why, kind.fix) for part in string.Formatter().parse(text)]
    return {name for _, name, _, _ in parts if name}


def _nearest_package(params: Mapping[str, str], reader: Reader) -> str:
    """Return the lesson's package if a terminal names one that is almost the same; else ""."""
    if reader.assignment is None or "package" not in params:
        return ""
    return nearest(params["package"], [reader.assignment.package])


def _page(file: TextIO, reader: Reader) -> Page:
    return Page(width=width_of(file), styled=takes_styles(file), translate=Translator(reader.lang))
