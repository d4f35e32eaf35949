"""Rows of marks (^) below a text: they are read only if they stay below what they mark.

So the lines of such a group are never wrapped: they are cut to the width around the mark.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from grader.base.nearest import marks

CUT = "..."
BEFORE = 3  # a cut line shows one third of the free columns before the mark


@dataclass(frozen=True)
class Piece:
    """Lines of a text: one line of prose or code, or a line with the marks below it."""

    lines: tuple[str, ...]
    marked: bool = False


def is_marks(line: str) -> bool:
    """Whether a line has only marks: ^ as in a comparison, or ~ and ^ as in a traceback."""
    return "^" in line and not line.strip(" ^~")


def pieces(lines: Sequence[str]) -> list[Piece]:
    """Divide lines into pieces: a row of marks stays with the line above it.

    In a comparison of two names (`grader.base.nearest`), the second name belongs to it too.
    """
    found: list[Piece] = []
    number = 0
    while number < len(lines):
        if number + 1 == len(lines) or is_marks(lines[number]) or not is_marks(lines[number + 1]):
            found.append(Piece((lines[number],)))
            number += 1
            continue
        end = number + 2
        if end < len(lines) and marks(lines[number], lines[end]) == lines[number + 1].rstrip():
            end += 1
        found.append(Piece(tuple(lines[number:end]), marked=True))
        number = end
    return found


def shortened(lines: Sequence[str], width: int) -> list[str]:
    """Return the lines of a marked piece, at most `width` columns wide, cut around the first mark."""
    if max(map(len, lines)) <= width:
        return list(lines)
    row = lines[1]
    first, last = len(row) - len(row.lstrip()), len(row.rstrip())
    free = max(width - 2 * len(CUT), 1)
    start = max(first - max((free - (last - first)) // BEFORE, 0), 0)
    start = min(start, max(map(len, lines)) - (width - len(CUT)))  # no room is left unused
    if start <= len(CUT):  # what would be cut is as short as the sign for it
        start = 0
    return [
        _window(line, start, width, " " * len(CUT) if number == 1 else CUT)
        for number, line in enumerate(lines)
    ]


def _window(line: str, start: int, width: int, cut: str) -> str:
    """Return `width` columns of a line from `start` on, with `cut` where something is left out."""
    head = cut if start else ""
    rest, room = line[start:], width - len(head)
    if len(rest) > room:
        rest = rest[: max(room - len(cut), 0)] + cut
    return (head + rest).rstrip() if line[start:] else ""
