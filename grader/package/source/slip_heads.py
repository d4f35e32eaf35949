"""The damaged head of a def, a class or an except, and a bracket that is closed too early."""

from __future__ import annotations

import keyword
import re
from collections.abc import Callable

from grader.package.edit.text import Splice, indent_of
from grader.package.source.broken_python import MOST_TRIES, Broken, Slip
from grader.package.source.python import can_parse
from grader.package.source.slip_forms import as_written
from grader.package.source.slip_words import KNOWN

Look = Callable[[Broken], Slip | None]
STARTS = re.compile(
    r"[ \t]*(?:(?:return|if|for|while|try|raise|with|pass|global|del|assert|def|class|import|from)\b|@"
    r"|[A-Za-z_][\w.]*\.[A-Za-z_]\w*[ \t]*[-+*/]?=(?!=))"
)
"""The start of a line that cannot be inside of brackets."""
HALF = re.compile(
    r"(?P<head>[ \t]*(?:async[ \t]+)?def[ \t]+\w+[ \t]*\([^()]*?)(?P<comma>[ \t]*,)?[ \t]*"
)
HALF_VALUE = re.compile(r"[ \t]*\S.*[(,=][ \t]*(?P<name>(?:[A-Za-z_]\w*\.)+)[ \t]*")
IS_CLASS = re.compile(r"[ \t]*(?P<word>def)[ \t]+(?P<name>[A-Z]\w*)[ \t]*:[ \t]*")
IS_METHOD = re.compile(r"[ \t]*(?P<word>class)[ \t]+[a-z_]\w*[ \t]*\([ \t]*self\b[^()]*\)[ \t]*:")
FIELD = re.compile(r"[ \t]+(?:[A-Za-z_]\w*[ \t]*:[ \t]*[A-Za-z_]|(?:async[ \t]+)?def\b|@)")
SELF_NAME = re.compile(
    r"[ \t]*(?:async[ \t]+)?def[ \t]+(?P<all>self\.(?P<name>[A-Za-z_]\w*)[ \t]*\((?P<given>[^()]*)\))"
)
SQUARE_DEF = re.compile(
    r"[ \t]*(?:async[ \t]+)?def[ \t]+\w+[ \t]*(?P<all>\[(?P<given>[^()\[\]{}]*)\])"
)
EMPTY_SQUARE = re.compile(r"(?<=\w)\[[ \t]*\]")
NO_COLON = re.compile(r"\blambda(?P<blank>[ \t]+)(?=[A-Za-z_][\w.]*\()")
TYPES = "int|float|str|bool|list|dict|tuple|set"
TYPE_AS_VALUE = re.compile(
    rf"[ \t]*(?:self\.)?[A-Za-z_]\w*(?P<all>[ \t]*=[ \t]*(?P<type>{TYPES})[ \t]*:[ \t]*)(?=\S)"
)
KEY_QUOTE = re.compile(
    r"(?:^|[{,])[ \t]*(?P<quote>['\"])[A-Za-z_]\w*(?P<colon>):[ \t]*(?=['\"\d\[{])"
)
TWO_QUOTES = re.compile(r"[ \t]*(?P<first>\"\"|'')[^'\"]+(?P<last>\"\"|'')[ \t]*")
KIND = r"[A-Za-z_][\w.]*"
SEVERAL = re.compile(
    r"[ \t]*(?P<all>(?:\}[ \t]*)?(?P<word>except|catch)\b[ \t]*\(?[ \t]*"
    rf"(?P<types>{KIND}(?:[ \t]*[|,][ \t]*{KIND})+)[ \t]*\)?(?:[ \t]+(?:as[ \t]+)?(?P<name>[a-z_]\w*))?"
    r"[ \t]*\)?[ \t]*[:{]?)[ \t]*$"
)
JOINED = re.compile(r"(?<=\S)(?P<blank>[ \t]{2,})(?=(?:def|class)[ \t]+\w+[ \t]*[(:]|@\w)")


def _shown(text: Broken) -> str:
    return text.source.line(text.number).strip()


def _reads_alone(code: str) -> bool:
    """Whether Python reads code as the block of a function."""
    return can_parse(f"def f():\n    {code}\n".encode())


def _next_line(text: Broken) -> int:
    """Return the next line with code; 0 if there is none."""
    below = range(text.number + 1, len(text.code.lines) + 1)
    return next((n for n in below if text.code.line(n).strip()), 0)


def _half(text: Broken) -> Slip | None:
    """Return a line whose rest is missing: a def up to a parameter, or a call up to a dot."""
    below = _next_line(text)
    if "was never closed" not in text.fault.text or not STARTS.match(text.code.line(below)):
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
    return Slip("signs", "value_half", text.number, written.strip(), wanted, step=match["name"])


def _class_or_def(text: Broken) -> Slip | None:
    """Return a class that begins with def, or a method that begins with class."""
    match = IS_CLASS.fullmatch(text.line)
    if match is not None:
        above = text.code.line(text.number - 1) if text.number > 1 else ""
        is_class = FIELD.match(text.code.line(_next_line(text))) or "dataclass" in above
        return _as(text, "class_as_def", match.span("word"), "class") if is_class else None
    if "'return' outside function" not in text.fault.text:
        return None
    width = len(indent_of(text.line))
    for number in range(text.number - 1, 0, -1):
        row = text.code.line(number)
        if not row.strip() or len(indent_of(row)) >= width:
            continue
        width = len(indent_of(row))
        match = IS_METHOD.match(row)
        if match is not None:
            start = text.source.start_of(number)
            at, end = (start + place for place in match.span("word"))
            new, shown = text.changed(Splice(at, end, "def")), text.source.line(number).strip()
            wanted = f"def{shown.removeprefix('class')}"
            return Slip("signs", "def_as_class", number, shown, wanted, new, other=text.number)
        if re.match(r"[ \t]*(?:class|def)\b", row):
            break
    return None


def _as(text: Broken, variant: str, span: tuple[int, int], new: str) -> Slip | None:
    return as_written(text, variant, text.within(*span, new))


def _written(text: Broken) -> Slip | None:
    """Return a head, a call or a value with a wrong or a missing sign."""
    match = SELF_NAME.match(text.line)
    if match is not None:
        written = text.source.line(text.number)[slice(*match.span("given"))].strip()
        given = (
            written if re.match(r"self\b", written) else ", ".join(filter(None, ("self", written)))
        )
        return _as(text, "def_without_self", match.span("all"), f"{match['name']}({given})")
    match = SQUARE_DEF.match(text.line)
    if match is not None:
        given = text.source.line(text.number)[slice(*match.span("given"))]
        return _as(text, "round_brackets", match.span("all"), f"({given})")
    match = NO_COLON.search(text.line)
    if match is not None and not re.match(r"[^:]*:", text.line[match.end() :]):
        return _as(text, "lambda_colon", match.span("blank"), ": ")
    match = TYPE_AS_VALUE.match(text.line)
    if match is not None:
        found = text.line[match.end() :].rstrip()
        end = match.end() + len(found)
        wanted = f": {match['type']} = {text.source.line(text.number)[match.end() : end]}"
        return _as(text, "type_and_value", (match.start("all"), end), wanted)
    squares = [m for m in EMPTY_SQUARE.finditer(text.line) if _is_called(text, m.start())]
    splices = [text.within(*square.span(), "()") for square in squares[:MOST_TRIES]]
    return as_written(text, "round_brackets", *splices) if splices else None


def _is_called(text: Broken, end: int) -> bool:
    """Whether the name that ends here is that of a function or a class, and not of a list."""
    name = (re.findall(r"\w+\Z", text.line[:end]) or [""])[0]
    made = re.search(rf"\b(?:def|class)[ \t]+{re.escape(name)}\b", text.code.text)
    return bool(made) or name in (*KNOWN, "super", "init", "ok", "shutdown")


def _quote(text: Broken) -> Slip | None:
    """Return a key without its second quote, or a docstring in two quotes."""
    written = text.source.line(text.number)
    match = TWO_QUOTES.fullmatch(written)
    if match is not None and match["first"] == match["last"]:
        splices = [
            text.within(*match.span(part), match["first"][0] * 3) for part in ("first", "last")
        ]
        return as_written(text, "docstring_quotes", *splices)
    match = KEY_QUOTE.search(written)
    if match is None or not ("unterminated" in text.fault.text or "EOL" in text.fault.text):
        return None
    return _as(text, "quote_exact", match.span("colon"), match["quote"])


def _def_behind(text: Broken) -> Slip | None:
    """Return a def or a class behind another statement, on the same line."""
    match = JOINED.search(text.line)
    if match is None or not _reads_alone(text.line[: match.start()].strip()):
        return None
    blanks = match["blank"] if len(match["blank"]) % 4 == 0 else ""
    new = text.changed(text.within(*match.span(), text.source.newline + blanks))
    second = text.source.line(text.number)[match.end() :].strip()
    return Slip("signs", "two_statements", text.number, _shown(text), second, new)


def _closed_early(text: Broken) -> Slip | None:
    """Return a bracket that ends a call, the values of which go on in the next line."""
    above = next((n for n in range(text.number - 1, 0, -1) if text.code.line(n).strip()), 0)
    row = text.code.line(above).rstrip() if above else ""
    if "unexpected indent" not in text.fault.text or not row.endswith("),"):
        return None
    at = text.code.start_of(above) + len(row) - 2
    new = text.source.spliced([Splice(at, at + 1, "")])
    if new is None or not can_parse(new):
        return None
    written = text.source.line(above)
    wanted = (written[: len(row) - 2] + written[len(row) - 1 :]).strip()
    return Slip("signs", "bracket_early", above, written.strip(), wanted, new, other=text.number)


def _comment_lost(text: Broken) -> Slip | None:
    """Return a line without a #, between two comments, that is no Python."""
    row = text.source.line(text.number)
    above, below = (
        (text.source.line(text.number + by) for by in (-1, 1)) if text.number > 1 else ("", "")
    )
    if not all(re.match(r"[ \t]*#(?!!)", line) for line in (above, below)):
        return None
    written = row.strip()
    first = re.match(r"\w+", written)
    is_code = _reads_alone(written) or _reads_alone(f"{written}\n        pass")
    if is_code or first is None or keyword.iskeyword(first[0]) or re.search(r"[=(]", written):
        return None
    start, end = text.source.start_of(text.number), text.source.end_of(text.number)
    wanted = f"# {written}"
    new = text.changed(Splice(start, end, indent_of(above) + wanted))
    return Slip("signs", "note_without_sign", text.number, written, wanted, new) if new else None


def _several(text: Broken) -> Slip | None:
    """Return an except, or a catch, with several classes and a name, as Java writes them."""
    match = SEVERAL.match(text.line)
    if match is None or (match["name"] is None and match["word"] == "except"):
        return None
    types = ", ".join(re.split(r"[ \t]*[|,][ \t]*", match["types"]))
    new = f"except ({types})" + (f" as {match['name']}:" if match["name"] else ":")
    if match["word"] == "except":
        return _as(text, "handler_several", match.span("all"), new)
    splice = text.within(*match.span("all"), new)
    fixed = text.changed(splice)
    return text.slip("language", "catch", "catch", splice, fixed=fixed) if fixed else None


HEAD_LOOKS: tuple[Look, ...] = (
    _comment_lost, _several, _half, _class_or_def, _written, _quote, _def_behind, _closed_early,
)  # fmt: skip
