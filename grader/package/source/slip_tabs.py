"""A line that is indented with a tab in a file whose other lines are indented with spaces."""

from __future__ import annotations

import ast

from grader.package.edit.text import Splice, indent_of
from grader.package.source.broken_python import Broken, Slip
from grader.package.source.python import can_parse, parse_python

WIDTHS = (8, 4)  # columns of a tab in a terminal's editor, and in VS Code


def tab(text: Broken) -> Slip | None:
    """Return the first line with a tab, and how many spaces it needs instead."""
    written = indent_of(text.source.line(text.number))
    if text.fault.kind != "tabs" or "\t" not in written or _mostly_tabs(text):
        return None
    shown = text.source.line(text.number).strip()
    above = next((n for n in range(text.number - 1, 0, -1) if text.code.line(n).strip()), 0)
    row = text.source.line(above)
    wanted = indent_of(row) + (" " * 4 if text.code.line(above).rstrip().endswith(":") else "")
    if "\t" in wanted or all(written.expandtabs(width) != wanted for width in WIDTHS):
        return Slip("signs", "tab_other", text.number, shown)
    new = _indented(text, written, wanted)
    others = {written.expandtabs(width) for width in WIDTHS} - {wanted}
    if any(_makes_sense(_indented(text, written, other), text.number) for other in others):
        new = None
    return Slip("signs", "tab", text.number, shown, str(len(wanted)), new, other=above)


def _indented(text: Broken, written: str, wanted: str) -> bytes | None:
    start = text.source.start_of(text.number)
    return text.changed(Splice(start, start + len(written), wanted))


def _makes_sense(found: bytes | None, number: int) -> bool:
    """Whether Python reads a file further, and the line is not in a class outside of its methods."""
    if found is None or not can_parse(found):
        return found is not None
    classes = [n for n in ast.walk(parse_python(found).tree) if isinstance(n, ast.ClassDef)]
    return not any(s.lineno == number for found in classes for s in found.body)


def _mostly_tabs(text: Broken) -> bool:
    indents = [indent_of(line) for line in text.source.lines if line.strip()]
    tabs = sum("\t" in indent for indent in indents)
    return 2 * tabs >= sum(bool(indent) for indent in indents)
