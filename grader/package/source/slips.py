"""What a beginner would call the error at which Python stops reading a file.

Python's own message names what it expected; a slip names what is there: a sign that was pasted
from a web page, a word of another language, a second comma.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from grader.package.edit.text import SourceText, Splice, read_source
from grader.package.source.broken_python import BLOCK, MOST_TRIES, Broken, Slip, fault_of
from grader.package.source.code_only import code_only
from grader.package.source.documents import document_of
from grader.package.source.pasted import cleaned, pasted_in
from grader.package.source.token_changes import change_of

TYPES = (
    "int|float|double|bool|boolean|string|String|var|let|const|auto|char|long|size_t|std::string"
)
HEAD = re.compile(
    rf"^[ \t]*(?:{BLOCK})\b[^\r\n{{}}]*?(?P<brace>[ \t]{{0,9}}:?[ \t]{{0,9}}\{{)[ \t]{{0,9}}$", re.M
)
CLOSER = re.compile(r"^[ \t]{0,80}\}[ \t]{0,9};?[ \t]{0,9}$", re.M)
MOST_BLOCKS = 50


def slip_of(found: bytes) -> Slip | None:
    """Return the slip at which Python stops reading a file; None if none is recognised."""
    source, fault = read_source(found), fault_of(found)
    if source is None or fault is None or fault.line is None:
        return None
    code = SourceText(code_only(source.text), source.encoding)
    text = Broken(source, code, fault, fault.line)
    return (
        document_of(found)
        or _answer(text)
        or _pasted(text)
        or next(filter(None, (look(text) for look in LOOKS)), None)
        or change_of(text)
        or _said(text)
    )


CONFLICT = re.compile(r"^(?:<{7}|={7}|>{7})(?: |$)")


def _conflict(text: Broken) -> Slip | None:
    """Return the first mark that git wrote where two versions of the file differ."""
    marks = [n for n, _ in enumerate(text.source.lines, 1) if CONFLICT.match(text.source.line(n))]
    if text.number not in marks:
        return None
    return Slip("document", "conflict", marks[0], text.source.line(marks[0]))


FENCE = re.compile(r"[ \t]{0,20}(?:```|~~~)[ \t]{0,9}[\w+-]{0,20}[ \t]*")


def _answer(text: Broken) -> Slip | None:
    """Return the text of a chat or a web page that stands above or below the code."""
    source = text.source
    fences = [n for n, _ in enumerate(source.lines, 1) if FENCE.fullmatch(source.line(n).rstrip())]
    first, last = (0, len(source.lines) + 1)
    if len(fences) == 2:
        first, last = fences
    elif len(fences) == 1:
        is_open = "def " not in _between(source, 0, fences[0])
        first, last = (fences[0], last) if is_open else (first, fences[0])
    code = _between(source, first, last)
    beside = (_between(source, 0, first), _between(source, last, len(source.lines) + 1))
    prose = any(fault_of(part.encode()) is not None for part in beside)
    prose = prose and not any("def " in part for part in beside)
    if not fences or not prose or "def " not in code or fault_of(code.encode()) is not None:
        return None
    splices = [
        Splice(0, source.start_of(first + 1), ""),
        Splice(source.start_of(last), len(source.text), ""),
    ]
    at = fences[0]
    lines = (str(last - 1), first + 1)
    return Slip(
        "pasted", "around", at, source.line(at).strip(), lines[0], source.spliced(splices), lines[1]
    )


def _between(source: SourceText, first: int, last: int) -> str:
    """Return the lines between two lines, without these."""
    return "".join(f"{source.line(n)}\n" for n in range(first + 1, last))


def _pasted(text: Broken) -> Slip | None:
    """Return the first thing that was pasted, if Python reads further without all of them."""
    found = pasted_in(text.source)
    new = cleaned(text.source, found) if found else None
    if new is None:
        return None
    after = fault_of(new)
    gone = sum(p.whole and p.line <= text.number for p in found)
    if after is not None and (after.line is None or after.line <= text.number - gone):
        return None
    at = next((p for p in found if p.line == text.number), found[0])
    return Slip("pasted", at.variant, at.line, at.found, fixed=new)


# other languages


@dataclass(frozen=True)
class Rule:
    """A sign of another language: its pattern in a line of code, and what Python has for it.

    `certain` patterns are never Python; of the others, Python must read further after the change.
    `new` is a template of `re.Match.expand`.
    """

    variant: str
    pattern: re.Pattern[str]
    new: str | None
    certain: bool = True


def _rule(variant: str, pattern: str, new: str | None, *, certain: bool = True) -> Rule:
    return Rule(variant, re.compile(pattern), new, certain)


RULES = (
    _rule("comment", r"//", "#", certain=False),
    _rule("comment", r"/\*(?P<text>.*)\*/[ \t]*$", r"#\g<text>", certain=False),
    _rule("increment", r"^(?P<start>[ \t]*[\w.]+)[ \t]*(?P<sign>[+-])(?P=sign)[ \t]*;?[ \t]*$",
          r"\g<start> \g<sign>= 1"),
    _rule("increment_inside", r"[\w)\]](?:\+\+|--)(?=[ \t]*[),;:\]]|[ \t]*$)", None),
    _rule("operator", r"[ \t]{0,9}&&[ \t]{0,9}", " and "),
    _rule("operator", r"[ \t]{0,9}\|\|[ \t]{0,9}", " or "),
    _rule("operator", r"(?<![\w)\]'\"])!(?!=)[ \t]*", "not "),
    _rule("elif", r"^(?P<start>[ \t]*)(?:else[ \t]+if|elseif|elsif)\b", r"\g<start>elif"),
    _rule("declaration", rf"^(?P<start>[ \t]*)(?:{TYPES})[ \t]+(?=[A-Za-z_][\w.]*[ \t]*=(?!=))",
          r"\g<start>"),
    _rule("this", r"\bthis[ \t]*(?:->|\.)[ \t]*(?=[A-Za-z_])", "self.", certain=False),
    _rule("function", r"^(?P<start>[ \t]*)(?:function|func|void|define)[ \t]+(?=\w+[ \t]*\()",
          r"\g<start>def "),
    _rule("new", r"\bnew[ \t]+(?=[A-Za-z_][\w.]*[ \t]*\()", ""),
    _rule("member", r"(?<=[\w)\]])[ \t]*(?:->|::)[ \t]*(?=[A-Za-z_])", ".", certain=False),
)  # fmt: skip


def _other_sign(text: Broken) -> Slip | None:
    for rule in RULES:
        matches = list(rule.pattern.finditer(text.line))[:MOST_TRIES]
        if not matches:
            continue
        sign = matches[0][0]
        if rule.new is None:
            return text.slip("language", rule.variant, sign)
        for splices in _ways(text, rule, matches):
            fixed = text.changed(*splices)
            if fixed is not None or rule.certain:
                return text.slip("language", rule.variant, sign, *splices, fixed=fixed)
    return None


def _ways(text: Broken, rule: Rule, matches: list[re.Match[str]]) -> Iterator[list[Splice]]:
    """Yield the changes to try: `//` divides before the last one, and a line can have all of
    `&&`, `||` and `!`.
    """
    if rule.variant == "comment" and rule.new in ("#", r"#\g<text>"):
        yield from ([_as_comment(text, match)] for match in reversed(matches))
        return
    alike = (
        [r for r in RULES if r.variant == rule.variant] if rule.variant == "operator" else [rule]
    )
    yield [
        text.within(*match.span(), text.expanded(match, other.new or ""))
        for other in alike
        for match in list(other.pattern.finditer(text.line))[:MOST_TRIES]
    ]


def _as_comment(text: Broken, match: re.Match[str]) -> Splice:
    """Return the splice that makes a Python comment, with the words as they are written."""
    start, end = match.span()
    written = text.source.line(text.number)[start:end]
    words = written[2:].rstrip().removesuffix("*/").rstrip() if written[1:2] == "*" else ""
    return text.within(start, end, f"#{words}")


def _braces(text: Broken) -> Slip | None:
    """Return braces around a block, of which Python stops at the first or at the last."""
    heads = list(HEAD.finditer(text.code.text))
    if not 0 < len(heads) <= MOST_BLOCKS:
        return None
    at = [h for h in heads if _line_at(text.code, h.start("brace")) == text.number]
    lone = list(CLOSER.finditer(text.code.text))
    ends = [_line_at(text.code, c.start()) for c in lone]
    splices = [Splice(*h.span("brace"), ":") for h in heads]
    new = None
    if len(heads) == len(lone):
        removed = [text.source.without(end) for end in ends]
        new = text.source.spliced([*splices, *removed])
        new = new if new is not None and fault_of(new) is None else None
    if new is None and not at and text.number not in ends:
        return None
    line = text.number if at else _line_at(text.code, heads[0].start("brace"))
    return Slip("language", "braces", line, text.source.line(line).strip(), "", new)


def _line_at(text: SourceText, position: int) -> int:
    part = text.text[:position]
    return part.count("\n") + part.count("\r") - part.count("\r\n") + 1


LOOKS: tuple[Callable[[Broken], Slip | None], ...] = (_conflict, _braces, _other_sign)
SAID = (
    (r"expected 'except' or 'finally' block", "try_alone"),
    (
        r"unterminated (?:triple-quoted|f-string: triple)|EOF while scanning triple",
        "text_without_end",
    ),
    (r"unterminated (?:f-)?string|EOL while scanning", "quote"),
    (r"'.' was never closed|does not match opening parenthesis", "bracket_open"),
    (r"expected an indented block", "block_missing"),
)
"""What Python says of a fault, and what is told of it."""


def _said(text: Broken) -> Slip | None:
    """Return what Python's own message says of the line."""
    variant = next((name for said, name in SAID if re.search(said, text.fault.text)), "")
    row = text.source.line(text.number).strip()
    return Slip("signs", variant, text.number, row) if variant else None
