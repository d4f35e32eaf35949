"""A line that is indented further than its block, and why: what opens no block above it."""

from __future__ import annotations

import ast
import re
from bisect import bisect_left
from dataclasses import dataclass
from functools import lru_cache

from grader.package.edit.text import Splice, indent_of
from grader.package.source.broken_python import BLOCK, Broken, Slip
from grader.package.source.python import PythonFault, can_parse, parse_python
from grader.package.source.slip_try import EXPECTED, try_above

HEAD = re.compile(rf"[ \t]*(?:async[ \t]+)?(?P<word>{BLOCK})\b")
DEF = re.compile(r"[ \t]*(?:@|(?:async[ \t]+)?def\b|class\b)")
COMMENTED = re.compile(
    rf"(?P<start>[ \t]*)#+[ \t]?(?P<code>[ \t]*(?:{BLOCK})\b[^#]*:)[ \t]*(?:#.*)?"
)
EXTRA = "unexpected indent"
NOTHING = ("pass", "...")
TRIPLE = re.compile(r"\"\"\"|'''")
OPEN, CLOSE = "([{", ")]}"


@dataclass(frozen=True)
class Above:
    """The statement above the line at which Python stops: its first line, and what contains it."""

    line: int
    starts_line: bool
    around: ast.AST


def behind_colon(text: Broken) -> Slip | None:
    """Return a line that has its block behind the colon, with more lines of the block below it."""
    above = _above(text) if any(known in text.fault.text for known in (EXTRA, EXPECTED)) else None
    if above is None or above.starts_line or not _is_further(text, above.line):
        return None
    head = text.code.line(above.line)
    match = HEAD.match(head)
    colon = _colon_of(head)
    if match is None or colon < 0 or (match["word"] == "def" and DEF.match(text.line)):
        return None
    start, row = text.source.start_of(above.line), text.source.line(above.line)
    behind = colon + 1 + len(head[colon + 1 :]) - len(head[colon + 1 :].lstrip())
    body = row[behind : len(head.rstrip())].rstrip()
    lines = (text.source.line(n).strip() for n in range(above.line + 1, text.number))
    wanted = " ".join([body, *(line for line in lines if line and line[0] != "#")])
    indent = indent_of(text.source.line(text.number))
    moved = Splice(start + colon + 1, start + behind, text.source.newline + indent)
    variant = "behind_colon"
    if wanted in NOTHING:
        moved = Splice(start + colon + 1, start + len(head.rstrip()), "")
        variant = "behind_colon_nothing"
    new = text.changed(moved)
    if new is None:
        return None
    return Slip("signs", variant, above.line, row.strip(), wanted, new, other=text.number)


def further_in(text: Broken) -> Slip | None:
    """Return what is wrong with a line that is indented further than the block above it."""
    if EXTRA not in text.fault.text or "\t" in indent_of(text.source.line(text.number)):
        return None
    above = _above(text)
    if above is None:
        return _first_line(text)
    if not _is_further(text, above.line):
        return None
    return _commented(text, above) or _without_def(text, above) or _too_far(text, above)


def _is_further(text: Broken, line: int) -> bool:
    """Whether the line at which Python stops is indented further than another one."""
    own, other = (indent_of(text.source.line(n)) for n in (text.number, line))
    return own.startswith(other) and own != other


def _above(text: Broken) -> Above | None:
    """Return the innermost statement that ends on the line of code above."""
    rows = text.source.lines[: text.number - 1]
    last = next((n for n in range(len(rows), 0, -1) if text.code.line(n).strip()), 0)
    tree = _parsed(text, rows, None) or _parsed(text, rows, try_above(text))
    if not last or tree is None:
        return None
    found: Above | None = None
    for parent in ast.walk(tree):
        for child in ast.iter_child_nodes(parent):
            if isinstance(child, ast.stmt) and child.end_lineno == last:
                starts = not text.code.line(child.lineno)[: child.col_offset].strip()
                found = Above(child.lineno, starts, parent)
    return found


def _parsed(text: Broken, rows: list[str], opened: int | None) -> ast.Module | None:
    """Return the code above the line; a try: whose except would be below it is made another block."""
    if opened is not None:
        row = text.source.line(opened)
        new = re.sub(r"^([ \t]*)try\b", r"\1if 1", row)
        rows = [*rows[: opened - 1], rows[opened - 1].replace(row, new), *rows[opened:]]
    try:
        return parse_python("".join(rows).encode(text.source.encoding)).tree
    except (PythonFault, UnicodeError):
        return None


def _colon_of(code: str) -> int:
    """Return the place of the colon that opens the block of a line; -1 if it is not there."""
    depth = 0
    for at, sign in enumerate(code):
        depth += (sign in OPEN) - (sign in CLOSE)
        if sign == ":" and depth == 0:
            return at
    return -1


def _commented(text: Broken, above: Above) -> Slip | None:
    """Return a line that would open the block, and is a comment."""
    width = len(indent_of(text.source.line(text.number)))
    for number in range(text.number - 1, above.line, -1):
        match = COMMENTED.fullmatch(text.source.line(number))
        if match is None or text.code.line(number).strip():
            continue
        indent = " " * max(width - 4, 0)
        start = text.source.start_of(number)
        code = match["code"].strip()
        new = text.changed(Splice(start, start + len(match[0]), f"{indent}{code}"))
        if new is not None:
            shown = text.source.line(number).strip()
            return Slip("signs", "head_commented", number, shown, code, new, other=text.number)
    return None


def _without_def(text: Broken, above: Above) -> Slip | None:
    """Return a line of a method whose def is not there."""
    if not isinstance(above.around, ast.ClassDef) or DEF.match(text.line):
        return None
    written = text.source.line(text.number)
    if not re.search(r"^[ \t]*return\b|\bself\.|\bsuper\(\)\.", written):
        return None
    name = _missing_method(text)
    head = f"def {name}(self):"
    indent = indent_of(text.source.line(above.line))
    new = text.changed(text.source.before(text.number, indent + head)) if name else None
    if new is None and _is_like_earlier(text, above.line):
        return _line_between(text, above)
    shown = text.source.line(text.number).strip()
    variant = "def_gone" if new is not None else "def_gone_unknown"
    return Slip("signs", variant, text.number, shown, head, new, other=above.line)


def _line_between(text: Broken, above: Above) -> Slip:
    """Return the first of the lines above that are indented less than the lines around them."""
    old = indent_of(text.source.line(above.line))
    wanted = indent_of(text.source.line(text.number))
    first = above.line
    for number in range(above.line - 1, 0, -1):
        if text.code.line(number).strip() and indent_of(text.source.line(number)) != old:
            break
        first = number if text.code.line(number).strip() else first
    lines = [n for n in range(first, text.number) if text.code.line(n).strip()]
    starts = [text.source.start_of(n) for n in lines]
    new = text.source.spliced([Splice(at, at + len(old), wanted) for at in starts])
    own = all(re.search(r"\bself\.", text.code.line(n)) for n in lines)
    row = text.source.line(first).strip()
    if own and new is not None and can_parse(new):
        return Slip("signs", "line_above", first, row, "", new, other=text.number)
    return Slip("signs", "line_between", first, row, "", other=text.number)


def _missing_method(text: Broken) -> str:
    """Return the name of the method that these lines belong to; "" if it is not certain."""
    code = text.code.text
    if re.search(r"\bsuper\(\)\.__init__", text.line) and not re.search(r"def +__init__", code):
        return "__init__"
    called = set(re.findall(r"create_timer\([^()]*\bself\.(\w+)\b(?!\()", code))
    gone = [name for name in called if not re.search(rf"\bdef +{name}\b", code)]
    inside = "create_timer" in text.line
    return gone[0] if len(gone) == 1 and re.search(r"def +__init__", code) and not inside else ""


def _too_far(text: Broken, above: Above) -> Slip | None:
    """Return a line that is indented further than the statement above it, which opens no block."""
    wanted = indent_of(text.source.line(above.line))
    shown = text.source.line(text.number).strip()
    gone = _try_gone(text, above, wanted)
    if gone is not None:
        return gone
    if _is_like_earlier(text, above.line):
        return Slip("signs", "too_far_either", text.number, shown, "", other=above.line)
    columns = len(indent_of(text.source.line(text.number))) - len(wanted)
    new = _shifted(text, columns)
    start = text.source.start_of(text.number)
    alone = text.changed(Splice(start, start + columns, ""))
    if alone is not None and can_parse(alone) and not (new is not None and can_parse(new)):
        shown = text.source.line(text.number).strip()
        return Slip("signs", "too_far_alone", text.number, shown, "", alone, other=above.line)
    if new is None:
        return None
    variant = "too_far" if wanted else "too_far_margin"
    return Slip("signs", variant, text.number, shown, str(len(wanted)), new, other=above.line)


def _try_gone(text: Broken, above: Above, indent: str) -> Slip | None:
    """Return a block that an except or finally follows, and above which no try: is."""
    for number in range(text.number + 1, len(text.code.lines) + 1):
        row = text.code.line(number)
        if not row.strip() or len(indent_of(row)) > len(indent):
            continue
        if indent_of(row) != indent or re.match(r"[ \t]*(?:except|finally)\b", row) is None:
            return None
        new = text.changed(text.source.before(text.number, f"{indent}try:"))
        shown = text.source.line(text.number).strip()
        return Slip("signs", "try_gone", text.number, shown, str(number), new, other=above.line)
    return None


def first_of_block(text: Broken) -> Slip | None:
    """Return the first line of a block that is not indented by 4 spaces, unlike those below it."""
    above = _above(text) if EXTRA in text.fault.text else None
    if above is None:
        return None
    head = getattr(above.around, "lineno", 0)
    own, wrong = (indent_of(text.source.line(n)) for n in (text.number, above.line))
    body = getattr(above.around, "body", [])
    alone = len(body) == 1 and body[0].lineno == above.line
    if (
        not (head and alone and above.starts_line)
        or len(own) != len(indent_of(text.source.line(head))) + 4
    ):
        return None
    start = text.source.start_of(above.line)
    new = text.source.spliced([Splice(start, start + len(wrong), own)])
    if new is None or not can_parse(new):
        return None
    shown = text.source.line(above.line).strip()
    return Slip("signs", "line_above", above.line, shown, "", new, other=text.number)


def _is_like_earlier(text: Broken, above: int) -> bool:
    """Whether a block above the line above has its column: that line can be the wrong one."""
    width, limit = (len(indent_of(text.source.line(n))) for n in (text.number, above))
    for number in range(above - 1, 0, -1):
        row = text.code.line(number)
        if row.strip() and not _is_in_text(text, number):
            if len(indent_of(row)) < limit:
                return False
            if len(indent_of(row)) == width and not DEF.match(text.code.line(above)):
                return True
    return False


def _shifted(text: Broken, columns: int) -> bytes | None:
    """Return the file with the line, and those below it of the same block, further left."""
    width = len(indent_of(text.source.line(text.number)))
    splices = []
    for number in range(text.number, len(text.source.lines) + 1):
        row, code = text.source.line(number), text.code.line(number)
        if code.strip() and not _is_in_text(text, number) and len(indent_of(row)) < width:
            break
        if len(indent_of(row)) >= columns:
            start = text.source.start_of(number)
            splices.append(Splice(start, start + columns, ""))
    return text.changed(*splices)


def _first_line(text: Broken) -> Slip | None:
    """Return the first line of code, with spaces before it."""
    if any(text.code.line(n).strip() for n in range(1, text.number)):
        return None
    width = len(indent_of(text.source.line(text.number)))
    new = _shifted(text, width)
    if new is None:
        return None
    shown = text.source.line(text.number).strip()
    below = any(text.code.line(n).strip() for n in range(text.number + 1, len(text.code.lines) + 1))
    whole = below and can_parse(new) and _is_indented_below(text, width)
    variant = "margin_all" if whole else "margin"
    return Slip("signs", variant, text.number, shown, str(width), new)


def _is_indented_below(text: Broken, width: int) -> bool:
    """Whether all lines of code are indented as far as the first one, or further."""
    below = range(text.number + 1, len(text.code.lines) + 1)
    used = [n for n in below if text.code.line(n).strip() and not _is_in_text(text, n)]
    return all(len(indent_of(text.code.line(n))) >= width for n in used)


def _is_in_text(text: Broken, number: int) -> bool:
    """Whether a line begins inside of a text in three quotes."""
    places = _quotes_of(text.code.text)
    return bisect_left(places, text.code.start_of(number)) % 2 == 1


@lru_cache(maxsize=4)
def _quotes_of(code: str) -> list[int]:
    return [match.start() for match in TRIPLE.finditer(code)]
