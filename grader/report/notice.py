"""Prints what a command says beside its result, wrapped at words where a person reads it."""

from __future__ import annotations

import contextlib
from typing import TextIO

from grader.base.plain_text import visible
from grader.base.stream import width_of

INDENTED = "  "
"""What a line begins with that is to be copied: it is never broken."""


def notice(text: str, file: TextIO) -> None:
    """Print a text; on a terminal its lines are broken at words, not in the middle of one.

    Elsewhere, and where it can be copied (code in quotes, indented lines), nothing is broken.
    """
    print(
        for_terminal(visible(text), width_of(file)) if _is_read(file) else text,
        file=file,
        flush=True,
    )


def for_terminal(text: str, width: int) -> str:
    """Return a text whose lines are broken at words, so that they have at most `width` columns."""
    lines = text.split("\n")
    if all(len(line) * 2 <= width for line in lines):  # (a letter has at most two columns)
        return text
    from grader.report.wrap import breaks  # noqa: PLC0415 - rich costs 35 ms

    found: list[str] = []
    for line in lines:
        ends = [] if line.startswith(INDENTED) else breaks(line, width, whole_code=True)
        starts = [0, *ends]
        found += [line[a:b].rstrip() for a, b in zip(starts, [*ends, len(line)])]
    return "\n".join(found)


def _is_read(file: TextIO) -> bool:
    with contextlib.suppress(ValueError):  # it is closed
        return file.isatty()
    return False
