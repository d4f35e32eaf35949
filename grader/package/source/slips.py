"""What a beginner would call the error at which Python stops reading a file.

Python's own message names what it expected; a slip names what is there: a sign that was pasted
from a web page, a word of another language, a second comma.
"""

from __future__ import annotations

import keyword
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from grader.package.edit.text import SourceText, Splice, read_source
from grader.package.source.broken_python import BLOCK, LONGEST, MOST_TRIES, Broken, Slip, fault_of
from grader.package.source.code_only import code_only
from grader.package.source.documents import document_of
from grader.package.source.pasted import WHOLE_LINES, cleaned, pasted_in
from grader.package.source.token_changes import change_of

TYPES = (
    "int|float|double|bool|boolean|string|String|var|let|const|auto|char|long|size_t|std::string"
)
HEAD = re.compile(
    rf"^[ \t]*(?:{BLOCK})\b[^\r\n{{}}]*?(?P<brace>[ \t]{{0,9}}:?[ \t]{{0,9}}\{{)[ \t]{{0,9}}$", re.M
)
CLOSER = re.compile(r"^[ \t]{0,80}\}[ \t]{0,9};?[ \t]{0,9}$", re.M)
MODIFIERS = "private|public|protected|static|final|const|constexpr|readonly|volatile"
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
        or _shebang(text)
        or _answer(text)
        or _pasted(text)
        or next(filter(None, (look(text) for look in LOOKS)), None)
        or change_of(text)
        or _said(text)
    )


SHEBANG = "#!/usr/bin/env python3"
LIKE_SHEBANG = re.compile(
    r"[^\w\s#]{0,3}[ \t]?#?[ \t]?!?[ \t]?/?(?:usr|bin)/[\w/ .]{0,80}python[\d.]{0,6}\s*"
)


def _shebang(text: Broken) -> Slip | None:
    """Return a first line that was meant as a shebang and does not begin with #."""
    line = text.source.line(1)
    if text.number != 1 or line.startswith("#") or LIKE_SHEBANG.fullmatch(line) is None:
        return None
    start = text.source.start_of(1)
    new = text.source.spliced([Splice(start, start + len(line), SHEBANG)])
    return Slip("shebang", "first_sign", 1, line.strip(), SHEBANG, new)


CONFLICT = re.compile(r"^(?:<{7}|={7}|>{7})(?: |$)")


def _conflict(text: Broken) -> Slip | None:
    """Return the first mark that git wrote where two versions of the file differ."""
    marks = [n for n, _ in enumerate(text.source.lines, 1) if CONFLICT.match(text.source.line(n))]
    if len(marks) == 1 and text.number == marks[0]:
        new = text.changed(text.source.without(marks[0]))
        return Slip("document", "conflict_rest", marks[0], text.source.line(marks[0]), "", new)
    if len(marks) < 2 or text.number not in marks:
        return None
    last = str(marks[min(2, len(marks) - 1)])
    return Slip("document", "conflict", marks[0], text.source.line(marks[0]), "", other=int(last))


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


PROSE = re.compile(r"[A-Z][a-z']{0,30}(?:,? [\w'`-]{1,40}){3,40}[.:!]?")


def _prose(text: Broken) -> Slip | None:
    """Return a sentence at the margin that is no code."""
    written = text.source.line(text.number).rstrip()
    if PROSE.fullmatch(written) is None or written.split()[0].lower() in keyword.kwlist:
        return None
    new = text.source.spliced([text.source.without(text.number)])
    return Slip("pasted", "prose", text.number, written, fixed=new)


NUMBER = r"[ \t]*\d{1,4}"
CODE = r"(?=[A-Za-z_#@ \t'\"]|$)"
NUMBERED = tuple(
    re.compile(f"{NUMBER}{between}{CODE}")
    for between in (r"(?:[.:|][ \t]?|[ \t])", r"[.:| \t][ \t]?")
)
"""A line number, and what is between it and the code: as little as possible."""


def _numbers(text: Broken) -> Slip | None:
    """Return line numbers that were pasted with the code."""
    found = (_numbers_before(text, pattern) for pattern in NUMBERED)
    return next(filter(None, found), None)


def _numbers_before(text: Broken, pattern: re.Pattern[str]) -> Slip | None:
    at = [n for n, _ in enumerate(text.source.lines, 1) if pattern.match(text.code.line(n))]
    if text.number not in at:
        return None
    splices = []
    for number in at:
        match = pattern.match(text.source.line(number))
        start = text.source.start_of(number)
        splices.append(Splice(start, start + (match.end() if match else 0), ""))
    new = text.changed(*splices)
    if new is None:
        return None
    match = pattern.match(text.line)
    return Slip("pasted", "numbers", text.number, (match[0] if match else "").strip(), fixed=new)


def _pasted(text: Broken) -> Slip | None:
    """Return the first thing that was pasted, if Python reads further without all of them."""
    found = pasted_in(text.source)
    new = cleaned(text.source, found) if found else None
    if new is None:
        return None
    after = fault_of(new)
    gone = sum(p.variant in WHOLE_LINES and p.line <= text.number for p in found)
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


COMMENTS = (
    _rule("comment", r"//", "#", certain=False),
    _rule("comment", r"/\*(?P<text>.*)\*/[ \t]*$", r"#\g<text>", certain=False),
    _rule("comment", r"^[ \t]*/\*", None),
    _rule(
        "comment",
        r"(?P<start>[ \t]);[ \t]*(?=[A-Za-z]+[ \t]+[A-Za-z])",
        r"\g<start># ",
        certain=False,
    ),
    _rule("comment", r"^(?P<start>[ \t]*)--[ \t]*(?=\w)", r"\g<start># ", certain=False),
    _rule(
        "comment",
        r"(?P<start>^[ \t]*|[ \t]{2,})%[ \t]*(?=[A-Za-z]+[ \t]+[A-Za-z])",
        r"\g<start># ",
        certain=False,
    ),
)
RULES = (
    _rule("increment", r"^(?P<start>[ \t]*[\w.]+)[ \t]*(?P<sign>[+-])(?P=sign)[ \t]*;?[ \t]*$",
          r"\g<start> \g<sign>= 1"),
    _rule("increment_inside", r"[\w)\]](?:\+\+|--)(?=[ \t]*[),;:\]]|[ \t]*$)", None),
    _rule("compare", r"(?P<sign>[=!])==", r"\g<sign>="),
    _rule("compare", r"<>", "!="),
    _rule("operator", r"[ \t]{0,9}&&[ \t]{0,9}", " and "),
    _rule("operator", r"[ \t]{0,9}\|\|[ \t]{0,9}", " or "),
    _rule("operator", r"(?<![\w)\]'\"])!(?!=)[ \t]*", "not "),
    _rule("elif", r"^(?P<start>[ \t]*)(?:else[ \t]+if|elseif|elsif)\b", r"\g<start>elif"),
    _rule("declaration", rf"^(?P<start>[ \t]*)(?:(?:{MODIFIERS})[ \t]+)*(?:(?:{TYPES}|{MODIFIERS})[ \t]+)(?=[A-Za-z_][\w.]*[ \t]*=(?!=))",
          r"\g<start>"),
    _rule("then", r"^(?P<start>[ \t]*(?:if|elif|while|for)\b.*?)[ \t]+(?:then|do)[ \t]*:?[ \t]*$",
          r"\g<start>:", certain=False),
    _rule("comment", r"(?P<start>[ \t])%[ \t]+(?=[A-Za-z]+(?:[ \t]+[A-Za-z]+){2})", r"\g<start># ", certain=False),
    _rule("this", r"\bthis[ \t]*(?:->|\.)[ \t]*(?=[A-Za-z_])", "self.", certain=False),
    _rule("function", r"^(?P<start>[ \t]*)(?:(?:public|private|static|async)[ \t]+)?"
          r"(?:function|func|fn|fun|void|sub|define|defn)[ \t]+(?=\w+[ \t]*\()", r"\g<start>def "),
    _rule("new", r"\bnew[ \t]+(?=[A-Za-z_][\w.]*[ \t]*\()", ""),
    _rule("import", r"^(?P<start>[ \t]*)import[ \t]+(?P<what>[\w, \t*]+?)[ \t]+from[ \t]+(?P<module>[\w.]+)",
          r"\g<start>from \g<module> import \g<what>"),
    _rule("base", r"^(?P<start>[ \t]*class[ \t]+\w+)[ \t]*(?:\[(?P<in>[\w., ]*)\]|<(?P<less>[\w., ]*)>)",
          r"\g<start>(\g<in>\g<less>)"),
    _rule("base", r"^(?P<start>[ \t]*class[ \t]+\w+)[ \t]*(?:(?:extends|inherits|implements|from)[ \t]+|:[ \t]*(?:public[ \t]+)?)(?P<base>\w[\w.]*)[ \t]*:?[ \t]*$",
          r"\g<start>(\g<base>):"),
    _rule("member", r"(?<=\w)[ \t]*->[ \t]*(?!(?:self|this)\b)(?=[A-Za-z_])", "."),
    _rule("member", r"(?<=[)\]])[ \t]*->[ \t]*(?!(?:self|this)\b)(?=[A-Za-z_])", ".", certain=False),
    _rule("member", r"(?<=[\w)])::(?=[A-Za-z_])", ".", certain=False),
    _rule("except", r"^[ \t]*(?:\}[ \t]*)?catch\b", None),
    _rule("function", r"^(?P<start>[ \t]*)(?P<name>\w+)[ \t]*=[ \t]*\((?P<given>[^()]*)\)[ \t]*=>[ \t]*\{?[ \t]*$",
          r"\g<start>def \g<name>(\g<given>):", certain=False),
    _rule("arrow", r"=>", None),
    _rule("choice", r"\?", None),
    _rule("backtick", r"`", None),
    _rule("assign", r"^(?P<start>[ \t]*[A-Za-z_][\w.]*[ \t]*):=", r"\g<start>="),
)  # fmt: skip


def _comment(text: Broken) -> Slip | None:
    return _by_rules(text, COMMENTS)


def _other_sign(text: Broken) -> Slip | None:
    return _by_rules(text, RULES)


def _by_rules(text: Broken, rules: tuple[Rule, ...]) -> Slip | None:
    for rule in rules:
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


# commas, colons and quotes


APOSTROPHE = re.compile(r"(?<=[\w})])'(?=\w|[ \t]+\w)")
AFTER_TEXT = re.compile(r"[ \t]*(?:[,)\]}:+%#.;]|$)")
PREFIX = re.compile(r"(?:\b[fFrRbBuU]{1,2}|(?<!\w))\Z")


def _apostrophe(text: Broken) -> Slip | None:
    """Return a text in single quotes that an apostrophe ends."""
    written = text.source.line(text.number)
    if len(written) > LONGEST:
        return None
    places = [match.start() for match in re.finditer("'", written)][: 2 * MOST_TRIES]
    for start, opened in enumerate(places):
        if PREFIX.search(written[:opened]) is None:
            continue
        for count, closed in enumerate(places[start + 1 :]):
            inside = written[opened + 1 : closed]
            if count == 0 or '"' in inside or AFTER_TEXT.match(written, closed + 1) is None:
                continue
            if len(APOSTROPHE.findall(inside)) != count:
                continue
            splices = [text.within(at, at + 1, '"') for at in (opened, closed)]
            new = text.changed(*splices)
            if new is not None:
                return text.slip("signs", "apostrophe", written, *splices, fixed=new)
    return None


LOOKS: tuple[Callable[[Broken], Slip | None], ...] = (
    _conflict, _prose, _numbers, _braces, _comment, _apostrophe, _other_sign,
)  # fmt: skip
SAID = (
    (r"'(break|continue)' (?:outside loop|not properly in loop)", "loop_word"),
    (
        r"(?:assigned to|used prior to|used or assigned).* (?:global|nonlocal) declaration",
        "global_late",
    ),
    (r"name '(\w+)' is parameter and (?:global|nonlocal)", "global_parameter"),
    (r"(?:no binding for nonlocal '\w+'|nonlocal declaration not allowed)", "nonlocal"),
    (r"'(return|yield)' outside function", "outside_function"),
    (r"'(?:await|async \w+)' outside", "await_outside"),
    (r"positional argument follows keyword", "argument_order"),
    (r"keyword argument repeated: (\w+)", "argument_twice"),
    (r"duplicate argument '(\w+)' in function", "parameter_twice"),
    (r"(?:non-default argument|parameter without a default) follows", "parameter_order"),
    (r"invalid decimal literal", "number_letters"),
    (r"leading zeros in decimal", "number_zeros"),
    (r"\(unicode error\)", "backslash"),
    (r"expected 'except' or 'finally' block", "try_alone"),
    (
        r"unterminated (?:triple-quoted|f-string: triple)|EOF while scanning triple",
        "text_without_end",
    ),
    (r"unterminated (?:f-)?string|EOL while scanning", "quote"),
    (r"f-string: (?:valid|empty) expression", "field_empty"),
    (r"f-string", "brace_wrong"),
    (r"unmatched '(.)'", "bracket_alone"),
    (r"'.' was never closed|does not match opening parenthesis", "bracket_open"),
    (r"expected an indented block", "block_missing"),
    (r"Missing parentheses in call to '(\w+)'", "call_of_word"),
    (r"cannot contain assignment", "call_assigns"),
    (r"':' expected after dictionary key", "key_alone"),
    (r"expression expected after dictionary key", "value_missing"),
    (r"unexpected character after line continuation", "backslash_alone"),
    (r"default 'except:' must be last", "except_last"),
    (r"import \* only allowed at module level", "import_star"),
    (r"Generator expression must be parenthesized", "generator"),
    (r"multiple exception types must be parenthesized", "handler_types"),
)
"""What Python says of a fault, and what is told of it."""


def _said(text: Broken) -> Slip | None:
    """Return what Python's own message says of the line."""
    for pattern, variant in SAID:
        match = re.search(pattern, text.fault.text)
        if match is not None:
            wanted = match[1] if match.re.groups else ""
            shown = text.source.line(text.number).strip()
            return Slip("signs", variant, text.number, shown, wanted)
    return None
