"""Slips of try: without except or finally, or with one that is misspelt or in another column."""

from __future__ import annotations

import re

from grader.base.nearest import nearest
from grader.package.edit.text import Splice, indent_of
from grader.package.source.broken_python import Broken, Slip
from grader.package.source.python import can_parse

EXPECTED = "expected 'except' or 'finally' block"
FAULTS = (EXPECTED, "invalid syntax", "unexpected indent", "unindent does not match")
CLAUSE = re.compile(r"[ \t]*(?:except|finally)\b")
TRY = re.compile(r"[ \t]*try[ \t]*:")
ALIKE = {"expect": "except", "exception": "except", "excepts": "except", "final": "finally"}
OTHER_LOOKS = r"[ \t]*(?i:except|finally|catch)\b"
"""With capitals, or of another language: recognised elsewhere."""
WORD = re.compile(r"[ \t]*(?P<word>\w{1,20})\b[^=(]{0,200}:[ \t]*$")


def try_block(text: Broken) -> Slip | None:
    """Return what is wrong with the except or finally that a try: needs."""
    head = try_above(text) if any(known in text.fault.text for known in FAULTS) else None
    if head is None:
        return _after_clause(text)
    clause = CLAUSE.match(text.line) is not None
    width, own = (len(indent_of(text.source.line(n))) for n in (head, text.number))
    if clause and own != width:
        return _in_other_column(text, head)
    if EXPECTED not in text.fault.text:
        return None
    match = WORD.match(text.line)
    word = match["word"] if match is not None else ""
    if re.match(OTHER_LOOKS, text.line):
        return None
    close = ALIKE.get(word) or nearest(word, ("except", "finally"), cutoff=0.7)
    written = text.source.line(text.number)
    if match is not None and close and own == width:
        splice = text.within(*match.span("word"), close)
        new = text.changed(splice)
        return text.slip("signs", "clause_misspelt", written, splice, fixed=new) if new else None
    later = _clause_below(text, width)
    if later:
        return Slip("signs", "try_between", text.number, written.strip(), str(head), other=later)
    shown = text.source.line(head).strip()
    return Slip("signs", "try_alone", head, shown, "", _caught(text, head), other=text.number)


def try_above(text: Broken) -> int | None:
    """Return the line of the innermost try: above that has no except or finally."""
    widths: set[int] = set()
    for number in range(text.number - 1, 0, -1):
        row = text.code.line(number)
        width = len(indent_of(row))
        if CLAUSE.match(row):
            widths.add(width)
        elif TRY.match(row):
            if width not in widths:
                return number
            widths.discard(width)
        elif re.match(r"[ \t]*(?:def|class)\b", row) and width < len(indent_of(text.line)):
            return None
    return None


def _after_clause(text: Broken) -> Slip | None:
    """Return a finally that begins in another column than its try:, which has an except."""
    if CLAUSE.match(text.line) is None or "invalid syntax" not in text.fault.text:
        return None
    own = len(indent_of(text.line))
    for number in range(text.number - 1, 0, -1):
        row = text.code.line(number)
        if TRY.match(row):
            found = _in_other_column(text, number) if len(indent_of(row)) != own else None
            return found if found is not None and found.fixed is not None else None
        if re.match(r"[ \t]*(?:def|class)\b", row):
            return None
    return None


def _in_other_column(text: Broken, head: int) -> Slip | None:
    """Return an except or finally that begins in another column than its try:."""
    wanted, written = (indent_of(text.source.line(n)) for n in (head, text.number))
    start = text.source.start_of(head)
    moved = text.source.spliced([Splice(start, start + len(wanted), written)])
    splices = []
    for number in range(text.number, len(text.source.lines) + 1):
        row = text.source.line(number)
        inside = indent_of(row).startswith(written) and indent_of(row) != written
        if row.strip() and number != text.number and not inside:
            break
        if row.strip():
            start = text.source.start_of(number)
            splices.append(Splice(start, start + len(written), wanted))
    new = text.changed(*splices)
    if moved is not None and can_parse(moved) and (new is None or not can_parse(new)):
        shown = text.source.line(head).strip()
        return Slip("signs", "line_above", head, shown, "", moved, other=text.number)
    shown = text.source.line(text.number).strip()
    return Slip("signs", "clause_column", text.number, shown, "", new, other=head)


def _clause_below(text: Broken, width: int) -> int:
    """Return the line of the except or finally below the line at which Python stops; 0 if none."""
    for number in range(text.number, len(text.code.lines) + 1):
        row = text.code.line(number)
        if CLAUSE.match(row) and len(indent_of(row)) == width:
            return number
        if row.strip() and (len(indent_of(row)) < width or TRY.match(row)):
            break
    return 0


def _caught(text: Broken, head: int) -> bytes | None:
    """Return the file with `except KeyboardInterrupt` below a try: that spins the node."""
    block = [text.code.line(number) for number in range(head + 1, text.number)]
    used = [n for n, row in enumerate(block, head + 1) if row.strip()]
    if not used or not any(re.search(r"\bspin\w*[ \t]*\(", row) for row in block):
        return None
    indent = indent_of(text.source.line(head))
    rows = (f"{indent}except KeyboardInterrupt:", f"{indent}    pass")
    return text.changed(text.source.before(used[-1] + 1, *rows))
