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
UNFINISHED = re.compile(r"[ \t]*(?:async[ \t]+)?def[ \t]+\w+[ \t]*\([^()]*$")
STATEMENT = re.compile(r"[ \t]*(?:return|if|for|while|try|with|raise|pass|self\.\w+[ \t]*[-+]?=)")
OWN_DEF = re.compile(r"[ \t]*def[ \t]+(?P<own>self[ \t]*\.[ \t]*)\w+[ \t]*\(")
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


def _unfinished_def(text: Broken) -> Slip | None:
    """Return a def whose line ends in its brackets, and below which its block begins."""
    if "was never closed" not in text.fault.text or not UNFINISHED.match(text.line):
        return None
    below = next((row for row in _rows_below(text) if row.strip()), "")
    if not STATEMENT.match(below):
        return None
    shown = text.source.line(text.number).strip()
    return Slip(
        "signs", "def_unfinished", text.number, shown, shown.rstrip(", \t"), other=text.number + 1
    )


def _own_def(text: Broken) -> Slip | None:
    """Return a def with self. before its name."""
    match = OWN_DEF.match(text.line)
    if match is None:
        return None
    splice = text.within(*match.span("own"), "")
    new = text.changed(splice)
    return text.slip("signs", "def_self", text.source.line(text.number), splice, fixed=new)


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
    return Slip(
        "signs", "closed_early", above, written.strip(), wanted, new, other=text.number, step=sign
    )


def _comment_between(text: Broken) -> Slip | None:
    """Return a line between two comments that is no code at any indentation."""
    written = text.source.line(text.number)
    rows = [text.source.line(text.number + step).lstrip() for step in (-1, 1)]
    if text.number < 2 or not all(row.startswith("#") and not row.startswith("#!") for row in rows):
        return None
    if fault_of(written.strip().encode()) is None:
        return None
    start = text.source.start_of(text.number) + len(indent_of(written))
    new = text.changed(Splice(start, start, "# "))
    if new is None:
        return None
    wanted = f"# {written.strip()}"
    return Slip("signs", "note_without_sign", text.number, written.strip(), wanted, new)


HEAD_LOOKS: tuple[Callable[[Broken], Slip | None], ...] = (
    _class_for_def,
    _def_for_class,
    _unfinished_def,
    _own_def,
    _closed_early,
    _comment_between,
)
