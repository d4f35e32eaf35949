"""The smallest change of one line with which Python reads a file, or reads it further.

Each row of a table proposes changes of a line: insert, delete, replace or swap a token, or indent.
Python itself judges them: of those with which it reads the whole file, the cheapest is the answer.
If two that are as cheap give different programs, there is no answer.
"""

from __future__ import annotations

import ast
import keyword
import re
from collections.abc import Callable, Iterator
from itertools import pairwise

from grader.package.edit.text import indent_of
from grader.package.source.broken_python import LONGEST, Broken, Slip
from grader.package.source.line_indents import indents
from grader.package.source.python import PythonFault, can_parse, parse_python
from grader.package.source.text_changes import fields, quotes
from grader.package.source.token_line import PAIRS, TOKEN, Change, Line, Token, opened_in

MOST_CHANGES = 120
MOST_CHARACTERS = 30_000
"""The longest file that is read again for each change."""
FURTHER = 20.0
"""What a change costs more after which Python still stops, at a line below."""
MOST_FURTHER = FURTHER + 1.45
OPENERS = {close: opener for opener, close in PAIRS.items()}
VALUE = ("name", "number", "text", "close")
STARTS = {
    "import",
    "from",
    "def",
    "class",
    "return",
    "if",
    "for",
    "while",
    "try",
    "with",
    "pass",
    "self",
}
BEHIND_WORD = {
    "return",
    "in",
    "not",
    "and",
    "or",
    "is",
    "if",
    "else",
    "lambda",
    "import",
    "from",
    "as",
}


OF_BRACKETS = ("bracket_end", "bracket_extra", "bracket_kind", "opener_missing")
"""The changes that are only certain if Python then reads the whole file."""
Row = Callable[[Line], Iterator[Change]]


def change_of(text: Broken) -> Slip | None:
    """Return the smallest change with which Python reads a file; None if none is certain."""
    if len(text.source.text) > MOST_CHARACTERS:
        return None
    found: list[tuple[float, Change, bytes]] = []
    for number, change in enumerate(sorted(_changes(text), key=lambda one: one.cost)):
        if number >= MOST_CHANGES or (found and change.cost > found[0][0]):
            break
        new = text.changed(*change.splices)
        if new is not None and _makes_sense(new):
            further = FURTHER + (change.variant in OF_BRACKETS)
            cost = change.cost + (0 if _tree(new) is not None else further)
            found.append((cost, change, new))
            found.sort(key=lambda one: one[0])
    if not found or found[0][0] > MOST_FURTHER:
        return None
    cost, best, new = found[0]
    same = [one for one in found if one[0] == cost]
    if len({_tree(other) or other for _, _, other in same}) == 1:
        return _slip(text, best, new)
    told = {(one.variant, one.number, one.other) for _, one, _ in same}
    return _slip(text, best, None) if len(told) == 1 and best.other else None


def _tree(found: bytes) -> str | None:
    try:
        return ast.dump(parse_python(found).tree)
    except PythonFault:
        return None


def _makes_sense(found: bytes) -> bool:
    """Whether no statement of a class or of the file itself uses self."""
    if not can_parse(found):
        return True
    tree = parse_python(found).tree
    bodies = [tree.body, *(n.body for n in ast.walk(tree) if isinstance(n, ast.ClassDef))]
    plain = [
        s for body in bodies for s in body if isinstance(s, ast.Expr | ast.Assign | ast.AugAssign)
    ]
    used = {n.id for s in plain for n in ast.walk(s) if isinstance(n, ast.Name)}
    return not used & {"self", "super"}


def _slip(text: Broken, change: Change, new: bytes | None) -> Slip:
    source, number = text.source, change.number
    start, end = source.start_of(number), source.end_of(number)
    wanted = source.text[start:end]
    for splice in sorted(change.splices, key=lambda one: one.start, reverse=True):
        if start <= splice.start <= end:
            wanted = wanted[: splice.start - start] + splice.new + wanted[splice.end - start :]
    written = source.line(number).strip()
    variant = change.variant if wanted.strip() else "line_extra"
    return Slip("signs", variant, number, written, wanted.strip(), new, change.other)


def _changes(text: Broken) -> Iterator[Change]:
    yield from indents_of(text)
    for far, number in enumerate(_near(text)):
        line = _line(text, number)
        if line is not None:
            for row in ROWS:
                for one in row(line):
                    yield Change(one.variant, one.cost + 0.6 * far, number, one.splices, one.other)


def indents_of(text: Broken) -> Iterator[Change]:
    """Yield other indentations of the line at which Python stops."""
    for variant, cost, number, splices, other in indents(text):
        yield Change(variant, cost, number, splices, other)


def _near(text: Broken) -> Iterator[int]:
    """Yield the line at which Python stops, and the line of code above it."""
    yield text.number
    for number in range(text.number - 1, 0, -1):
        if text.code.line(number).strip():
            yield number
            return


def _line(text: Broken, number: int) -> Line | None:
    code = text.code.line(number)
    if not code.strip() or len(code) > LONGEST:
        return None
    tokens = tuple(
        Token(match.lastgroup or "", match[0], match.start(), match.end())
        for match in TOKEN.finditer(code)
    )
    return Line(text, number, code, tokens, opened_in(text.code.text[: text.code.start_of(number)]))


# the rows of the table


def _colon(line: Line) -> Iterator[Change]:
    """A line that begins a block ends with a colon."""
    end = len(line.code.rstrip())
    if line.is_head:
        yield line.change("colon_missing", 1, (end, end, ":"))
        for sign in (";", ",", ".", "{", "=", ": {", ":{", " {", "-"):
            if line.code[:end].endswith(sign):
                yield line.change("colon_missing", 0.9, (end - len(sign), end, ":"))
        for before, behind in pairwise(line.tokens):
            inside = opened_in(line.code[: behind.start])
            if before.kind in VALUE and behind.kind in VALUE and not inside:
                yield line.change("colon_inside", 3.5, (before.end, before.end, ":"))
    elif line.code[:end].endswith(":"):
        yield line.change("colon_extra", 1, (end - 1, end, ""))


def _closers(line: Line) -> Iterator[Change]:
    """A bracket of the line is not closed, at its end or before a sign that ends it."""
    opened = opened_in(line.code)
    missing = "".join(PAIRS[sign] for sign in reversed(opened))
    end = len(line.code.rstrip())
    inner = end - 1 if line.code[:end].endswith((":", ",")) else end
    if line.tokens and line.tokens[-1].kind == "open":
        return
    for count in range(1, len(missing) + 1):
        yield line.change(
            "bracket_end", 1 + 0.1 * (len(missing) - count), (inner, inner, missing[:count])
        )
        if inner < end:
            yield line.change("bracket_end", 1.3, (end, end, missing[:count]))
    for token in line.tokens if missing else ():
        if token.text in (",", "+", ":") or token.kind == "close":
            yield line.change("bracket_end", 2.5, (token.start, token.start, missing[0]))
    for before, behind in pairwise(line.tokens):
        if before.kind == "open" and behind.text == ".":
            yield line.change("bracket_end", 0.9, (before.end, before.end, PAIRS[before.text]))
    if line.opened and not opened:
        close = PAIRS[line.opened[-1]]
        yield line.change("bracket_end", 2, (inner, inner, close))


def _brackets(line: Line) -> Iterator[Change]:
    """A bracket is too much, of another kind, or has no first one."""
    for far, token in enumerate(reversed(line.tokens)):
        twice = token.text * 2 in (
            line.code[token.start : token.end + 1],
            line.code[token.start - 1 : token.end],
        )
        if token.kind == "close" and (twice or len(line.tokens) == 1):
            yield line.change("bracket_extra", 1.5 + 0.01 * far, (token.start, token.end, ""))
        if token.text in ("]", "}"):
            yield from _opener(line, token)
        if token.kind in ("open", "close"):
            same = PAIRS if token.kind == "open" else OPENERS
            for other in same:
                if other != token.text:
                    yield line.change("bracket_kind", 1.8, (token.start, token.end, other))
        if token.kind == "open" and twice:
            yield line.change("bracket_extra", 0.9, (token.start, token.end, ""))


DEFINES = ("def", "class")


def _heads(line: Line) -> Iterator[Change]:
    """The brackets of a def or a call are missing, or the first of them."""
    for before, behind in pairwise(line.tokens):
        fits = before.text[:1].islower() == (line.first == "def")
        if fits and line.first in DEFINES and before.kind == "name" and behind.text == ":":
            own = "(self)" if line.first == "def" and line.code[:1] == " " else "()"
            yield line.change("def_brackets", 1.2, (before.end, behind.start, own))
        if before.kind == "name" and behind.kind in VALUE and before.end < behind.start:
            yield from _call(line, before, behind)
    for name in line.tokens[1:2] if line.first in DEFINES and "(" not in line.code else ():
        for word in ("self", "Node", "args"):
            if name.text.endswith(word) and name.text != word:
                at = name.end - len(word)
                yield line.change("opener_missing", 1.3, (at, at, "("))


CALLED = ("print", "str", "int", "float", "exec", "range", "len")


def _call(line: Line, name: Token, value: Token) -> Iterator[Change]:
    """The brackets of a call are missing, or the first of them."""
    code, end = line.code, len(line.code.rstrip())
    if keyword.iskeyword(name.text) or keyword.iskeyword(value.text):
        return
    if code.count(")") > code.count("("):
        yield line.change("opener_missing", 1.2, (name.end, value.start, "("))
    elif name.text in CALLED and ":" not in code[: name.start]:
        if name is not line.tokens[0]:
            match = re.compile(r"[\w.]+").match(code, value.start)
            end = match.end() if match else value.end
        yield line.change("call_brackets", 1, (name.end, value.start, "("), (end, end, ")"))
    elif (
        not (line.opened or keyword.iskeyword(line.first))
        and "=" not in code
        and "." in code[: name.end]
    ):
        yield line.change("call_brackets", 1.5, (name.end, value.start, "("), (end, end, ")"))


def _opener(line: Line, close: Token) -> Iterator[Change]:
    """The first bracket of a value is missing: behind a sign before the one that closes it."""
    for far, before in enumerate(reversed(line.tokens)):
        if before.end <= close.start and before.text in ("=", ","):
            start = before.end + (line.code[before.end : before.end + 1] == " ")
            sign = (start, start, OPENERS[close.text])
            yield line.change("opener_missing", 1.6 + 0.1 * far, sign)
            return


UNITS = ("s", "ms", "us", "ns", "sec", "secs", "seconds", "Hz", "hz")
LONG_NAME = 10


def _between(line: Line) -> Iterator[Change]:
    """A comma, a plus, a dot or an = is missing between two values."""
    end = len(line.code.rstrip())
    if line.tokens and line.tokens[-1].kind in VALUE and line.opened + opened_in(line.code):
        yield line.change("comma_at_end", 1.2, (end, end, ","))
    for number, (before, behind) in enumerate(pairwise(line.tokens)):
        if before.kind not in VALUE or behind.kind not in VALUE[:3]:
            continue
        if keyword.iskeyword(before.text) or keyword.iskeyword(behind.text):
            continue
        if before.kind == "text" and before.end == behind.start and behind.kind == "name":
            continue
        if before.text in ("f", "F", "r", "b") and behind.kind == "text":
            yield line.change("prefix_apart", 0.9, (before.end, behind.start, ""))
        elif before.kind == "number" and behind.text in UNITS:
            continue
        elif line.first == "except" and len(behind.text) < LONG_NAME and behind.text.islower():
            yield line.change("handler_as", 1, (before.end, behind.start, " as "))
        elif line.first in ("from", "import"):
            yield line.change("import_names", 1.6, (before.end, before.end, ","))
        elif line.first in ("if", "elif", "while") and not opened_in(line.code[: behind.start]):
            yield line.change("one_equals", 1.6, (before.end, behind.start, " == "))
        elif line.first == "def" and opened_in(line.code[: behind.start]):
            yield line.change("comma_missing", 1.6, (before.end, before.end, ","))
        elif line.first not in ("except", "for", "def", "class", "with", "print"):
            yield from _missing(line, number, before, behind)


def _missing(line: Line, number: int, before: Token, behind: Token) -> Iterator[Change]:
    """What can be missing between two values of an expression."""
    inside = line.opened + opened_in(line.code[: behind.start])
    follows = line.code[behind.end :].lstrip()
    named = follows.startswith("=") and not follows.startswith("==")
    if inside.endswith("{") and before.kind == "text" and not follows.startswith(":"):
        yield line.change("colon_key", 1.2, (before.end, before.end, ":"))
        return
    text = (before.kind == "text") != (behind.kind == "text")
    adds = text and not named and not (inside and "," in line.code) and before.text not in CALLED
    folder = line.broken.source.line(line.number)[before.end - 2 : before.end - 1] == "/"
    adds = adds or (before.kind == "text" and folder and not named)
    comma = not adds or (not folder and inside.endswith("["))
    if inside and before.text not in CALLED:
        yield line.change("comma_missing", 1.6 if comma else 2.4, (before.end, before.end, ","))
    if adds:
        a_number = "number" in (before.kind, behind.kind)
        sign = (before.end, behind.start, " + ")
        yield line.change("plus_missing", 2.6 if a_number else 1.6, sign)
    names = all(one.kind == "name" or one.text == "." for one in line.tokens[: number + 1])
    if names and not inside and "=" not in line.code and not follows.startswith("("):
        yield line.change("equals_missing", 1.5, (before.end, behind.start, " = "))
        if behind.kind == "number":
            yield line.change("equals_missing", 1.5, (before.end, behind.start, " += "))
    elif inside and named is False and before.kind == "name" and behind.kind == "text":
        yield line.change("equals_missing", 2.5, (before.end, behind.start, "="))
    if behind.kind == "name" and (before.end == behind.start or before.text in ("self", "rclpy")):
        yield line.change("dot_missing", 1.2, (before.end, behind.start, "."))


def _signs(line: Line) -> Iterator[Change]:
    """A sign is too much, another one, or in two parts."""
    for before, behind in pairwise(line.tokens):
        parts = before.text + behind.text
        if parts in OPERATORS and before.end < behind.start:
            yield line.change("operator_split", 1, (before.start, behind.end, parts))
        if parts in ("=<", "=>") and line.first in ("if", "elif", "while", "return"):
            yield line.change("operator_swapped", 1.2, (before.start, behind.end, parts[::-1]))
        if before.text == behind.text and before.kind == "sign":
            yield line.change("sign_extra", 1, (behind.start, behind.end, ""))
        if before.kind in ("open", "sign") and behind.text == ",":
            yield line.change("sign_extra", 1.1, (behind.start, behind.end, ""))
        if before.text == "." and (behind.text == "(" or behind.kind == "sign"):
            yield line.change("sign_extra", 1.5, (before.start, before.end, ""))
    for number, token in enumerate(line.tokens):
        for other, variant, cost in _other(line, number, token):
            yield line.change(variant, cost, (token.start, token.end, other))
    last = line.tokens[-1] if line.tokens else None
    if last is not None and last.text in ",.;":
        yield line.change("sign_extra", 1.8, (last.start, last.end, ""))


OPERATORS = ("+=", "-=", "*=", "/=", "==", "!=", "<=", ">=", "->")


def _other(line: Line, number: int, token: Token) -> Iterator[tuple[str, str, float]]:
    """Yield the signs that a sign can have been meant as."""
    inside = line.opened + opened_in(line.code[: token.start])
    blank = line.code[token.end : token.end + 1] == " "
    before = line.tokens[number - 1] if number else None
    imports = line.first in ("from", "import")
    if token.text == "=" and line.first in ("if", "elif", "while", "assert") and not inside:
        yield "==", "one_equals", 1
    if token.text == "=" and inside.endswith("{"):
        yield ":", "colon", 1.4
    if token.text in (":", ":=") and inside.endswith("(") and before and before.kind == "name":
        yield "=", "sign_other", 1.4
    if token.text in ("==", ":=") and not inside and number and line.first not in ("if", "while"):
        yield "=", "sign_other", 1.4
    if token.text == ";" and inside.endswith("("):
        yield ",", "sign_other", 1.2
    last = token is line.tokens[-1]
    if token.text == "." and (blank or last) and inside:
        yield ",", "sign_other", 1.4
    if token.text == "," and not blank and before and before.text == "self":
        yield ".", "sign_other", 1.4
    behind = "" if last else line.tokens[number + 1].text
    if token.text == "," and line.first == "except" and behind.islower() and blank:
        yield " as", "handler_as", 1
    if token.text == "/" and imports:
        yield ".", "sign_other", 1


ENTRY = re.compile(r"[ \t]*(?P<text>[\w-]+[ \t]*=[ \t]*[\w.]+:\w+)[ \t]*,?[ \t]*$")
KEY = re.compile(r"[ \t]*(?P<key>['\"]_+['\"])[ \t]*:")


def _setup(line: Line) -> Iterator[Change]:
    """An entry has no quotes, or an argument is written as a key of a dict."""
    entry, key = ENTRY.match(line.code), KEY.match(line.code)
    quote = line.broken.source.quote
    if entry is not None and line.opened.endswith("["):
        start, end = entry.span("text")
        yield line.change("text_unquoted", 1, (start, start, quote), (end, end, quote))
    if key is not None and line.opened.endswith("("):
        start, end = key.span("key")
        name = line.broken.source.line(line.number)[start + 1 : end - 1]
        yield line.change("equals", 1, (start, key.end(), f"{name}="))


def _words(line: Line) -> Iterator[Change]:
    """A word of Python is misspelt, or stands in capitals."""
    for far, token in enumerate(line.tokens):
        if token.kind != "name" or keyword.iskeyword(token.text):
            continue
        for word in _words_like(token.text):
            if far == 0 or word in BEHIND_WORD:
                yield line.change(
                    "word_misspelt", 1 if far == 0 else 1.4, (token.start, token.end, word)
                )
        for word in ("def", "class", "import", "from", "return", "else", "if", "self"):
            rest = token.text.removeprefix(word)
            if far == 0 and rest and rest != token.text:
                yield line.change("word_joined", 1.5, (token.start, token.end, f"{word} {rest}"))
    first = line.tokens[0] if line.tokens else None
    begins = not line.opened and line.code.rstrip().endswith(":")
    if first is not None and begins and first.kind == "name":
        yield line.change("def_missing", 1.4, (first.start, first.start, "def "))


def _words_like(name: str) -> Iterator[str]:
    for word in (*keyword.kwlist, "match"):
        if (name != word and name.lower() == word.lower()) or (
            min(len(name), len(word)) > 1 and _one_letter_apart(name.lower(), word.lower())
        ):
            yield word


def _one_letter_apart(one: str, other: str) -> bool:
    """Whether a letter is missing, too much or another, or two are swapped."""
    start = next(
        (n for n, (a, b) in enumerate(zip(one, other)) if a != b), min(len(one), len(other))
    )
    a, b = one[start:], other[start:]
    return one != other and (
        a[1:] == b or a == b[1:] or a[1:] == b[1:] or (a[:2] == b[:2][::-1] and a[2:] == b[2:])
    )


def _statements(line: Line) -> Iterator[Change]:
    """Two statements are in one line."""
    if line.opened or line.is_head:
        return
    for before, behind in pairwise(line.tokens):
        starts = behind.text in STARTS or (before.kind == "close" and behind.kind == "name")
        if before.kind in VALUE and starts and not opened_in(line.code[: behind.start]):
            break_ = f"\n{indent_of(line.code)}"
            yield line.change("two_statements", 1.9, (before.end, behind.start, break_))


ROWS: tuple[Row, ...] = (
    _colon, _closers, _brackets, _heads, _setup, _between, _signs, _words, quotes, fields, _statements,
)  # fmt: skip
