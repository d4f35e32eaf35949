"""Recognise mistakes in the output of a terminal."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice

from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.kind import Kind

MOST = 200_000  # characters that are searched, at the end of the text: errors come last
MOST_OF_A_KIND = 20  # matches of one kind of mistake that are examined
LONGEST = 2_000  # characters of a line that are searched
# a mistake that is only the consequence of another one, which explains it better
CONSEQUENCES = {"lab.nothing_built": ("lab.unknown_select", "package.duplicate")}


@dataclass(frozen=True)
class Seen:
    """A mistake that a text shows, and the line that shows it."""

    kind: Kind
    params: dict[str, str]
    line: str


def seen_in(text: str) -> list[Seen]:
    """Return the mistakes that a text shows, root causes first.

    If several entries match the same words, the first entry of the catalogue gets them.
    """
    text = "\n".join(line[:LONGEST] for line in text[-MOST:].splitlines())
    taken: list[tuple[int, int]] = []
    found: list[Seen] = []
    for kind in CATALOGUE.values():
        matches = kind.pattern.finditer(text) if kind.pattern is not None else iter(())
        for match in islice(matches, MOST_OF_A_KIND):
            start, end = match.span()
            if any(start < other_end and other_start < end for other_start, other_end in taken):
                continue
            taken.append((start, end))
            known = {name: value for name, value in match.groupdict("").items() if value}
            if all(seen.kind is not kind or seen.params != known for seen in found):
                found.append(Seen(kind, known, _line_around(text, start, end)))
    there = {seen.kind.id for seen in found}
    return [s for s in found if there.isdisjoint(CONSEQUENCES.get(s.kind.id, ()))]


def _line_around(text: str, start: int, end: int) -> str:
    before = text.rfind("\n", 0, start + 1) + 1
    after = text.find("\n", max(end - 1, before))
    return text[before : after if after >= 0 else len(text)].strip()
