r"""Text of unknown origin made safe to show: no control characters, a bounded length.

A submission controls its log lines, file names and error messages. Shown raw, they could move the
cursor, change the clipboard, reverse the reading direction or fake lines of a report. Invisible
characters are escaped as in a Python string: `\x1b`, `\u202e`, `\xa0`.
"""

from __future__ import annotations

from collections.abc import Callable

from grader.base.i18n.message import say

TAB = 4  # columns
MOST_LINES, LONGEST_LINE = 5_000, 5_000  # of a text, and characters: nobody reads more
Translate = Callable[[str], str]
SIMPLER = {
    **{"\u2026": "...", "\u2022": "*", "\u00b7": "*", "\u2192": "->", "\u00d7": "x"},
    **{"\u2018": "'", "\u2019": "'", "\u201c": '"', "\u201d": '"'},
    **dict.fromkeys("\u2010\u2011\u2012\u2013\u2014\u2212\u2500\u2501\u2550", "-"),
    **dict.fromkeys("\u2502\u2503\u2551\u258c", "|"),
}
"""ASCII for punctuation and lines of other character sets."""
TO_SIMPLER = str.maketrans(SIMPLER)


def visible(text: str, *, tabs: bool = False) -> str:
    """Return `text` with everything but printable characters, newlines and spaces escaped.

    Printable is as in `str.isprintable`: no control (C0, C1), format (bidi overrides, zero
    width), surrogate or unassigned character, no separator but the space. Tabs become spaces,
    unless `tabs` keeps them: in a diff they are what is changed.
    """
    text = text.replace("\r\n", "\n")
    if "\t" in text and not tabs:
        text = text.expandtabs(TAB)
    if text.isprintable():
        return text
    kept = "\n\t" if tabs else "\n"
    return "".join(c if c.isprintable() or c in kept else _escaped(c) for c in text)


def _escaped(character: str) -> str:
    return character.encode("unicode_escape").decode("ascii")


def one_line(text: str, *, most: int = 300, translate: Translate = str) -> str:
    """Return `text` on one line (newlines escaped), cut in the middle to `most` characters.

    `translate` translates it, and the words that take the place of what is left out.
    """
    short = shorten(translate(text), most=most, translate=translate)
    return visible(short).replace("\n", "\\n")


def first_lines(
    text: str, *, lines: int, most: int = 500, translate: Translate = str, tabs: bool = False
) -> list[str]:
    """Return at most `lines` lines of at most `most` characters; the middle is left out.

    `translate` translates the words that take the place of what is left out. `tabs` keeps tabs.
    """
    found = _split(text)
    if len(found) > lines:
        head = (lines + 1) // 2
        tail = lines - head
        left_out = translate(_lines_left_out(len(found) - lines))
        found = [*found[:head], left_out, *(found[-tail:] if tail else [])]
    return [visible(shorten(line, most=most, translate=translate), tabs=tabs) for line in found]


def last_lines(
    text: str, *, lines: int, most: int = 500, translate: Translate = str
) -> tuple[list[str], int]:
    """Return the last `lines` lines of at most `most` characters, and how many there are in all.

    If Python's last traceback begins shortly before them, all of it is kept. `translate` as for
    `first_lines`.
    """
    found = _split(text)
    start = max(len(found) - lines, 0)
    for number in range(len(found) - 1, max(len(found) - 3 * lines, 0) - 1, -1):
        if found[number].lstrip().startswith("Traceback (most recent call last)"):
            start = min(start, number)
            break
    shown = [visible(shorten(line, most=most, translate=translate)) for line in found[start:]]
    return shown, len(found)


def bounded(text: str) -> str:
    """Return a text of any origin as it may be shown: visible, with a bounded length.

    Newlines at its ends stay: it may be a piece of what is written.
    """
    if len(text) <= LONGEST_LINE and text.isprintable():
        return text
    lines = text.replace("\r\n", "\n").split("\n")
    if len(lines) > MOST_LINES:
        half = MOST_LINES // 2
        left_out = _lines_left_out(len(lines) - 2 * half)
        lines = [*lines[:half], left_out, *lines[-half:]]
    return "\n".join(visible(shorten(line, most=LONGEST_LINE)) for line in lines)


def points(value: float) -> str:
    """Return points as people write them: 5, 2.5, 33.33."""
    return f"{value:.2f}".rstrip("0").rstrip(".")


def encodable(text: str, encoding: str | None) -> str:
    """Return `text` without characters that the encoding lacks.

    Punctuation and lines become ASCII, other characters are escaped.
    """
    name = encoding or "utf-8"
    try:
        text.encode(name)
    except UnicodeEncodeError:
        return "".join(_encodable(character, name) for character in text)
    return text


def _encodable(character: str, encoding: str) -> str:
    try:
        character.encode(encoding)
    except UnicodeEncodeError:
        return SIMPLER.get(character) or _escaped(character)
    return character


def simpler(text: str) -> str:
    """Return `text` with punctuation and lines in ASCII."""
    return text if text.isascii() else text.translate(TO_SIMPLER)


def _split(text: str) -> list[str]:
    return text.replace("\r\n", "\n").strip("\n").rstrip().split("\n")


def shorten(text: str, *, most: int, translate: Translate = str) -> str:
    """Return `text`, cut in the middle to about `most` characters."""
    if len(text) <= most:
        return text
    half = most // 2
    count = f"{len(text) - 2 * half:,}"
    left_out = translate(say("[... {count} characters left out ...]", count=count))
    if len(text) <= most + len(left_out):  # (the note would take more room than what it replaces)
        return text
    return f"{text[:half]}{left_out}{text[-half:]}"


def _lines_left_out(count: int) -> str:
    return say("[... {count} lines left out ...]", count=f"{count:,}")
