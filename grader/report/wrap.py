"""Where a line is broken: at spaces, and a word that is too long after a slash or an opening bracket.

A name that fits on a line is never cut, nor is quoted code.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

from rich.cells import cell_len, chop_cells

WORD = re.compile(r"\s*(?:(?<!\S)'[^'\n]+'(?!\w)\S*|\S+)")  # with the spaces of what is in quotes
BARE_WORD = re.compile(r"\s*\S+")
PART = re.compile(r"[^/(,=\[{]*[/(,=\[{]+|[^/(,=\[{]+")  # of a path, or of code without spaces


def breaks(text: str, width: int, *, whole_code: bool = False) -> list[int]:
    """Return the offsets in a line at which to break it, so that each part has at most `width`
    columns. (Spaces at the end of a part do not count.)

    With `whole_code`, code in quotes is never broken, even if it is longer: it is to be copied.
    """
    found: list[int] = []
    used = 0  # columns of the current part
    for start, word in _units(text, width, whole_code=whole_code):
        if used + cell_len(word) <= width:
            used += cell_len(word)
        else:
            bare = word.lstrip()
            found.append(start + len(word) - len(bare))
            used = cell_len(bare)
    return found


def rows(text: str, width: int) -> int:
    """Return how many lines a text without styles takes on a terminal, which breaks long ones."""
    return sum(max(1, math.ceil(cell_len(line) / width)) for line in text.splitlines())


def _units(text: str, width: int, *, whole_code: bool) -> Iterator[tuple[int, str]]:
    """Yield what is not broken, with its offset: words, parts of a long path, pieces of a long name."""
    for match in WORD.finditer(text):
        start, word = match.start(), match.group()
        has_spaces = " " in word.strip()  # quoted code
        if cell_len(word.lstrip()) <= width or (whole_code and has_spaces):
            yield start, word
            continue
        if has_spaces:
            for inner in BARE_WORD.finditer(word):
                for offset, piece in _units(inner.group(), width, whole_code=False):
                    yield start + inner.start() + offset, piece
            continue
        for part in _parts(word):
            for piece in chop_cells(part, width) if cell_len(part) > width else [part]:
                yield start, piece
                start += len(piece)


def _parts(word: str) -> list[str]:
    """Return a word's parts; the spaces before it belong to the first one."""
    bare = word.lstrip()
    first, *others = PART.findall(bare)
    return [word[: len(word) - len(bare)] + first, *others]


def longest_word(text: str) -> int:
    """Return the columns of the longest word of a text; 0 if it has none."""
    return max((cell_len(word) for word in text.split()), default=0)
