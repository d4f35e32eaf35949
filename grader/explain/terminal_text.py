"""The record of what a terminal shows: the message, what it means, what to do, where to look."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property

from grader.base.i18n.message import Message, Value
from grader.explain.machine import Look, Machine
from grader.mistakes.kind import Kind, Stage

PARTS = re.compile(r"\\.|\[\^?\]?(?:\\.|[^\]])*\]|\(\?<[=!][^)]*\)| (?![{*+?])", re.DOTALL)
"""What a pattern is made of, as far as a single space is to be told from one in a class or a look-behind."""
FOLD = r"(?: {1,2}|\n {1,4})"
"""A space between two words, as CMake prints it: it breaks and indents long lines."""


@dataclass(frozen=True)
class Case:
    """What else a text shows (a pattern), and the texts that fit then better."""

    when: str
    why: str = ""
    fix: str = ""


@dataclass(frozen=True, kw_only=True)
class TerminalText(Kind):
    """A kind of message of a terminal.

    `seen` matches the message. All other patterns are searched in the whole output: with a match of
    `unless`, nothing is claimed; the first of `cases` that matches has the better texts; each of
    `shown` that matches adds its sentence on what the output shows. Named groups of all matches are
    the values of the placeholders, `values` are examples of them. The group `told` of `seen`, if there is
    one, is the message; the rest of the match is what has to be before it.

    `facts` read the text, and return a sentence on what they find (`frames.py`).

    `look` are the things of this machine that decide it (`looks.py`); `only_if_found` claims nothing
    unless one of them is found. `in_lab` is what to do in the lab, where it differs.

    The stage is the rank: "environment" is a cause and comes before the mistakes of a source,
    "terminal" is a consequence of theirs, and a "general" one is told only if there is nothing else.

    Example::

        TerminalText(
            id="lab.colcon_not_found", link=links.COLCON,
            title=msg("colcon is not installed, or not in PATH"), why=…, fix=…,
            seen=r"colcon: (?:command )?not found",
        )
    """

    stage: Stage = "environment"
    unless: str = ""
    cases: tuple[Case, ...] = ()
    shown: Mapping[str, str] = field(default_factory=dict)
    facts: tuple[Callable[[str], Message | None], ...] = ()
    values: Mapping[str, Value] = field(default_factory=dict)
    look: tuple[Look, ...] = ()
    only_if_found: bool = False
    in_lab: str = ""

    @cached_property
    def pattern(self) -> re.Pattern[str] | None:
        """The compiled `seen`, which also fits a line that is broken; None if there is none."""
        return re.compile(folding(self.seen), re.MULTILINE) if self.seen else None

    def case_in(self, text: str) -> tuple[str, dict[str, str]]:
        """Return the case that a text shows ("" if none) and the values of its placeholders."""
        for case in self.cases:
            if match := _search(case.when, text):
                return case.when, groups(match)
        return "", {}

    def shown_in(self, text: str) -> list[Message]:
        """Return the sentences on what a text shows."""
        found = ((sentence, _search(pattern, text)) for pattern, sentence in self.shown.items())
        matched = [Message(sentence, groups(match)) for sentence, match in found if match]
        return matched + [sentence for fact in self.facts if (sentence := fact(text))]

    def found_on(self, machine: Machine, values: Mapping[str, Value]) -> list[Message]:
        """Return what this machine shows of it."""
        found = (look(machine, values) for look in self.look)
        return [sentence for sentence in found if sentence]

    def excluded_by(self, text: str) -> bool:
        """Whether a text shows that it is something else."""
        return bool(self.unless) and _search(self.unless, text) is not None

    def rationale(self, values: Mapping[str, Value], variant: str = "") -> Message:
        """Return why it happens in that case. KeyError if a placeholder has no value."""
        why = next((case.why for case in self.cases if case.when == variant and case.why), self.why)
        return Message(why, values)

    def fix_text(self, values: Mapping[str, Value], variant: str = "") -> Message:
        """Return what to do in that case. KeyError if a placeholder has no value."""
        fix = next((case.fix for case in self.cases if case.when == variant and case.fix), self.fix)
        return Message(fix, values)


def groups(match: re.Match[str]) -> dict[str, str]:
    """Return the named groups of a match; `name_2` is another place of `name`."""
    return {re.sub(r"_\d$", "", name): v for name, v in match.groupdict("").items() if v}


def _search(pattern: str, text: str) -> re.Match[str] | None:
    return re.search(folding(pattern), text, re.MULTILINE)


@cache
def folding(pattern: str) -> str:
    """Return a pattern that also fits where a line is broken at one of its spaces."""
    return PARTS.sub(lambda part: FOLD if part[0] == " " else part[0], pattern)
