"""Slips between two pieces of code: a line that goes on, a missing dot, a unit behind a number."""

from __future__ import annotations

import re
from collections.abc import Callable

from grader.package.edit.text import Splice
from grader.package.source.broken_python import MOST_TRIES, Broken, Slip, fault_of

Look = Callable[[Broken], Slip | None]
DOTS = re.compile(r"(?P<mark>[ \t]*(?:\.\.\.|\u2026)|[ \t]+_)[ \t]*$")
ENDS_OPEN = re.compile(r"(?:[-+*/%.]|\b(?:and|or|not))[ \t]*$")
BEGINS_OPEN = re.compile(r"[ \t]*(?:[-+*/%][ \t]*[\w'\"(]|\.[A-Za-z_]\w*|(?:and|or)\b)")
LOGS = "info|warn|warning|error|debug|fatal"
DOT_MISSING = re.compile(
    rf"\b(?:get_logger\(\)(?P<log>[ \t]+)(?=(?:{LOGS})[ \t]*\()"
    r"|super\(\)(?P<super>[ \t]+)(?=__init__\b)"
    r"|(?:self|rclpy)(?P<object>[ \t]+)(?!(?:and|or|in|is|if|else|not|as|import|for)\b)(?=[A-Za-z_]\w*[ \t]*(?:[(.]|[-+]?=)))"
)
UNIT = re.compile(r"(?<![\w.])\d[\d.]*(?P<unit>[ \t]+(?P<name>[A-Za-z]+))(?=[ \t]*[,)])")
SECONDS = ("s", "sec", "secs", "second", "seconds")
UNITS = (*SECONDS, "ms", "msec", "millis", "milliseconds", "us", "ns", "min", "minutes", "Hz", "hz")
BRACES = re.compile(
    r"(?P<text>(?<![\w])(?P<quote>['\"])_*(?P=quote))[ \t]*(?P<value>\{[\w.]+\})(?=[ \t]*[,)])"
)
CAST = re.compile(
    r"\((?P<type>str|string|String|int|float|double)\)[ \t]*(?P<value>[A-Za-z_][\w.]*)(?![\w.(])"
)
TYPES = {"string": "str", "String": "str", "double": "float"}
SEPARATOR = re.compile(r"(?P<sign>;|(?<=\d):)(?=[ \t]*[\w'\"])")
WORDS = re.compile(
    rf"(?:\.(?:{LOGS})|\bprint)\([ \t]*(?P<text>[A-Za-z]\w*(?:[ \t]+[A-Za-z]\w*)*[ \t]*:?)[ \t]*(?=[+,)])"
)


def _depth(code: str) -> int:
    """Return how many brackets are open at the end of code."""
    opened = sum(code.count(sign) for sign in "([{")
    return opened - sum(code.count(sign) for sign in ")]}")


def _dots(text: Broken) -> Slip | None:
    """Return a line that ends with the sign with which another language continues a line."""
    last = _last_line(text)
    for number in (*range(text.number, last + 1), text.number - 1):
        row = text.code.line(number)
        match = DOTS.search(row) if number > 0 else None
        if match is None or not text.code.line(number + 1).strip():
            continue
        start = text.code.start_of(number)
        inside = _depth(text.code.text[: start + match.start()]) > 0
        splice = Splice(start + match.start(), start + len(row), "" if inside else " \\")
        new = text.source.spliced([splice])
        after = fault_of(new) if new is not None else text.fault
        if new is None or (after is not None and (after.line or 0) <= number + 1):
            continue
        written = text.source.line(number)
        wanted = written[: match.start()].strip() + ("" if inside else " \\")
        variant = "dots_inside" if inside else "dots_outside"
        sign = match["mark"].strip()
        return Slip("language", variant, number, sign, wanted, new, other=number + 1)
    return None


def _last_line(text: Broken) -> int:
    """Return the last line of the brackets that are open in the line at which Python stops."""
    last = text.number
    start = text.code.start_of(text.number)
    while last < min(len(text.code.lines), text.number + MOST_TRIES):
        if _depth(text.code.text[start : text.code.end_of(last)]) <= 0:
            break
        last += 1
    return last


def _goes_on(text: Broken) -> Slip | None:
    """Return a line, outside of brackets, that is to go on in the next one."""
    above = text.number
    if BEGINS_OPEN.match(text.line) and "unexpected indent" in text.fault.text:
        above = text.number - 1
    elif ENDS_OPEN.search(text.line) is None:
        return None
    row, below = text.code.line(above), text.code.line(above + 1)
    if not row.strip() or not below.strip() or row.rstrip().endswith(":"):
        return None
    start, ends = text.code.start_of(above), text.source.end_of(above)
    end = start + len(row.rstrip())
    written, note = text.source.text[start:end].strip(), text.source.text[end:ends].strip()
    variant, wanted = "goes_on", f"{written} \\"
    splice = Splice(end, ends, " \\")
    if note:  # nothing may be behind a \
        second = text.source.line(above + 1)
        variant, wanted = "goes_on_joined", f"{written} {second.strip()}"
        same = Splice(end, text.source.end_of(above + 1), f" {second.strip()}  {note}")
        splice = same if "#" not in second else Splice(end, end, "")
    new = text.source.spliced([splice])
    after = fault_of(new) if new is not None else text.fault
    if new is None or (after is not None and (after.line or 0) <= above + 1):
        return None
    return Slip("signs", variant, above, written, wanted, new, other=above + 1)


def _dot(text: Broken) -> Slip | None:
    """Return a missing dot between an object and its part."""
    if re.match(r"[ \t]*(?:import|from)\b", text.line):
        return None
    matches = list(DOT_MISSING.finditer(text.line))[:MOST_TRIES]
    spans = [m.span(next(g for g in ("log", "super", "object") if m[g])) for m in matches]
    splices = [text.within(*span, ".") for span in spans]
    new = text.changed(*splices) if splices else None
    written = text.source.line(text.number)
    return text.slip("signs", "dot_missing", written, *splices, fixed=new) if new else None


def _unit(text: Broken) -> Slip | None:
    """Return a number with a unit behind it."""
    match = UNIT.search(text.line)
    if match is None or match["name"] not in UNITS:
        return None
    written = text.source.line(text.number)
    if match["name"] not in SECONDS:
        return Slip("signs", "number_other_unit", text.number, written.strip(), match["name"])
    splice = text.within(*match.span("unit"), "")
    new = text.changed(splice)
    return text.slip("signs", "number_unit", written, splice, fixed=new) if new else None


def _braces(text: Broken) -> Slip | None:
    """Return a value in braces that is behind a text and not in it."""
    match = BRACES.search(text.line)
    if match is None:
        return None
    written = text.source.line(text.number)
    inside = written[match.start("text") + 1 : match.end("text") - 1]
    if "{" in inside or "}" in inside or "\\" in inside:
        return None
    wanted = f"f{match['quote']}{inside}{match['value']}{match['quote']}"
    splice = text.within(*match.span(), wanted)
    new = text.changed(splice)
    return text.slip("signs", "braces_outside", written, splice, fixed=new) if new else None


def _cast(text: Broken) -> Slip | None:
    """Return a type in brackets before a value, as C and Java convert it."""
    match = CAST.search(text.line)
    if match is None:
        return None
    splice = text.within(
        *match.span(), f"{TYPES.get(match['type'], match['type'])}({match['value']})"
    )
    new = text.changed(splice)
    return text.slip("language", "cast", match[0], splice, fixed=new) if new else None


def _separator(text: Broken) -> Slip | None:
    """Return a ; or a : between two values in brackets."""
    if re.search(r"\blambda\b", text.line):
        return None
    for match in list(SEPARATOR.finditer(text.line))[:MOST_TRIES]:
        at = text.code.start_of(text.number) + match.start("sign")
        if not _in_round(text.code.text[:at]):
            continue
        splice = text.within(*match.span("sign"), ",")
        new = text.changed(splice)
        if new is not None:
            written = text.source.line(text.number)
            return text.slip("signs", "comma_instead", written, splice, fixed=new)
    return None


def _in_round(code: str) -> bool:
    """Whether the innermost bracket that is open at the end of code is a round one."""
    depth = 0
    for sign in reversed(code[-2000:]):
        depth += (sign in ")]}") - (sign in "([{")
        if depth < 0:
            return sign == "("
    return False


def _words(text: Broken) -> Slip | None:
    """Return a text to be logged that has no quotes."""
    match = WORDS.search(text.line)
    if match is None or not re.search(r"[ \t:]", match["text"].strip()):
        return None
    quote = text.source.quote
    start, end = match.span("text")
    blank = " " if text.line[end - 1] in ": \t" or text.line[end : end + 1].isspace() else ""
    words = text.line[start:end].rstrip()
    ends = blank if text.line[end:].lstrip().startswith("+") else ""
    splice = text.within(start, end, f"{quote}{words}{ends}{quote}")
    new = text.changed(splice)
    written = text.source.line(text.number)
    return text.slip("signs", "text_unquoted", written, splice, fixed=new) if new else None


JOINED_LOOKS: tuple[Look, ...] = (
    _dots, _goes_on, _dot, _unit, _braces, _cast, _separator, _words,
)  # fmt: skip
