"""The record of an error message of the terminal or the environment."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from grader.base.i18n.message import Message, Value
from grader.mistakes.kind import Kind


@dataclass(frozen=True, kw_only=True)
class TerminalText(Kind):
    """A kind of mistake that only the output of a terminal shows.

    `seen` matches the message. All other patterns are searched in the whole output: with a match of
    `unless`, nothing is claimed; the first of `chosen` that matches names the variant of the texts;
    each of `shown` that matches adds its sentence on what the output shows. Named groups of all
    matches are the values of the placeholders, `values` are examples of them.

    Example::

        TerminalText(
            id="lab.colcon_not_found", stage="environment", link=links.COLCON,
            title=msg("colcon is not installed, or not in PATH"), why=…, fix=…,
            seen=r"colcon: (?:command )?not found",
        )
    """

    unless: str = ""
    chosen: Mapping[str, str] = field(default_factory=dict)
    shown: Mapping[str, str] = field(default_factory=dict)
    values: Mapping[str, Value] = field(default_factory=dict)

    def variant_in(self, text: str) -> tuple[str, dict[str, str]]:
        """Return the variant that a text shows ("" if none) and the values of its placeholders."""
        for variant, pattern in self.chosen.items():
            if match := _search(pattern, text):
                return variant, _groups(match)
        return "", {}

    def shown_in(self, text: str) -> list[Message]:
        """Return the sentences on what a text shows."""
        found = ((sentence, _search(pattern, text)) for pattern, sentence in self.shown.items())
        return [Message(sentence, _groups(match)) for sentence, match in found if match]

    def excluded_by(self, text: str) -> bool:
        """Whether a text shows that another mistake was made."""
        return bool(self.unless) and _search(self.unless, text) is not None


def _search(pattern: str, text: str) -> re.Match[str] | None:
    return re.search(pattern, text, re.MULTILINE)


def _groups(match: re.Match[str]) -> dict[str, str]:
    return {name: value for name, value in match.groupdict("").items() if value}
