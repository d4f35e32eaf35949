"""`grader explain`: prints an entry of the catalogue, or the mistakes in a terminal's output."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TextIO

from grader.base.errors import UsageError
from grader.base.gate import show
from grader.base.i18n.message import Message, Value, joined, msg, reworded, say
from grader.base.i18n.translator import Translator, errors_in
from grader.base.nearest import meant, nearest
from grader.base.shown import shown
from grader.base.stream import takes_styles, width_of
from grader.course.assignment import Assignment
from grader.explain.from_terminal import ENTRIES, WORKSPACE, Seen, seen_in, workspace_in
from grader.explain.machine import Machine
from grader.explain.rules import BY_MISTAKE, RULES, Rule
from grader.explain.terminal_text import TerminalText
from grader.mistakes.example_values import example_values, lesson_values, names_in
from grader.mistakes.kind import Kind
from grader.mistakes.links import address
from grader.mistakes.retired import RETIRED
from grader.report.page import Page
from grader.ros.distro import Distro

WITH_ERRORS = msg(
    "Put 2>&1 before the pipe: error messages do not go through it otherwise. For example: ros2 run "
    "my_package my_node 2>&1 | explain -"
)
NO_LONGER = say(
    "The catalogue no longer has this mistake. A report tells what the run showed, and a change that "
    "helps."
)
MOST_ROOTS = 3  # mistakes explained at once; nobody reads more
NOT_IN_LAB = re.compile(
    r"\b(sudo|apt-get|apt-cache|apt|conda|docker|rosdep|xhost|wsl|usbipd|ip link|ssh)\b(?= |$|:)"
)
"""Commands of an own machine that the lab does not have."""


@dataclass(frozen=True)
class Reader:
    """The reader: their language, the distro whose documentation is linked, their lesson and machine.

    Without a lesson, the texts have example values where only a lesson has the real ones. Without a
    machine, nothing is looked at.
    """

    lang: str
    distro: Distro
    assignment: Assignment | None = None
    machine: Machine | None = None

    @property
    def in_lab(self) -> bool:
        """Whether the reader is in the lab, which has other commands."""
        return self.machine is not None and self.machine.in_lab

    def words(self, kind: Kind) -> dict[str, Value]:
        """Return the values that the lesson and the distro give to an entry's placeholders."""
        known = {} if self.assignment is None else lesson_values(kind.id, self.assignment)
        return {**known, "distro": self.distro.name}


def print_entry(mistake: str, *, file: TextIO, reader: Reader) -> None:
    """Print one entry; UsageError, which suggests the nearest id, if it does not exist."""
    kind, page = ENTRIES.get(mistake), _page(file, reader)
    if kind is not None:
        _entry(page, Seen(kind, {}, ""), reader)
    elif mistake in BY_MISTAKE:
        _rule(page, BY_MISTAKE[mistake])
    elif mistake in RETIRED:
        page.line((mistake, "bold"), ": ", NO_LONGER)
    else:
        slugs = {name.partition(".")[2]: name for name in ENTRIES}
        close = slugs.get(mistake) or nearest(mistake, ENTRIES)
        none = say("there is no mistake '{id}' in the catalogue", id=shown(mistake))
        remedy = say("Run grader explain without an id to list them all.")
        with errors_in(reader.lang):
            raise UsageError(none + meant(close), remedy=remedy)
    show(str(page), file)


def print_recognised(text: str, *, file: TextIO, reader: Reader) -> bool:
    """Print the entries of the mistakes in a text, root causes first; return whether there are any."""
    page = _page(file, reader)
    found = seen_in(text, reader.machine)
    place = workspace_in(text)
    words = ((WORKSPACE, place),) if place and not reader.in_lab else ()
    if not text.strip():
        page.line(say("Nothing came through the pipe."))
        page.field(say("fix"), Message(WITH_ERRORS))
    elif not found:
        page.line(say("This text shows no mistake of the catalogue."))
    for number, seen in enumerate(found[:MOST_ROOTS]):
        if number:
            page.gap()
        page.quote([shown(line) for line in seen.line.splitlines()])
        _entry(page, seen, reader, words)
    if len(found) > MOST_ROOTS:
        page.gap()
        names = ", ".join(seen.kind.id for seen in found[MOST_ROOTS:])
        page.field(say("also"), names)
    show(str(page), file)
    return bool(found)


def print_list(*, file: TextIO, reader: Reader) -> None:
    """Print the ids and titles of all entries."""
    page = _page(file, reader)
    for kind in ENTRIES.values():
        page.line((kind.id, "bold"), ": ", Message(kind.title))
    for rule in RULES:
        page.line((rule.mistake, "bold"), ": ", Message(rule.title))
    show(str(page), file)


def _entry(page: Page, seen: Seen, reader: Reader, words: tuple[tuple[str, str], ...] = ()) -> None:
    """Add an entry to the page; `words` are the text's own names for what the entry calls otherwise."""
    kind, params = seen.kind, seen.params
    own = kind.values if isinstance(kind, TerminalText) else {}
    known = {**{n: v for n, v in reader.words(kind).items() if n not in own}, **params}
    if name := params.get("package") or params.get("rmw"):  # Debian's names have dashes
        known["debian"] = name.replace("_", "-")
    values = {**example_values(kind.id, _texts(kind)), **own, **known}
    why, fix = kind.rationale(values, seen.variant), kind.fix_text(values, seen.variant)
    if reader.in_lab and isinstance(kind, TerminalText) and kind.in_lab:
        fix = Message(kind.in_lab, values)
    page.line((kind.id, "bold"), ": ", Message(kind.title))
    if seen.shown:
        page.field(say("shown"), joined(*seen.shown))
    page.field(say("why"), reworded(why, words))
    absent = _absent(fix) if reader.in_lab else ""
    if seen.here and not absent:
        page.field(say("here"), joined(*seen.here))
    page.field(say("fix"), reworded(fix, words), "bold")
    if absent:
        note = say(
            "This is for the computer that printed the text. The lab has no {names}.", names=absent
        )
        page.field(say("note"), note)
    if _names(why, fix) - known.keys():
        page.field(say("note"), say("The names in this text are an example. Yours may differ."))
    if kind.stage == "terminal" and (close := _nearest_package(params, reader)):
        page.field(say("also"), say("Did you mean the package {package}?", package=close))
    page.code(say("docs"), [address(kind.link, reader.distro)])


def _rule(page: Page, rule: Rule) -> None:
    """Add what a fact of a run says; its places have no values without a program."""
    values = example_values("", [rule.title, rule.why, rule.fix])
    page.line((rule.mistake, "bold"), ": ", Message(rule.title, values))
    page.field(say("why"), Message(rule.why, values))
    page.field(say("fix"), Message(rule.fix, values), "bold")
    page.field(say("note"), say("A report has the values of your program in the place of …."))


def _texts(kind: Kind) -> list[str]:
    """Return the templates of an entry."""
    texts = [kind.why, kind.fix, *kind.whys.values(), *kind.fixes.values()]
    if isinstance(kind, TerminalText):
        texts += [kind.in_lab, *(text for case in kind.cases for text in (case.why, case.fix))]
    return texts


def _absent(fix: str) -> str:
    """Return the commands of a fix that the lab does not have."""
    return ", ".join(dict.fromkeys(NOT_IN_LAB.findall(fix)))


def _names(*texts: Message) -> set[str]:
    """Return the placeholders of an entry's texts."""
    return set(names_in([text.template for text in texts]))


def _nearest_package(params: Mapping[str, str], reader: Reader) -> str:
    """Return the lesson's package if a terminal names one that is almost the same; else ""."""
    if reader.assignment is None or "package" not in params:
        return ""
    return nearest(params["package"], [reader.assignment.package])


def _page(file: TextIO, reader: Reader) -> Page:
    return Page(width=width_of(file), styled=takes_styles(file), translate=Translator(reader.lang))
