"""A damaged line of a def or a class, a call that is closed too early, a comment without its #."""

from __future__ import annotations

import re
from collections.abc import Callable

from grader.package.edit.text import Splice, indent_of
from grader.package.source.broken_python import Broken, Slip, fault_of
from grader.package.source.python import can_parse

CLASS_AS_DEF = re.compile(r"[ \t]*(?P<word>class)[ \t]+\w+[ \t]*\([ \t]*self\b")
DEF_AS_CLASS = re.compile(
    r"[ \t]*(?P<word>def)[ \t]+[A-Z]\w*[ \t]*(?P<base>\([ \t]*\w*[ \t]*\))?[ \t]*:"
)
FIELD = re.compile(r"[ \t]*(?:[a-z_]\w*[ \t]*:[ \t]*\w|def[ \t]+\w+[ \t]*\([ \t]*self\b)")
OWN_DEF = re.compile(r"[ \t]*def[ \t]+(?P<own>self[ \t]*\.[ \t]*)\w+[ \t]*\((?P<given>[ \t]*\))?")
TELLS_INDENT = "unexpected indent"


def _class_for_def(text: Broken) -> Slip | None:
    """Return a method that begins with class: Python stops at its return, or later."""
    if "outside function" not in text.fault.text:
        return None
    width = len(indent_of(text.line))
    for number in range(text.number - 1, 0, -1):
        row = text.code.line(number)
        if not row.strip() or len(indent_of(row)) >= width:
            continue
        match = CLASS_AS_DEF.match(row)
        if match is None:
            return None
        start = text.source.start_of(number) + match.start("word")
        new = text.source.spliced([Splice(start, start + len("class"), "def")])
        shown = text.source.line(number).strip()
        wanted = shown.replace("class", "def", 1)
        good = new is not None and can_parse(new)
        return Slip("signs", "class_for_def", number, shown, wanted, new if good else None)
    return None


def _def_for_class(text: Broken) -> Slip | None:
    """Return a class that begins with def: a capital letter, and fields or methods below it."""
    match = DEF_AS_CLASS.match(text.line)
    below = next((row for row in _rows_below(text) if row.strip()), "")
    if (
        match is None
        or not FIELD.match(below)
        or len(indent_of(below)) <= len(indent_of(text.line))
    ):
        return None
    splice = text.within(*match.span("word"), "class")
    new = text.changed(splice)
    if new is None:
        return None
    return text.slip("signs", "def_for_class", text.source.line(text.number), splice, fixed=new)


def _rows_below(text: Broken) -> list[str]:
    return [text.code.line(n) for n in range(text.number + 1, len(text.code.lines) + 1)]


def _own_def(text: Broken) -> Slip | None:
    """Return a def with self. before its name."""
    match = OWN_DEF.match(text.line)
    if match is None:
        return None
    splices = [text.within(*match.span("own"), "")]
    if match["given"] is not None:
        splices.append(text.within(*match.span("given"), "self)"))
    new = text.changed(*splices)
    return text.slip("signs", "def_self", text.source.line(text.number), *splices, fixed=new)


def _closed_early(text: Broken) -> Slip | None:
    """Return a bracket that ends a call above its last lines, which are indented as its values."""
    if TELLS_INDENT not in text.fault.text:
        return None
    above = next((n for n in range(text.number - 1, 0, -1) if text.code.line(n).strip()), 0)
    row = text.code.line(above) if above else ""
    ends = re.search(r"(?P<closer>[)\]}])[ \t]*,?[ \t]*$", row)
    if ends is None:
        return None
    start = text.source.start_of(above)
    at = start + ends.start("closer")
    new = text.source.spliced([Splice(at, at + 1, "")])
    if new is None or not can_parse(new):
        return None
    written = text.source.line(above)
    wanted = (written[: at - start] + written[at - start + 1 :]).strip()
    sign = ends["closer"]
    variant = "closed_early" if wanted else "closed_early_alone"
    return Slip("signs", variant, above, written.strip(), wanted, new, other=text.number, step=sign)


def _comment_between(text: Broken) -> Slip | None:
    """Return a line between two comments that is no code at any indentation."""
    written = text.source.line(text.number)
    rows = [text.source.line(text.number + step).lstrip() for step in (-1, 1)]
    if text.number < 2 or not all(row.startswith("#") and not row.startswith("#!") for row in rows):
        return None
    if fault_of(written.strip().encode()) is None or re.search(r"\w\(|=", written):
        return None
    start = text.source.start_of(text.number) + len(indent_of(written))
    new = text.changed(Splice(start, start, "# "))
    if new is None:
        return None
    wanted = f"# {written.strip()}"
    return Slip("signs", "note_without_sign", text.number, written.strip(), wanted, new)


SQUARE = re.compile(r"[ \t]*def[ \t]+\w+[ \t]*(?P<open>\[)[^\[\]]*(?P<close>\])[ \t]*(?:->[^:]*)?:")
JOINED = re.compile(r"[ \t]*\S.*?(?P<blank>[ \t]{2,})def[ \t]+\w+[ \t]*\(")
HANDLER = re.compile(
    r"[ \t]*except[ \t]*(?P<all>\([ \t]*(?P<types>[\w.]+(?:[ \t]*[|,][ \t]*[\w.]+)+)"
    r"(?:(?:[ \t]+as)?[ \t]+(?P<inner>\w+))?[ \t]*\)(?:(?P<as>[ \t]+as)?[ \t]+(?P<outer>\w+))?)[ \t]*:"
)
LAMBDA = re.compile(r"\blambda(?=[ \t]+(?:self|\w+)\.\w+[ \t]*\()")
TWO_QUOTES = re.compile(r"[ \t]*(?P<quotes>''|\"\")(?![ \t]*['\",)+]).*(?P=quotes)[ \t]*")


def _square_def(text: Broken) -> Slip | None:
    """Return a def with square brackets around its parameters."""
    match = SQUARE.match(text.line)
    if match is None:
        return None
    splices = [text.within(*match.span("open"), "("), text.within(*match.span("close"), ")")]
    new = text.changed(*splices)
    return text.slip("signs", "def_square", text.source.line(text.number), *splices, fixed=new)


def _joined_def(text: Broken) -> Slip | None:
    """Return a def that stands behind another statement on its line."""
    match = JOINED.match(text.line)
    if match is None:
        return None
    for indent in ("    ", "", indent_of(text.line)):
        splice = text.within(*match.span("blank"), f"{text.source.newline}{indent}")
        new = text.changed(splice)
        if new is not None and can_parse(new):
            wanted = text.source.line(text.number)[match.end("blank") :].strip()
            shown = text.source.line(text.number).strip()
            return Slip("signs", "two_statements", text.number, shown, wanted, new)
    return None


def _handler_of_several(text: Broken) -> Slip | None:
    """Return an except of several classes with | between them, or with a name without as."""
    match = HANDLER.match(text.line)
    if match is None:
        return None
    types = [part.strip() for part in re.split(r"[|,]", match["types"])]
    name = match["outer"] or match["inner"]
    wanted = f"({', '.join(types)}){f' as {name}' if name else ''}"
    splice = text.within(*match.span("all"), wanted)
    new = text.changed(splice)
    if new is None:
        return None
    return text.slip("signs", "handler_several", text.source.line(text.number), splice, fixed=new)


def _lambda_colon(text: Broken) -> Slip | None:
    """Return a lambda without its colon."""
    match = LAMBDA.search(text.line)
    if match is None:
        return None
    splice = text.within(match.end(), match.end(), ":")
    new = text.changed(splice)
    if new is None:
        return None
    return text.slip("signs", "lambda_colon", text.source.line(text.number), splice, fixed=new)


def _docstring_quotes(text: Broken) -> Slip | None:
    """Return a text on a line of its own between two times two quotes."""
    written = text.source.line(text.number)
    match = TWO_QUOTES.fullmatch(written)
    if match is None or not match["quotes"]:
        return None
    first, sign = match.start("quotes"), match["quotes"][0]
    last = len(written.rstrip())
    splices = [text.within(first, first, sign), text.within(last, last, sign)]
    new = text.changed(*splices)
    if new is None:
        return None
    return text.slip("signs", "docstring_quotes", written, *splices, fixed=new)


def _except_empty(text: Broken) -> Slip | None:
    """Return an except without a line in its block."""
    told = re.search(r"after 'except' statement on line (?P<line>\d+)", text.fault.text)
    head = int(told["line"]) if told is not None else 0
    if not 0 < head < text.number:
        return None
    ends = re.match(r"[ \t]*(?:finally|except|else|def|class)\b", text.line) is not None
    apart = not text.source.line(head + 1).strip()
    if not ends and not apart:
        return None
    indent = indent_of(text.source.line(head))
    new = text.changed(text.source.before(head + 1, f"{indent}    pass"))
    shown = text.source.line(head).strip()
    return Slip("signs", "except_empty", head, shown, "pass", new, other=text.number)


MARGIN_DEF = re.compile(r"(?:async[ \t]+)?def[ \t]+\w+[ \t]*\([ \t]*self\b")
SUPER = re.compile(r"\bsuper\((?=[ \t]*\.)")
CLASS_CLOSED = re.compile(r"[ \t]*class[ \t]+(?P<name>\w+?)(?=Node\)[ \t]*:)")
MAIN_CALLED = re.compile(r"^[ \t]+main\(\)", re.M)
MAIN_DEFINED = re.compile(r"^[ \t]*(?:async[ \t]+)?def[ \t]+main\b|\bimport\b.*\bmain\b", re.M)


def _margin_def(text: Broken) -> Slip | None:
    """Return a method whose def is at the margin, while its lines and the other methods are not."""
    if text.fault.kind != "indentation":
        return None
    for number in range(text.number, 0, -1):
        if not MARGIN_DEF.match(text.code.line(number)):
            continue
        above = next((n for n in range(number - 1, 0, -1) if text.code.line(n).strip()), 0)
        if re.match(r"[ \t]*class\b", text.code.line(above) if above else ""):
            return None  # (the first line of the class)
        start = text.source.start_of(number)
        new = text.source.spliced([Splice(start, start, "    ")])
        if new is not None and can_parse(new):
            shown = text.source.line(number).strip()
            return Slip("signs", "def_at_margin", number, shown, "", new, other=text.number)
    return None


def _super_open(text: Broken) -> Slip | None:
    """Return super without its closing bracket."""
    match = SUPER.search(text.line)
    if match is None:
        return None
    splice = text.within(match.end(), match.end(), ")")
    new = text.changed(splice)
    if new is None:
        return None
    return text.slip("signs", "super_open", text.source.line(text.number), splice, fixed=new)


def _class_closed(text: Broken) -> Slip | None:
    """Return a class whose bracket before the base Node is missing."""
    match = CLASS_CLOSED.match(text.line)
    if match is None:
        return None
    splice = text.within(match.end(), match.end(), "(")
    new = text.changed(splice)
    if new is None:
        return None
    return text.slip("signs", "bracket_first", text.source.line(text.number), splice, fixed=new)


def _main_gone(text: Broken) -> Slip | None:
    """Return the lines of main without their def, which is called and not defined."""
    code = text.code.text
    if "outside function" not in text.fault.text or MAIN_DEFINED.search(code):
        return None
    if MAIN_CALLED.search(code) is None:
        return None
    first = text.number
    while first > 1 and text.source.line(first - 1).strip():
        first -= 1
    new = text.source.spliced([text.source.before(first, "def main(args=None):")])
    if new is None or not can_parse(new):
        return None
    shown = text.source.line(first).strip()
    return Slip("signs", "main_gone", first, shown, "def main(args=None):", new, other=text.number)


def _def_below(text: Broken) -> Slip | None:
    """Return the first line of a block that stands above its def."""
    if TELLS_INDENT not in text.fault.text:
        return None
    below = text.code.line(text.number + 1) if text.number < len(text.code.lines) else ""
    first = not any(text.code.line(n).strip() for n in range(1, text.number))
    if first or not re.match(r"[ \t]*(?:async[ \t]+)?(?:def|class)\b", below):
        return None
    start, end = text.source.start_of(text.number), text.source.end_of(text.number + 1)
    rows = [text.source.line(text.number + 1), text.source.line(text.number)]
    new = text.source.spliced([Splice(start, end, text.source.newline.join(rows))])
    if new is None or not can_parse(new):
        return None
    shown = text.source.line(text.number).strip()
    return Slip("signs", "def_below", text.number, shown, "", new, other=text.number + 1)


HEAD_LOOKS: tuple[Callable[[Broken], Slip | None], ...] = (
    _margin_def,
    _super_open,
    _class_closed,
    _main_gone,
    _def_below,
    _class_for_def,
    _def_for_class,
    _own_def,
    _square_def,
    _joined_def,
    _handler_of_several,
    _lambda_colon,
    _docstring_quotes,
    _except_empty,
    _closed_early,
    _comment_between,
)
