"""F-strings that only Python 3.12 and later can read (PEP 701), as older versions read them."""

from __future__ import annotations

import re

SINCE = (3, 12)
"""The first version in which the values of an f-string may contain the quotes of the f-string."""
STRING = re.compile(r"(?<!\w)(?P<prefix>[A-Za-z]{0,2})(?P<quote>'''|\"\"\"|'|\")")


class _UnknownFormError(Exception):
    """The text has a form that is not changed."""


def with_older_quotes(text: str) -> str | None:
    """Return a text of the same length with other quotes in the values of f-strings.

    None if nothing is to be changed, or if a value has a form that other quotes do not help.
    """
    signs = list(text)
    try:
        _scan(text, signs)
    except (_UnknownFormError, IndexError):
        return None
    changed = "".join(signs)
    return changed if changed != text else None


def first_difference(text: str, other: str) -> int:
    """Return the line, counted from 1, in which two texts of the same length differ first."""
    at = next(n for n, (one, two) in enumerate(zip(text, other)) if one != two)
    return text.count("\n", 0, at) + 1


def _scan(text: str, signs: list[str]) -> None:
    at = 0
    while at < len(text):
        if text[at] == "#":
            at = _end_of_line(text, at)
            continue
        match = STRING.match(text, at)
        if match is None:
            at += 1
        elif "f" in match["prefix"].lower():
            at = _f_string(text, match.end(), match["quote"], signs)
        else:
            at = _string(text, match.end(), match["quote"])


def _end_of_line(text: str, at: int) -> int:
    end = text.find("\n", at)
    return len(text) if end < 0 else end


def _string(text: str, at: int, quote: str) -> int:
    """Return where a plain string ends whose content begins at a place."""
    while not text.startswith(quote, at):
        if len(quote) == 1 and text[at] == "\n":
            raise _UnknownFormError
        at += 2 if text[at] == "\\" else 1
    return at + len(quote)


def _f_string(text: str, at: int, quote: str, signs: list[str]) -> int:
    while not text.startswith(quote, at):
        if len(quote) == 1 and text[at] == "\n":
            raise _UnknownFormError
        if text.startswith("{{", at) or text[at] == "\\":
            at += 2
        elif text[at] == "{":
            at = _value(text, at + 1, quote, signs)
        else:
            at += 1
    return at + len(quote)


def _value(text: str, at: int, quote: str, signs: list[str]) -> int:
    """Change the quotes in a value of an f-string, and return where the value ends."""
    depth = 0
    while text[at] != "}" or depth:
        if text[at] in "\\\n#":
            raise _UnknownFormError
        depth += (text[at] in "([{") - (text[at] in ")]}")
        match = STRING.match(text, at)
        if match is None:
            at += 1
            continue
        end = _string(text, match.end(), match["quote"])
        if match["quote"] == quote:
            inside, other = text[match.end() : end - 1], '"' if quote == "'" else "'"
            if len(quote) > 1 or other in inside or "\\" in inside or match["prefix"]:
                raise _UnknownFormError
            signs[match.end() - 1] = signs[end - 1] = other
        at = end
    return at + 1
