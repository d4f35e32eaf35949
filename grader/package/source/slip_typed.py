"""Slips of the hand: a blank inside of an operator, a wrong sign at the end, an order of blocks."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from grader.package.edit.text import Splice, indent_of
from grader.package.source.broken_python import BLOCK, LONGEST, MOST_TRIES, Broken, Slip, fault_of

Look = Callable[[Broken], Slip | None]


@dataclass(frozen=True)
class Typed:
    """A pattern of a line of code, and what it should be: Python must read further after it."""

    variant: str
    pattern: re.Pattern[str]
    new: str


def _typed(variant: str, pattern: str, new: str) -> Typed:
    return Typed(variant, re.compile(pattern), new)


RULES = (
    _typed("operator_split", r"(?P<sign>[-+*/%!<>=])[ \t]+=(?!=)", r"\g<sign>="),
    _typed("operator_swapped", r"(?P<start>^[ \t]*(?:if|elif|while|return|assert)\b.*?)=(?P<sign>[<>])(?!=)",
           r"\g<start>\g<sign>="),
    _typed("prefix_apart", r"\b(?P<prefix>[fFrR])[ \t]+(?=['\"])", r"\g<prefix>"),
    _typed("dot_bracket", r"(?<=\w)[ \t]*\.[ \t]*(?=[(\[])", ""),
    _typed("parameter_outside", r"\([ \t]*\)[ \t]*(?P<inside>self|args(?:[ \t]*=[ \t]*None)?)[ \t]*(?=:)",
           r"(\g<inside>)"),
    _typed("def_brackets", r"^(?P<start>[ \t]*def[ \t]+\w+)[ \t]+(?P<inside>self(?:[ \t]*,[ \t]*\w+){0,4})[ \t]*(?=:)",
           r"\g<start>(\g<inside>)"),
    _typed("call_brackets", r"\b(?P<name>str|int|float|len|repr|round)[ \t]+(?P<given>[A-Za-z_][\w.]*)(?![\w.(\[])",
           r"\g<name>(\g<given>)"),
    _typed("import_comma", r"^(?P<all>[ \t]*(?:from[ \t].*|import[ \t].*?))[ \t]*,[ \t]*$", r"\g<all>"),
    _typed("colon_missing", rf"^(?P<all>[ \t]*(?:{BLOCK})\b.*?)[ \t]*[;,.][ \t]*$", r"\g<all>:"),
    _typed("arrow_behind_colon",
           r"^(?P<start>[ \t]*(?:async[ \t]+)?def[ \t]+\w+[ \t]*\([^()]*\))[ \t]*:[ \t]*->[ \t]*(?P<type>[\w.\[\], |]+?)[ \t]*:?[ \t]*$",
           r"\g<start> -> \g<type>:"),
    _typed("arrow_half",
           r"^(?P<start>[ \t]*(?:async[ \t]+)?def[ \t]+\w+[ \t]*\([^()]*\))[ \t]*(?:-+|=>|>|-[ \t]+>|=+)[ \t]*(?P<type>[A-Za-z_][\w.\[\], |]*?)[ \t]*(?=:)",
           r"\g<start> -> \g<type>"),
    _typed("editor_behind", r"[ \t]*:(?:wqa?|w|qa?|x)!?[ \t]*$", ""),
    _typed("backslash_end", r"\\[ \t]+$", "\\"),
)  # fmt: skip


COMPARES = re.compile(r"[ \t]*(?:if|elif|while|assert|return|and|or|not)\b|[^=]*[(\[]")


def _by_rule(text: Broken) -> Slip | None:
    for rule in RULES:
        for match in list(rule.pattern.finditer(text.line))[:MOST_TRIES]:
            if (
                rule.variant == "operator_split"
                and match["sign"] == "="
                and not COMPARES.match(text.line)
            ):
                continue
            if rule.variant == "editor_behind" and _is_name(text, match[0]):
                continue
            splice = text.within(*match.span(), text.expanded(match, rule.new))
            new = text.changed(splice)
            if new is not None:
                written = text.source.line(text.number)
                return text.slip("signs", rule.variant, written, splice, fixed=new)
    return None


def _is_name(text: Broken, end: str) -> bool:
    """Whether the letters behind the colon are a name that the file uses elsewhere."""
    name = end.strip(" \t:!")
    return re.search(rf"(?<![\w:]){re.escape(name)}\b", text.code.text) is not None


def _colon_inside(text: Broken) -> Slip | None:
    """Return a block behind its head on one line, without the colon between the two."""
    head = re.match(rf"[ \t]*(?:{BLOCK})\b", text.line)
    if head is None or "'else'" in text.fault.text or text.line.rstrip().endswith(":"):
        return None
    found = []
    for match in list(re.finditer(r"[ \t]+(?=[\w'\"])", text.line[head.end() :]))[: 2 * MOST_TRIES]:
        at = head.end() + match.start()
        splice = text.within(at, at, ":")
        new = text.changed(splice)
        found += [(splice, new)] if new is not None else []
    if len(found) != 1:
        return None
    written = text.source.line(text.number)
    return text.slip("signs", "colon_inside", written, found[0][0], fixed=found[0][1])


JOINED = re.compile(r"(?<=[\w*])[ \t]+(?=(?:from|import)\b)")


def _imports_joined(text: Broken) -> Slip | None:
    """Return two imports on one line."""
    if re.match(r"[ \t]*(?:from|import)\b", text.line) is None:
        return None
    for match in list(JOINED.finditer(text.line))[:MOST_TRIES]:
        parts = (text.line[: match.start()].strip(), text.line[match.end() :].strip())
        if any(fault_of(part.encode()) is not None for part in parts):
            continue
        new = text.changed(text.within(*match.span(), text.source.newline + indent_of(text.line)))
        if new is not None:
            shown = text.source.line(text.number).strip()
            return Slip("signs", "two_statements", text.number, shown, parts[1], new)
    return None


LAMBDA = re.compile(r"\blambda\b[^:()]*:[ \t]*(?P<body>.+)$")
STATEMENT = re.compile(r"(?<![=!<>:])(?:[-+*/%]?=)(?!=)|;")


def _lambda(text: Broken) -> Slip | None:
    """Return a lambda with a statement in it."""
    match = LAMBDA.search(text.line)
    if match is None:
        return None
    depth, end = 0, match.start("body")
    while end < len(text.line) and depth >= 0:
        depth += (text.line[end] in "([{") - (text.line[end] in ")]}")
        end += 1
    end = end - 1 if depth < 0 else end
    outside = re.sub(r"\([^()]*\)", lambda m: "_" * len(m[0]), text.line[match.start("body") : end])
    lone = text.within(match.start("body"), end, "None")
    if STATEMENT.search(outside) is None or text.changed(lone) is None:
        return None
    written = text.source.line(text.number)
    body = written[match.start("body") : end].strip()
    return Slip("signs", "lambda_statement", text.number, written.strip(), body)


CLAUSES = re.compile(
    r"^[ \t]*try[ \t]*:[ \t]*(?P<body>\S.*?)[ \t;]+(?P<clause>(?:except|finally)\b[^:]*:)[ \t]*(?P<rest>.*?)[ \t]*$"
)


def _clauses_in_line(text: Broken) -> Slip | None:
    """Return a try with its except on one line."""
    match = CLAUSES.match(text.line)
    if match is None or re.search(r"\b(?:except|finally|else)\b", match["rest"]):
        return None
    indent, line, written = indent_of(text.line), text.source.newline, text.source.line(text.number)
    body, clause, rest = (written[slice(*match.span(part))] for part in ("body", "clause", "rest"))
    inside = f"{indent}    "
    rows = [f"{indent}try:", f"{inside}{body}", f"{indent}{clause}", f"{inside}{rest or 'pass'}"]
    start, end = text.source.start_of(text.number), text.source.end_of(text.number)
    new = text.changed(Splice(start, end, line.join(rows)))
    wanted = " / ".join(row.strip() for row in rows)
    return (
        Slip("signs", "clauses_in_line", text.number, written.strip(), wanted, new) if new else None
    )


AT_END = re.compile(r"(?:\"\"\"\"|'''')[ \t]*$")


def _quote_at_end(text: Broken) -> Slip | None:
    """Return a text in three quotes whose last sign is the same quote."""
    written = text.source.line(text.number)
    match = AT_END.search(written)
    if match is None or "unterminated" not in text.fault.text:
        return None
    at = match.start() + 1
    splice = text.within(at, at, " ")
    new = text.changed(splice)
    return text.slip("signs", "quote_at_end", written, splice, fixed=new) if new else None


OPENED = re.compile(r"(?P<quote>['\"])_*$")


def _other_quote(text: Broken) -> Slip | None:
    """Return a text that ends with another quote than it begins with, or on the next line."""
    told = text.fault.text
    match = OPENED.search(text.line)
    written = text.source.line(text.number)
    if match is None or not ("unterminated" in told or "EOL while" in told):
        return None
    quote, inside = match["quote"], written[match.end("quote") :]
    other = "'" if quote == '"' else '"'
    at = inside.rfind(other)
    if at >= 0:
        place = match.end("quote") + at
        splice = text.within(place, place + 1, quote)
        new = text.changed(splice)
        if new is not None:
            return text.slip("signs", "quote_other", written, splice, fixed=new)
    begin = _first_quote(text, match)
    if begin is not None:
        return begin
    below = text.source.line(text.number + 1)
    if below.count(quote) % 2 == 0 or len(below) > LONGEST:
        return None
    start, end = text.source.end_of(text.number), text.source.start_of(text.number + 1)
    blanks = len(written) - len(written.rstrip())
    entry = re.search(r"=\s*[\w.]+[.:]\s*$", written) or re.match(r"\s*[.:]\w", below)
    between = "" if entry else " "
    splice = Splice(start - blanks, end + len(indent_of(below)), between)
    new = text.changed(splice)
    if new is None:
        return None
    wanted = f"{written.strip()}{between}{below.strip()}"
    return Slip("signs", "text_two_lines", text.number, written.strip(), wanted, new,
                other=text.number + 1)  # fmt: skip


def _first_quote(text: Broken, match: re.Match[str]) -> Slip | None:
    """Return a text without its first quote, or an f-string without its last one."""
    written, quote = text.source.line(text.number), match["quote"]
    at = match.start("quote")
    word = re.search(r"[(,=][ \t]*(?P<word>[A-Za-z][\w./:-]*)$", text.line[:at])
    places = (
        [word.start("word")] if word is not None and not written[at + 1 :].strip(" \t,)]:") else []
    )
    inside = written[at + 1 :]
    if written[at - 1 : at] in ("f", "F") and "'" not in inside and '"' not in inside:
        ends = len(inside.rstrip(" \t,)"))
        whole = inside[:ends].count("{") == inside[:ends].count("}") > 0
        places = [at + 1 + ends] if whole and "+" not in inside else []
    for place in places:
        splice = text.within(place, place, quote)
        new = text.changed(splice)
        if new is not None:
            return text.slip("signs", "quote_exact", written, splice, fixed=new)
    return None


SIGNS = {"\u2192": "->", "\u21d2": "=>", "\u2260": "!=", "\u2264": "<=", "\u2265": ">=",
         "\u00d7": "*", "\u00f7": "/", "\u00b2": "**2", "\u00b3": "**3", "\u2217": "*", "\u2215": "/"}  # fmt: skip


def _character(text: Broken) -> Slip | None:
    """Return a sign that is on no English keyboard: what it stands for, or that it must go."""
    if (
        "invalid character" not in text.fault.text
        and "invalid non-printable" not in text.fault.text
    ):
        return None
    signs = [
        (at, sign)
        for at, sign in enumerate(text.line)
        if not sign.isascii() and not sign.isidentifier() and not f"a{sign}".isidentifier()
    ]
    splices = [text.within(at, at + 1, SIGNS.get(sign, "")) for at, sign in signs[:LONGEST]]
    new = text.changed(*splices) if splices else None
    if new is not None:
        written = text.source.line(text.number)
        variant = "character_for" if all(sign in SIGNS for _, sign in signs) else "character"
        return text.slip("signs", variant, written, *splices, fixed=new)
    if not signs:
        return None
    shown = text.source.line(text.number).strip()
    return Slip("signs", "character_note", text.number, shown, signs[0][1])


def _decorator(text: Broken) -> Slip | None:
    """Return a decorator above a line that is no def and no class."""
    above = next((n for n in range(text.number - 1, 0, -1) if text.code.line(n).strip()), 0)
    if not text.code.line(above).lstrip().startswith("@") or re.match(
        r"[ \t]*(?:@|class\b|def\b|async\b)", text.line
    ):
        return None
    head = re.match(r"[ \t]*(?=[A-Za-z_]\w*[ \t]*\([^()]*\)[ \t]*(?:->[^:]*)?:[ \t]*$)", text.line)
    if head is not None:
        splice = text.within(head.end(), head.end(), "def ")
        new = text.changed(splice)
        return text.slip("signs", "decorated_def", text.source.line(text.number), splice, fixed=new)
    shown = text.source.line(above).strip()
    deeper = len(indent_of(text.line)) > len(indent_of(text.code.line(above)))
    if deeper:
        return Slip("signs", "decorator_head", above, shown, "", other=text.number)
    new = text.source.spliced([text.source.without(above)])
    after = fault_of(new) if new is not None else text.fault
    return Slip("signs", "decorator", above, shown, "", new if after is None else None,
                other=text.number)  # fmt: skip


def _finally_first(text: Broken) -> Slip | None:
    """Return an except below the finally of the same try:."""
    width = len(indent_of(text.line))
    if re.match(r"[ \t]*(?:except|else)\b", text.line) is None:
        return None
    used = [n for n in range(text.number - 1, 0, -1) if text.code.line(n).strip()]
    first = next((n for n in used if len(indent_of(text.code.line(n))) <= width), 0)
    row = text.code.line(first)
    if len(indent_of(row)) != width or re.match(r"[ \t]*finally[ \t]*:", row) is None:
        return None
    last = text.number
    for number in range(text.number + 1, len(text.code.lines) + 1):
        line = text.code.line(number)
        if (
            line.strip()
            and len(indent_of(line)) <= width
            and not re.match(
                r"[ \t]*(?:except|else)\b", line[width:] if len(indent_of(line)) == width else ""
            )
        ):
            break
        last = number if line.strip() else last
    start, end = text.source.start_of(text.number), text.source.start_of(last + 1)
    moved = text.source.text[start:end]
    glue = "" if moved.endswith(("\n", "\r")) else text.source.newline
    place = text.source.start_of(first)
    new = text.source.spliced([Splice(place, place, moved + glue), Splice(start, end, "")])
    after = fault_of(new) if new is not None else text.fault
    shown = text.source.line(text.number).strip()
    fixed = new if after is None or (after.line or 0) > last else None
    return Slip("signs", "finally_first", text.number, shown, str(last), fixed, other=first)


def _clause_deeper(text: Broken) -> Slip | None:
    """Return an else or elif that is indented further than its if."""
    match = re.match(r"[ \t]*(?P<word>else|elif)\b", text.line)
    if match is None or "invalid syntax" not in text.fault.text:
        return None
    heads = "if|elif" if match["word"] == "elif" else "if|elif|for|while"
    own = width = len(indent_of(text.line))
    for number in range(text.number - 1, 0, -1):
        row = text.code.line(number)
        if not row.strip() or len(indent_of(row)) >= width:
            width = min(width, len(indent_of(row))) if row.strip() else width
            continue
        width = len(indent_of(row))
        if re.match(rf"[ \t]*(?:{heads})\b", row):
            return _dedented(text, number, own - width)
        if re.match(r"[ \t]*(?:def|class)\b", row):
            break
    return None


def _dedented(text: Broken, head: int, columns: int) -> Slip | None:
    own = len(indent_of(text.line))
    last = text.number
    while last < len(text.code.lines):
        row = text.code.line(last + 1)
        if row.strip() and len(indent_of(row)) <= own:
            break
        last += 1
    rows = [n for n in range(text.number, last + 1) if text.code.line(n).strip()]
    for lines in ([text.number], rows):
        starts = [text.source.start_of(n) for n in lines]
        new = text.changed(*(Splice(at, at + columns, "") for at in starts))
        if new is not None and fault_of(new) is None:
            shown = text.source.line(text.number).strip()
            variant = "clause_deeper" if len(lines) == 1 else "clause_deeper_block"
            word = text.line.split(":")[0].split()[0]
            return Slip("signs", variant, text.number, shown, word, new, other=head)
    return None


TYPED_LOOKS: tuple[Look, ...] = (
    _character, _finally_first, _clause_deeper, _decorator, _imports_joined, _lambda, _by_rule,
)  # fmt: skip
QUOTE_LOOKS: tuple[Look, ...] = (_quote_at_end, _clauses_in_line, _other_quote)
LATE_LOOKS: tuple[Look, ...] = (_colon_inside,)
