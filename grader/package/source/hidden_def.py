"""A def that is no code: it stands in a comment, or in a text in three quotes."""

from __future__ import annotations

import ast
import re
from collections.abc import Sequence
from dataclasses import dataclass

from grader.package.edit.text import SourceText, Splice, indent_of
from grader.package.source.code_only import code_only
from grader.package.source.python import can_parse

TRIPLE = re.compile(r"\"\"\"|'''")
LONGEST = 300


@dataclass(frozen=True)
class HiddenDef:
    """A def: its line, its text, and, if it is in a text, the first and the last line of that."""

    line: int
    code: str
    first: int = 0
    last: int = 0
    fixed: bytes | None = None

    @property
    def is_text(self) -> bool:
        """Whether it is in a text in three quotes, not in a comment."""
        return self.first > 0


def hidden_def(text: SourceText, name: str, body: Sequence[ast.stmt]) -> HiddenDef | None:
    """Return the only hidden def of a method; `body` are the statements of its class."""
    code = code_only(text.text)
    pattern = rf"\bdef[ \t]+{re.escape(name)}[ \t]*\([^()\r\n]*\)[^:\r\n#]*:"
    found = list(re.finditer(pattern, text.text))
    if len(found) != 1 or code.startswith("def", found[0].start()):
        return None
    at, written = found[0].start(), found[0][0]
    line = text.text.count("\n", 0, at) + 1
    if len(text.line(line)) > LONGEST:
        return None
    if code[at] == " ":
        return HiddenDef(line, written, fixed=_from_comment(text, line, at, body))
    places = [match.start() for match in TRIPLE.finditer(code)]
    before = [place for place in places if place < at]
    after = [place for place in places if place > at]
    if len(before) % 2 == 0 or not after:
        return None
    ends = (before[-1], after[0])
    first, last = (text.text.count("\n", 0, place) + 1 for place in ends)
    new = text.spliced([_quotes(text, place) for place in ends])
    return HiddenDef(line, written, first, last, new if new and can_parse(new) else None)


def _from_comment(text: SourceText, line: int, at: int, body: Sequence[ast.stmt]) -> bytes | None:
    """Return the file with the def on a line of its own, in the column of the other methods."""
    columns = {statement.col_offset for statement in body}
    below = next((n for n in range(line + 1, len(text.lines) + 1) if text.line(n).strip()), 0)
    if len(columns) != 1 or text.line(below).lstrip().startswith("#"):
        return None
    indent = " " * columns.pop()
    row = text.line(line)
    column = at - text.start_of(line)
    before = row[:column].rstrip(" \t")
    kept = before + text.newline if before.strip(" \t#-=*") else ""
    splice = Splice(text.start_of(line), text.end_of(line), f"{kept}{indent}{row[column:]}")
    new = text.spliced([splice]) if len(indent_of(text.line(below))) > len(indent) else None
    return new if new is not None and can_parse(new) else None


def _quotes(text: SourceText, place: int) -> Splice:
    """Return the change that deletes three quotes, and their line if nothing else is on it."""
    line = text.text.count("\n", 0, place) + 1
    if text.line(line).strip() in ('"""', "'''"):
        return text.without(line)
    return Splice(place, place + 3, "")
