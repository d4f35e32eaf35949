"""Other indentations of a line at which Python stops, and of the lines of its block."""

from __future__ import annotations

import re
from collections.abc import Iterator

from grader.package.edit.text import Splice, indent_of
from grader.package.source.broken_python import BLOCK, Broken

Indent = tuple[str, float, int, tuple[Splice, ...], int]
"""The variant, the cost, the line, the change, and a line that explains it."""
HEAD = re.compile(rf"[ \t]*(?:{BLOCK})\b.*:")
MARGIN = ("def ", "class ", "if __name__", "@")
CLAUSES = ("except", "finally", "else", "elif")


def indents(text: Broken) -> Iterator[Indent]:
    """Yield the indentations that the lines around a line suggest."""
    if text.fault.kind not in ("indentation", "tabs") and not text.line.lstrip().startswith(
        CLAUSES
    ):
        return
    above, below = _beside(text, -1), _beside(text, 1)
    if _continues(text, above):
        return
    column = indent_of(text.source.line(text.number))
    if "\t" in column:
        beside = [indent_of(text.source.line(n)) for n in (above, below) if n]
        for width in (8, 4):
            new = column.expandtabs(width)
            cost = 1 - 0.1 * beside.count(new)
            yield from _moved(text, "tab", cost, column, new, above)
    for far, (outer, number) in enumerate(_heads(text).items()):
        yield from _moved(text, "line_above", 0.8 + 0.01 * far, column, outer, number)
    if above and text.code.line(above).rstrip().endswith(":"):
        old = indent_of(text.source.line(above))
        inner = old + " " * 4
        for outer in (
            _columns(text, above) if text.code.line(above).lstrip().startswith("def ") else ()
        ):
            yield ("head_deeper", 0.9, above, (_splice(text, above, old, outer),), text.number)
        head = (
            text.code.line(text.number)
            .lstrip()
            .startswith(("def ", "class ", "if __name__", *CLAUSES))
        )
        yield from _moved(text, "not_indented", 2 if head else 1, column, inner, above)
        at = text.source.end_of(above)
        clause = text.code.line(above).lstrip().startswith(CLAUSES)
        yield (
            "block_empty",
            1.0 if clause else 1.2,
            above,
            (Splice(at, at, f"\n{inner}pass"),),
            text.number,
        )
    elif above:
        yield from _moved(text, "line_above", 1, column, indent_of(text.source.line(above)), above)
    yield from _above(text, above, column)
    if below:
        yield from _moved(
            text, "line_above", 1.3, column, indent_of(text.source.line(below)), below
        )
    for number in range(text.number - 1, 0, -1):
        outer = indent_of(text.source.line(number))
        if text.code.line(number).strip() and len(outer) < len(column):
            yield from _moved(text, "line_above", 1.2, column, outer, number)
            column_left = outer
            if not column_left:
                break


def _continues(text: Broken, above: int) -> bool:
    """Whether a line may belong to a call or a block whose first line is not read as that."""
    before = text.code.line(above).rstrip() if above else ""
    between = [text.source.line(n).strip() for n in range(above + 1, text.number)]
    return (
        before.endswith(",")
        or text.line.rstrip().endswith(",")
        or text.line.lstrip().startswith(tuple("+-*/.|&"))
        or (HEAD.match(before) is not None and not before.endswith(":"))
        or any(HEAD.match(row.lstrip("# ")) and row.endswith(":") for row in between)
    )


def _above(text: Broken, above: int, column: str) -> Iterator[Indent]:
    """Yield the line above, or the head of its block, as far in as this line."""
    if not above:
        return
    old = indent_of(text.source.line(above))
    before = next((n for n in range(above - 1, 0, -1) if text.code.line(n).strip()), 0)
    if len(old) < len(column):
        row = text.source.line(before) if before else ""
        between = indent_of(row) == column or (
            row.rstrip().endswith(":") and indent_of(row) + " " * 4 == column
        )
        cost = 0.9 if between else 1.0
        yield ("line_above", cost, above, (_splice(text, above, old, column),), text.number)
    elif len(old) > len(column) and before:
        row = text.source.line(before)
        if row.rstrip().endswith(":") and indent_of(row) + " " * 4 == column:
            splice = _splice(text, above, old, column)
            yield ("line_above", 0.7, above, (splice,), text.number)
    for number in range(above, 0, -1):
        row, outer = text.code.line(number), indent_of(text.source.line(number))
        if row.strip() and len(outer) < len(column):
            if row.startswith("def ") and "self" in row and column in _columns(text, number):
                splice = _splice(text, number, outer, column)
                yield ("line_above", 0.8, number, (splice,), text.number)
            return


def _heads(text: Broken) -> dict[str, int]:
    """Return the columns at which heads of a line's kind begin, nearest first, with their lines."""
    line = text.code.line(text.number).lstrip()
    if line.startswith(("def ", "class ", "@")):
        return _columns(text, text.number)
    if not line.startswith(CLAUSES):
        return {}
    of_try = line.startswith(("except", "finally"))
    heads = ("try", "except") if of_try else ("if", "elif", "for", "while", "try", "except")
    found: dict[str, int] = {}
    for number in range(text.number - 1, 0, -1):
        if text.code.line(number).lstrip().startswith(heads):
            found.setdefault(indent_of(text.source.line(number)), number)
    return found


def _columns(text: Broken, without: int) -> dict[str, int]:
    """Return the columns of the methods of a file with a line of each, but not a line's own."""
    found: dict[str, int] = {}
    for number, row in enumerate(text.code.lines, 1):
        if number != without and row.lstrip().startswith("def ") and row[:1] == " ":
            found.setdefault(indent_of(row), number)
    found.pop(indent_of(text.code.line(without)), None)
    return found


def _beside(text: Broken, step: int) -> int:
    """Return the next line of code above or below; 0 if there is none."""
    number = text.number + step
    while 0 < number <= len(text.source.lines):
        if text.code.line(number).strip():
            return number
        number += step
    return 0


def _moved(
    text: Broken, variant: str, cost: float, old: str, new: str, other: int
) -> Iterator[Indent]:
    """Yield the line with another indentation, alone, and with the lines that belong to it."""
    if new == old:
        return
    source, rows, ends = text.source, [text.number], False
    yield (variant, cost, text.number, (_splice(text, text.number, old, new),), other)
    for number in range(text.number + 1, len(source.lines) + 1):
        code, column = text.code.line(number), indent_of(source.line(number))
        if not code.strip():
            continue
        ends = column == new
        deeper = len(column) > len(old)
        head = text.line.rstrip().endswith(":")
        if ends or not column.startswith(old) or (head and not deeper) or code.startswith(MARGIN):
            break
        rows.append(number)
    if len(rows) > 1:
        many = tuple(_splice(text, number, old, new) for number in rows)
        yield (
            variant,
            cost - 0.1 if ends and len(new) > len(old) else cost,
            text.number,
            many,
            other,
        )


def _splice(text: Broken, number: int, old: str, new: str) -> Splice:
    start = text.source.start_of(number)
    return Splice(start, start + len(old), new)
