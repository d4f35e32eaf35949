"""One sign that was dropped while typing: an =, a dot, a bracket, a comma, the last quote."""

from __future__ import annotations

import keyword
import re
from collections.abc import Callable

from grader.base.nearest import nearest
from grader.package.source.broken_python import BLOCK, MOST_TRIES, Broken, Slip
from grader.package.source.slip_forms import as_written

Look = Callable[[Broken], Slip | None]
ASSIGNED = re.compile(
    r"^[ \t]*(?P<name>[A-Za-z_][\w.]*)(?P<type>[ \t]*:[ \t]*[A-Za-z_][\w.\[\]]*)?"
    r"(?P<blank>[ \t]+)(?=[\w'\"\[{(-])"
)
COMMANDS = frozenset({"print", "raise", "return", "yield", "assert", "del", "exec", "echo"})
CALLED = re.compile(r"\)(?=[A-Za-z_]\w*[ \t]*\()")
LONE_CLOSER = re.compile(
    r"^[ \t]*(?:(?:[\w.]+[ \t]*=|return|yield)[ \t]*(?=[\w.]*(?:\.|[A-Z])))?[A-Za-z_][\w.]*(?P<at>\))[ \t]*$"
)
SELF_BESIDE = re.compile(
    r"^[ \t]*(?:async[ \t]+)?def[ \t]+\w+[ \t]*\([ \t]*self(?P<blank>[ \t]+)(?=[A-Za-z_*])"
)
FROM = re.compile(r"^[ \t]*from[ \t]+[\w.]+[ \t]+(?P<word>[A-Za-z]+)[ \t]+[A-Za-z_*]")
KNOWN = re.compile(
    r"(?:^|[ \t.])(?:spin_once|spin|init|add_node|destroy_timer|info|str|int|len|float)(?P<rest>[A-Za-z_]\w*)$"
)
"""A known function whose bracket is missing, and the name that was in it."""
HEAD = re.compile(rf"[ \t]*(?:{BLOCK})\b")
SINGLE = re.compile(r"(?<!['\"])['\"](?!['\"])")


def _equals(text: Broken) -> Slip | None:
    """Return a name and a value beside each other, without the = between them."""
    match = ASSIGNED.match(text.line)
    if match is None or keyword.iskeyword(match["name"]) or match["name"] in COMMANDS:
        return None
    name, code = re.escape(match["name"]), text.code.text
    called = re.search(rf"(?<![\w.]){name}[ \t]*\(", code) is not None
    attribute = "." in match["name"] and re.search(rf"(?<![\w.]){name}\b(?![ \t]+[\w'\"])", code)
    wide = len(match["blank"]) > 1 and not re.search(rf"\bdef[ \t]+{name}\b", code)
    if not wide and (called or not (match["type"] or attribute)):
        return None
    if re.match(r"(?:and|or|in|is|not|if|else|for|import|as)\b", text.line[match.end() :]):
        return None
    return _changed(text, "equals_missing", *match.span("blank"), " = ")


def _dot(text: Broken) -> Slip | None:
    """Return a call behind a call, without the dot between them."""
    for match in list(CALLED.finditer(text.line))[:MOST_TRIES]:
        found = _changed(text, "dot_missing", match.end(), match.end(), ".")
        if found is not None:
            return found
    return None


def _opening(text: Broken) -> Slip | None:
    """Return a call whose only bracket is the closing one."""
    match = LONE_CLOSER.match(text.line)
    if "unmatched ')'" not in text.fault.text:
        return None
    if match is None:
        return _of_method(text)
    joined = KNOWN.search(text.line[: match.start("at")])
    if joined is not None and re.search(rf"(?<![\w.]){joined['rest']}\b", text.code.text):
        at = joined.start("rest")
        return _changed(text, "bracket_first", at, at, "(")
    return _changed(text, "bracket_first", match.start("at"), match.start("at"), "(")


def _of_method(text: Broken) -> Slip | None:
    """Return a call of a function of the file in a longer line, with only the closing bracket."""
    found = []
    for match in list(re.finditer(r"(?<=\w)\)", text.line))[:MOST_TRIES]:
        name = re.search(r"\w+$", text.line[: match.start()])
        is_def = name and re.search(rf"\bdef[ \t]+{name[0]}[ \t]*\(", text.code.text)
        of_value = name and re.search(rf"@property\s+def[ \t]+{name[0]}\b", text.code.text)
        outside = re.search(r"\)[ \t]*,[^()]*\Z", text.line[: match.start()])
        if is_def and not of_value and not outside:
            found.append(_changed(text, "bracket_first", match.start(), match.start(), "("))
    return found[0] if len(found) == 1 else None


def _comma(text: Broken) -> Slip | None:
    """Return a def whose first parameter has no comma behind it."""
    match = SELF_BESIDE.match(text.line)
    return _changed(text, "comma_missing", *match.span("blank"), ", ") if match else None


def _import(text: Broken) -> Slip | None:
    """Return a from with a misspelt import."""
    match = FROM.match(text.line)
    if match is None or not nearest(match["word"], ["import"], cutoff=0.7):
        return None
    return _changed(text, "word_misspelt", *match.span("word"), "import")


def _quote(text: Broken) -> Slip | None:
    """Return a line that opens a block, whose text has no second quote before the colon."""
    written = text.source.line(text.number)
    told = text.fault.text
    if HEAD.match(text.line) is None or not ("unterminated" in told or "EOL while" in told):
        return None
    at, quotes = len(written.rstrip()) - 1, SINGLE.findall(written)
    if at < 0 or written[at] != ":" or len(quotes) % 2 == 0:
        return None
    return _changed(text, "quote_exact", at, at, quotes[-1])


def _changed(text: Broken, variant: str, start: int, end: int, new: str) -> Slip | None:
    return as_written(text, variant, text.within(start, end, new))


DROPPED_LOOKS: tuple[Look, ...] = (_quote, _equals, _dot, _opening, _comma, _import)
