"""Half of a line, and a type, brackets, quotes or a handler that are written as in another place."""

from __future__ import annotations

import re
from collections.abc import Callable

from grader.package.edit.text import indent_of
from grader.package.source.broken_python import MOST_TRIES, Broken, Slip
from grader.package.source.slip_forms import as_written
from grader.package.source.slip_words import KNOWN

STARTS = re.compile(
    r"[ \t]*(?:(?:return|if|for|while|try|raise|with|pass|global|del|assert|def|class|import|from)\b|@"
    r"|[A-Za-z_][\w.]*\.[A-Za-z_]\w*[ \t]*[-+*/]?=(?!=))"
)
"""The start of a line that cannot be inside of brackets."""
HALF = re.compile(
    r"(?P<head>[ \t]*(?:async[ \t]+)?def[ \t]+\w+[ \t]*\([^()]*?)(?P<comma>[ \t]*,)?[ \t]*"
)
HALF_VALUE = re.compile(r"[ \t]*\S.*[(,=][ \t]*(?P<name>(?:[A-Za-z_]\w*\.)+)[ \t]*")
EMPTY_SQUARE = re.compile(r"(?<=\w)\[[ \t]*\]")
TYPES = "int|float|str|bool|list|dict|tuple|set"
TYPE_AS_VALUE = re.compile(
    rf"[ \t]*(?:self\.)?[A-Za-z_]\w*(?P<all>[ \t]*=[ \t]*(?P<type>{TYPES})[ \t]*:[ \t]*)(?=\S)"
)
KEY_QUOTE = re.compile(
    r"(?:^|[{,])[ \t]*(?P<quote>['\"])[A-Za-z_]\w*(?P<colon>):[ \t]*(?=['\"\d\[{])"
)
KIND = r"[A-Za-z_][\w.]*"
CATCH = re.compile(
    r"[ \t]*(?P<all>(?:\}[ \t]*)?catch\b[ \t]*\(?[ \t]*"
    rf"(?P<types>{KIND}(?:[ \t]*[|,][ \t]*{KIND})+)[ \t]*\)?(?:[ \t]+(?:as[ \t]+)?(?P<name>[a-z_]\w*))?"
    r"[ \t]*\)?[ \t]*[:{]?)[ \t]*$"
)


def _next_line(text: Broken) -> int:
    """Return the next line with code; 0 if there is none."""
    below = range(text.number + 1, len(text.code.lines) + 1)
    return next((n for n in below if text.code.line(n).strip()), 0)


def _half(text: Broken) -> Slip | None:
    """Return a line whose rest is missing: a def up to a parameter, or a call up to a dot."""
    below = _next_line(text)
    if "was never closed" not in text.fault.text or not below:
        return None
    row = text.code.line(below)
    apart = below > text.number + 1 and HALF_VALUE.fullmatch(text.line) is not None
    apart = apart and len(indent_of(row)) <= len(indent_of(text.line))
    if not STARTS.match(row) and not apart:
        return None
    match = HALF.fullmatch(text.line)
    written = text.source.line(text.number)
    if match is not None:
        end, open_end = match.end("head"), match["comma"] is not None
        wanted = f"{written[:end].strip()}{', …' if open_end else ''}):"
        new = None if open_end else text.changed(text.within(end, len(text.line.rstrip()), "):"))
        if not open_end and new is None:
            return None
        variant = "def_half_open" if open_end else "def_half"
        return Slip("signs", variant, text.number, written.strip(), wanted, new, other=below)
    match = HALF_VALUE.fullmatch(text.line)
    if match is None or text.line.count("(") != text.line.count(")") + 1:
        return None
    wanted = f"{written[: match.end('name')].strip()}…)"
    shown = written.strip()
    return Slip("signs", "value_half", text.number, shown, wanted, other=below, step=match["name"])


def _type_and_value(text: Broken) -> Slip | None:
    """Return a variable with its type behind = and its value behind a colon."""
    match = TYPE_AS_VALUE.match(text.line)
    if match is None:
        return None
    end = len(text.line.rstrip())
    wanted = f": {match['type']} = {text.source.line(text.number)[match.end() : end]}"
    splice = text.within(match.start("all"), end, wanted)
    return as_written(text, "type_and_value", splice)


def _round_brackets(text: Broken) -> Slip | None:
    """Return calls with empty square brackets."""
    squares = [m for m in EMPTY_SQUARE.finditer(text.line) if _is_called(text, m.start())]
    splices = [text.within(*square.span(), "()") for square in squares[:MOST_TRIES]]
    return as_written(text, "round_brackets", *splices) if splices else None


def _is_called(text: Broken, end: int) -> bool:
    """Whether the name that ends here is that of a function or a class, and not of a list."""
    name = (re.findall(r"\w+\Z", text.line[:end]) or [""])[0]
    made = re.search(rf"\b(?:def|class)[ \t]+{re.escape(name)}\b", text.code.text)
    return bool(made) or name in (*KNOWN, "super", "init", "ok", "shutdown")


def _key_quote(text: Broken) -> Slip | None:
    """Return a key of a dictionary without its second quote."""
    match = KEY_QUOTE.search(text.source.line(text.number))
    if match is None or not ("unterminated" in text.fault.text or "EOL" in text.fault.text):
        return None
    return as_written(text, "quote_exact", text.within(*match.span("colon"), match["quote"]))


def _catch(text: Broken) -> Slip | None:
    """Return a catch with several classes, as Java writes it."""
    match = CATCH.match(text.line)
    if match is None:
        return None
    types = ", ".join(re.split(r"[ \t]*[|,][ \t]*", match["types"]))
    new = f"except ({types})" + (f" as {match['name']}:" if match["name"] else ":")
    splice = text.within(*match.span("all"), new)
    fixed = text.changed(splice)
    return text.slip("language", "catch", "catch", splice, fixed=fixed) if fixed else None


HALF_LOOKS: tuple[Callable[[Broken], Slip | None], ...] = (
    _half, _type_and_value, _round_brackets, _key_quote, _catch,
)  # fmt: skip
