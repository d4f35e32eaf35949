"""Lines in the code that a program printed or a tool wrote: a terminal's output, a patch, notes."""

from __future__ import annotations

import re
from collections.abc import Callable

from grader.package.edit.text import SourceText, Splice
from grader.package.source.broken_python import Broken, Slip, fault_of
from grader.package.source.python import can_parse

OUTPUT = re.compile(
    r"""
      Traceback\ \(most\ recent\ call\ last\):
    | \[(?:INFO|WARN|ERROR|DEBUG|FATAL)\]\ ?\[.*
    | (?:Starting\ >>>|Finished\ <<<|Failed\ +<<<)\ .*
    | Summary:\ \d+\ packages?\b.*
    | \[ros2run\]:.*
    | [ ]{2}File\ ".*",\ line\ \d+.*
    | (?:[\w.]{1,80}\.)?[A-Z]\w{1,60}(?:Error|Exception|Interrupt|Warning)(?::\ .*)?
    | \^C.*
    """,
    re.VERBOSE,
)
SAID = re.compile(r"(?:[ ]{2,}\S.*|[ \t]*\^+[ \t]*)")  # what is indented below a traceback
NOTE = re.compile(
    r"[ \t]*(?:\*\*[^*\r\n]{1,200}\*\*.*|[\u2022\u2023\u25cf\u25e6\u2043]\ .*|\d{1,2}[.)]\ +[A-Z`*].*"
    r"|[-*]\ +(?:[A-Z`*][\w'`*]*)(?:,?\ [\w'`*().-]+){2,}[.:!]?)[ \t]*"
)
HUNK = re.compile(
    r"@@ .*@@.*|diff --git .*|index [0-9a-f]+\.\..*|(?:---|\+\+\+)(?: .*)?|\\ No newline.*"
)


def output(text: Broken) -> Slip | None:
    """Return lines of a terminal's output."""
    first = text.number
    if OUTPUT.fullmatch(text.source.line(first).rstrip()) is None:
        return None
    last, traced = first, False
    for number in range(first, len(text.source.lines) + 1):
        row = text.source.line(number).rstrip()
        if OUTPUT.fullmatch(row) is None and row and not (traced and SAID.fullmatch(row)):
            break
        traced = row.startswith("Traceback") or (
            traced and bool(row) and SAID.fullmatch(row) is not None
        )
        last = number if row else last
    return _without(text, "output", first, last)


def note(text: Broken) -> Slip | None:
    """Return a line that is marked as text of a document: bold, or a point of a list."""
    if NOTE.fullmatch(text.source.line(text.number)) is None:
        return None
    return _without(text, "note", text.number, text.number)


def _without(text: Broken, variant: str, first: int, last: int) -> Slip | None:
    start, end = text.source.start_of(first), text.source.start_of(last + 1)
    new = text.source.spliced([Splice(start, end, "")])
    after = fault_of(new) if new is not None else text.fault
    if new is None or (after is not None and (after.line is None or after.line < first)):
        return None
    shown = text.source.line(first).strip()
    return Slip("pasted", variant, first, shown, "", new, other=last)


def patch(text: Broken) -> Slip | None:
    """Return the signs + and - at the start of lines, as in a patch."""
    written = text.source.line(text.number)
    if not written.startswith(("+", "-", "@@ ", "diff --git ", "index ")):
        return None
    rows = [text.source.line(number) for number in range(1, len(text.source.lines) + 1)]
    if not any(row.startswith("+") or HUNK.fullmatch(row) for row in rows):
        return None
    for is_whole in (False, True):
        splices = list(_patch(text.source, text.code, is_whole=is_whole))
        new = text.source.spliced(splices)
        if new is not None and can_parse(new):
            return Slip("pasted", "patch", text.number, written.strip(), fixed=new)
    return None


def _patch(source: SourceText, code: SourceText, *, is_whole: bool) -> list[Splice]:
    """Return the changes that apply a patch; in a whole one, other lines begin with a space."""
    found = []
    for number in range(1, len(source.lines) + 1):
        row, start = source.line(number), source.start_of(number)
        if HUNK.fullmatch(row) or (row[:1] == "-" and code.line(number)[:1] == "-"):
            found.append(source.without(number))
        elif row[:1] == "+" or (is_whole and row[:1] == " "):
            found.append(Splice(start, start + 1, ""))
    return found


OUTPUT_LOOKS: tuple[Callable[[Broken], Slip | None], ...] = (output, patch, note)
