"""A Python text without the content of its strings and comments, to search its code."""

from __future__ import annotations

import re

OPEN = re.compile(r"#[^\r\n]*|\"\"\"|'''|[\"']")
END = {
    '"': re.compile(r'(?:[^\\\r\n"]|\\(?:\r\n|.))*', re.DOTALL),
    "'": re.compile(r"(?:[^\\\r\n']|\\(?:\r\n|.))*", re.DOTALL),
}
INSIDE = re.compile(r"[^\r\n]")


def code_only(text: str) -> str:
    """Return a text of the same length: strings keep their quotes and line ends, `_` is the rest.

    Comments become blanks. A string without an end reaches to the end of its line.
    """
    kept: list[str] = []
    at = 0
    while (match := OPEN.search(text, at)) is not None:
        opened, start = match[0], match.end()
        kept.append(text[at : match.start()])
        if opened[0] == "#":
            kept.append(" " * len(opened))
            at = start
            continue
        if len(opened) == 3:
            end = text.find(opened, start)
        else:
            inside = END[opened].match(text, start)
            end = inside.end() if inside else start
        end = len(text) if end < 0 else end
        at = end + len(opened) if text.startswith(opened, end) else end
        kept += (opened, INSIDE.sub("_", text[start:end]), text[end:at])
    kept.append(text[at:])
    return "".join(kept)
