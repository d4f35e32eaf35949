"""Statements of Python that stand in comments."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass

from grader.package.edit.text import SourceText, Splice, indent_of
from grader.package.source.code_only import code_only
from grader.package.source.python import can_parse

MOST_COMMENTS = 500
LONGEST = 300


@dataclass(frozen=True)
class Commented:
    """A statement in a comment: its line, where its comment begins, and its code."""

    line: int
    start: int
    code: str


def commented(text: SourceText, pattern: str) -> Iterator[Commented]:
    """Yield the statements in comments that begin with a pattern.

    The rest of the comment, up to another #, must be the rest of the statement.
    """
    code = code_only(text.text)
    for number in range(1, min(len(text.lines), MOST_COMMENTS) + 1):
        start, row = text.start_of(number), text.line(number)
        signs = (at for at, sign in enumerate(row) if sign == "#" and code[start + at] == " ")
        at = next(signs, None)
        if at is None or len(row) > LONGEST:
            continue
        match = re.search(rf"(?<![\w.])(?:{pattern})[^#]*", row[at + 1 :])
        if match is not None and _is_statement(match[0].strip()):
            yield Commented(number, start + at, match[0].strip())


def _is_statement(code: str) -> bool:
    try:
        return len(ast.parse(code).body) == 1
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return False


def uncommented(text: SourceText, found: Commented) -> bytes | None:
    """Return the file with the statement as a line of its own; None if it does not fit there."""
    row = text.line(found.line)
    before = row[: found.start - text.start_of(found.line)]
    if before.strip():
        indent, new = indent_of(row), before.rstrip() + text.newline
    else:
        indent, new = _indent_above(text, found.line), ""
    whole = Splice(text.start_of(found.line), text.end_of(found.line), f"{new}{indent}{found.code}")
    changed = text.spliced([whole])
    return changed if changed is not None and can_parse(changed) else None


def _indent_above(text: SourceText, line: int) -> str:
    code = SourceText(code_only(text.text), text.encoding)
    for number in range(line - 1, 0, -1):
        row = code.line(number)
        if row.strip():
            more = " " * 4 if row.rstrip().endswith(":") else ""
            return indent_of(row) + more
    return ""
