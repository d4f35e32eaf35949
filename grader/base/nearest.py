"""The nearest name ("did you mean"), and where two texts differ."""

from __future__ import annotations

import difflib
import os
import re
import unicodedata
from collections.abc import Collection, Iterable
from itertools import islice
from pathlib import Path

from grader.base.i18n.message import Message, joined, say
from grader.base.shown import shown

LONGEST = 100  # characters of a marked text; a terminal line has as many
LONGEST_RUN = 12  # characters; a longer difference is another word, not a typo
ALIKE = 0.6  # of 1; below this ratio, marks are of no use
OTHER_WORD = 3  # characters; a word with as many wrong ones, a third of it, is marked as a whole
WORD = re.compile(r"\w+")
MOST_NAMES = 2_000  # of a folder, that are compared


def nearest(word: str, words: Iterable[str], cutoff: float = ALIKE) -> str:
    """Return the nearest word, ignoring case; empty if none is near."""
    folded: dict[str, list[str]] = {}
    for other in words:
        if other != word:
            folded.setdefault(other.lower(), []).append(other)
    close = difflib.get_close_matches(word.lower(), folded, n=1, cutoff=cutoff)
    alike = folded[close[0]] if close else [""]
    return max(alike, key=lambda other: difflib.SequenceMatcher(None, word, other).ratio())


def without_accents(text: str) -> str:
    """Return a text in lower case without accents."""
    parts = unicodedata.normalize("NFKD", text.casefold())
    return "".join(c for c in parts if not unicodedata.category(c).startswith("M"))


def nearest_path(path: Path) -> str:
    """Return the path with its first wrong name corrected; "" if no name beside it is near.

    Whatever follows that name is kept if it exists there.
    """
    wrong = Path(os.path.abspath(path))  # noqa: PTH100 - resolve() would follow links
    rest: list[str] = []
    while not os.path.isdir(wrong.parent):  # noqa: PTH112 - Path.is_dir raises PermissionError
        rest.insert(0, wrong.name)
        wrong = wrong.parent
    try:
        with os.scandir(wrong.parent) as entries:
            names = [entry.name for entry in islice(entries, MOST_NAMES)]
    except OSError:
        return ""
    close = nearest(wrong.name, names, cutoff=ALIKE)
    if not close:
        return ""
    found = wrong.with_name(close).joinpath(*rest)
    if not os.path.lexists(found):
        found = wrong.with_name(close)
    shorter = os.path.relpath(found) if not path.is_absolute() else str(found)
    return str(shorter)


def meant(word: str) -> str:
    """Return ` (did you mean 'word'?)`, or an empty text for an empty word."""
    return joined(" ", say("(did you mean '{word}'?)", word=shown(word)), by="") if word else ""


def there_is(word: str) -> str:
    """Return ` (there is 'word')`, for what is missing under its right name; empty if no word."""
    return joined(" ", say("(there is '{word}')", word=shown(word)), by="") if word else ""


def did_you_mean(word: str, words: Iterable[str]) -> str:
    """Return `did you mean 'other'?` with the nearest word; empty if none is near."""
    close = nearest(word, words)
    return say("did you mean '{word}'?", word=close) if close else ""


def meant_or_known(word: str, known: Collection[str]) -> str:
    """Return the end of a message about an unknown word: the nearest known one, else all of them."""
    close = nearest(word, known)
    return f" (did you mean '{close}'?)" if close else f"; known: {', '.join(known)}"


def marks(found: str, wanted: str) -> str:
    """Return a line of ^ below what is wrong in `found`; empty if the two are not alike.

    If something is missing, the mark is below the character before which it belongs.
    """
    if found == wanted or max(len(found), len(wanted)) > LONGEST or not found.isprintable():
        return ""
    if any(unicodedata.east_asian_width(c) in "WF" for c in found):
        return ""  # one character of these is two columns wide
    matcher = difflib.SequenceMatcher(None, found, wanted, autojunk=False)
    folded = difflib.SequenceMatcher(None, found.lower(), wanted.lower(), autojunk=False)
    if max(matcher.ratio(), folded.ratio()) < ALIKE:
        return ""
    codes = matcher.get_opcodes()
    if any(
        tag != "equal" and end - start > max(LONGEST_RUN, len(found) // 3)
        for tag, start, end, *_ in codes
    ):
        return ""
    line = [" "] * (len(found) + 1)
    for tag, start, end, *_ in codes:
        if tag != "equal":
            line[start : max(end, start + 1)] = "^" * max(end - start, 1)
    for word in WORD.finditer(found):
        start, end = word.span()
        if line[start:end].count("^") >= max(OTHER_WORD, (end - start) / 3):
            line[start:end] = "^" * (end - start)
    return "".join(line).rstrip()


def compared(found: str, wanted: str) -> str:
    """Return three lines: what was found, the marks below it, what is expected; or nothing."""
    found, wanted = shown(found), shown(wanted)
    line = marks(found, wanted)
    return f"{found}\n{line}\n{wanted}" if line else ""


def with_difference(text: str, found: str, wanted: str) -> Message:
    """Return a text with the difference of two names below it, if they are alike."""
    lines = compared(found, wanted) if wanted else ""
    return joined("" if lines and text == shown(found) else text, lines, by="\n")
