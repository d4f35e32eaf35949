"""Slips in the braces of an f-string: a statement, nothing, a sign that does not belong there."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

from grader.package.edit.text import Splice, indent_of
from grader.package.source.broken_python import MOST_TRIES, Broken, Slip

START = re.compile(r"(?<!\w)(?:[fF][rR]?|[rR][fF])['\"]")
CHANGES = re.compile(
    r"(?<!\{)\{[ \t]*\(?[ \t]*(?P<name>[A-Za-z_][\w.]{0,80})[ \t]*"
    r"(?:(?P<twice>\+\+|--)|(?P<sign>[-+*]|//?)=[ \t]*(?P<by>[\w.]{1,80})"
    r"|:?=(?![=}])[ \t]*(?P<value>[\w.][\w.+* \t-]{0,80}?))[ \t]*\)?[ \t]*\}(?!\})"
)
EMPTY = re.compile(r"(?<!\{)\{[ \t]{0,9}\}(?!\})")
ROUND = re.compile(r"(?<!\{)\{[ \t]*[A-Za-z_][\w.]{0,80}(?:\(\))?[ \t]*(?P<sign>[)\]>])")
BACKSLASH = "cannot include a backslash"


def _changed(text: Broken) -> Slip | None:
    """Return a statement in the braces, which changes the value that they show."""
    written = text.source.line(text.number)
    for match in _in_fields(CHANGES, written):
        name = match["name"]
        splice = text.within(*match.span(), f"{{{name}}}")
        new = text.changed(splice)
        if new is None:
            continue
        step = _step(match)
        found = text.slip("signs", "field_changes", written, splice, fixed=new)
        code = text.code.text
        counted = re.search(
            rf"(?<![\w.]){re.escape(name)}[ \t]*(?:\+=|=[ \t]*{re.escape(name)})", code
        )
        alone = written.rstrip().endswith(")") and _is_closed(text.line)
        if not step or counted:
            return replace(found, variant="field_sets", fixed=new if counted else None)
        both = text.changed(splice, _below(text, step)) if alone else None
        return replace(found, step=step, fixed=both)
    return None


def _step(match: re.Match[str]) -> str:
    """Return the statement that stands in the braces; "" for one that sets the same each time."""
    name, value = match["name"], match["value"]
    if match["twice"]:
        return f"{name} {match['twice'][0]}= 1"
    if match["sign"]:
        return f"{name} {match['sign']}= {match['by']}"
    again = value is not None and re.search(rf"(?<![\w.]){re.escape(name)}(?![\w.])", value)
    return f"{name} = {value.strip()}" if again else ""


def _below(text: Broken, step: str) -> Splice:
    end = text.source.end_of(text.number)
    indent = indent_of(text.source.line(text.number))
    return Splice(end, end, f"{text.source.newline}{indent}{step}")


def _is_closed(line: str) -> bool:
    return all(line.count(a) == line.count(b) for a, b in ("()", "[]"))


def _in_fields(pattern: re.Pattern[str], line: str) -> list[re.Match[str]]:
    """Return the matches behind the first f-string of a line."""
    start = START.search(line)
    return list(pattern.finditer(line, start.end()))[:MOST_TRIES] if start is not None else []


def _empty(text: Broken) -> Slip | None:
    """Return braces without a value; the f is too much if format() fills them."""
    written = text.source.line(text.number)
    start = START.search(written)
    if start is None or not _in_fields(EMPTY, written):
        return None
    if "empty expression" not in text.fault.text and "valid expression" not in text.fault.text:
        return None
    if re.search(r"['\"]\.format\(", written[start.end() :]):
        splice = text.within(start.start(), start.start() + 1, "")
        new = text.changed(splice)
        if new is not None:
            return text.slip("signs", "field_format", written, splice, fixed=new)
    return text.slip("signs", "field_empty", written)


def _round(text: Broken) -> Slip | None:
    """Return a closing bracket of another kind where the brace is to be closed."""
    written = text.source.line(text.number)
    for match in _in_fields(ROUND, written):
        splice = text.within(*match.span("sign"), "}")
        new = text.changed(splice)
        if new is not None:
            return text.slip("signs", "brace_kind", written, splice, fixed=new)
    return None


def _backslash(text: Broken) -> Slip | None:
    """Return a backslash in the braces, which only Python 3.12 and later can read."""
    if BACKSLASH not in text.fault.text:
        return None
    return text.slip("signs", "field_backslash", text.source.line(text.number))


FIELD_LOOKS: tuple[Callable[[Broken], Slip | None], ...] = (_changed, _empty, _round, _backslash)
