"""The text of an interface with the fields of nested messages below each field, indented."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from .interfaces import definition

if TYPE_CHECKING:
    from collections.abc import Iterator

SEPARATOR = "---"
# the builtin types of interfaces: https://docs.ros.org/en/jazzy/Concepts/Basic/About-Interfaces.html
BUILTIN = re.compile(r"bool|byte|char|float(32|64)|u?int(8|16|32|64)|w?string(<=\d+)?")
FIELD = re.compile(r"(?P<type>[A-Za-z][\w/]*)(?:<=\d+)?(?:\[[^\]]*\])?\s+\w+")


def lines(
    identifier: str, *, comments: bool, nested_comments: bool, depth: int = 0
) -> Iterator[str]:
    """Yield the lines to print, `depth` tabs deep; raises CommandError for unknown interfaces.

    Without comments, empty lines and lines of comment are left out and a comment after a field is
    reduced to its `#`. Lines of comment that are indented, and those without text, stay, as in the
    real command.
    """
    package = identifier.partition("/")[0]
    for line in definition(identifier).rstrip("\n").split("\n"):
        shown = line if comments else _without_comment(line)
        if shown is not None:
            yield "\t" * depth + shown
        nested = _nested_type(line, package)
        if nested:
            yield from lines(
                nested, comments=nested_comments, nested_comments=nested_comments, depth=depth + 1
            )


def _without_comment(line: str) -> str | None:
    before, mark, comment = line.partition("#")
    text = comment.lstrip("#").strip()
    if not line.strip() or (not before and text):
        return None
    if not before.strip() or not text:
        return line
    return before + mark


def _nested_type(line: str, package: str) -> str | None:
    """Return the message type of a field, None for builtin types, constants and other lines."""
    field = FIELD.match(line.partition("#")[0].strip())
    if field is None or BUILTIN.fullmatch(field["type"]):
        return None
    parts = field["type"].split("/")
    return f"{parts[0] if len(parts) > 1 else package}/msg/{parts[-1]}"
