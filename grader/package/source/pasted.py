"""What comes along when code is copied from a web page or a document: found, and removed.

The file is scanned as Python reads it, so that strings and comments stay as they are. The scan is
linear: each character is examined a bounded number of times.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from grader.package.edit.text import SourceText, Splice, read_source
from grader.package.source.python import PythonFault, parse_python

LABELS = (
    "Python|python|Python3|python3|py|Bash|bash|sh|Shell|shell|Console|console|Terminal|terminal|XML|xml"
    "|HTML|html|INI|ini|Copy|copy|Copy code|Copied!|Code|code|Text|text|Plain text"
)
"""What a page writes above a box of code, or on its buttons."""
COMMANDS = (
    "cd|source|ros2|colcon|chmod|sudo|mkdir|touch|nano|gedit|code|export|cat|python3|python|pip|pip3"
    "|apt|apt-get|git|ls|cp|mv|rm|vim|vi|echo|rosdep|rosrun|roslaunch|catkin_make|bash"
)
ALONE = "ls|pwd|clear|ros2|colcon|rviz2|rqt|rqt_graph"
"""Commands that need no word behind them."""
OPERATORS = "and|or|in|is|if|else|for|not|as"
"""What Python has between two words of a line."""
SHELL = rf"""
    (?!export[ ]+(?:class|def|default|function|const)\b)(?:{COMMANDS})[ ]{{1,9}}(?:
        (?!(?:{OPERATORS})\b)[A-Za-z_~$"'][^\r\n]{{0,400}}
      | (?:[-+]\w|[\w~./$<>])[^\r\n=(]{{0,400}}
      | \.{{1,2}}
    )
  | (?:{ALONE})
  | \.[ ][^\r\n=(]{{0,200}}setup\.(?:ba|z)?sh
  | \./[\w./-]{{1,200}}
"""
SINGLE, DOUBLE = (
    "\u2018\u2019\u201a\u201b\u2032\u00b4\uff07",
    "\u201c\u201d\u201e\u201f\u2033\uff02\u00ab\u00bb",
)
BLANKS = "\u00a0\u1680\u2000-\u200a\u202f\u205f\u3000"
NOTHING = "\u200b-\u200f\u2028-\u202e\u2060\ufeff\u00ad"
SIGNS = {"\u2010": "-", "\u2011": "-", "\u2012": "-", "\u2013": "-", "\u2014": "-", "\u2212": "-",
         "\u2026": "...", "\u3001": ",", "\u3002": "."}  # fmt: skip
WIDE = "\u3000"
FULL_WIDTH = 0xFEE0  # from a full-width sign to the one of ASCII
END = r"(?=[ \t]*(?:\r|\n|\Z))"
OPEN = re.compile(
    rf"""
      (?P<line>^(?:
          (?:{LABELS.replace(" ", "[ ]")}):?{END}
        | [ \t]{{0,20}}(?:```|~~~)[ \t]{{0,9}}[\w+-]{{0,20}}{END}
        | [ \t]{{0,20}}(?:{SHELL}){END}
        | [!%]{{1,2}}[a-z_][^\r\n]{{0,400}}{END}
        | (?:[\w.-]{{1,40}}@[\w.-]{{1,60}}:[^\r\n$\#]{{0,200}})?\$[ ][^\r\n]{{0,400}}{END}
      ))
    | (?P<prompt>^(?:>>>|\.\.\.)(?:[ ]|{END}))
    | (?P<comment>\#[^\r\n]*)
    | (?P<blank>[{BLANKS}]+)
    | (?P<nothing>[{NOTHING}]+)
    | (?P<sign>[{"".join(SIGNS)}\uff01\uff03-\uff06\uff08-\uff0f\uff1a-\uff20\uff3b-\uff40\uff5b-\uff5e])
    | (?P<quote>\"\"\"|'''|["'{SINGLE}{DOUBLE}])
    """,
    re.VERBOSE | re.MULTILINE,
)
INSIDE = {
    quotes: re.compile(rf"(?:[^\\\r\n{quotes}]|\\(?:\r\n|.))*", re.DOTALL)
    for quotes in ("'", '"', SINGLE + "'", DOUBLE + '"')
}
"""What can be inside a string that ends with one of these quotes."""


@dataclass(frozen=True)
class Pasted:
    """Something that does not belong into the code: its variant, its line, and the change.

    `variant` is `signs` for characters, `lines` for what a page or a terminal has beside the code;
    `found` is what is written there, `whole` whether the whole line goes.
    """

    variant: str
    line: int
    found: str
    splice: Splice
    whole: bool = False

    @property
    def word(self) -> str:
        """The name that Python takes it for."""
        return self.found.partition(" ")[0]


def pasted_in(source: SourceText) -> list[Pasted]:
    """Return all that may have been pasted, in order.

    Whether it was is certain only if Python cannot read the file with it: some of it can be code.
    """
    found = list(_scan(source))
    if not any(p.found.startswith(">>>") for p in found):  # `...` alone is code
        found = [p for p in found if p.found != "..."]
    return found


def cleaned(source: SourceText, pasted: Sequence[Pasted]) -> bytes | None:
    """Return the file's bytes without what was pasted; None if they cannot be encoded."""
    return source.spliced([p.splice for p in pasted])


def labels_in(found: bytes) -> list[Pasted]:
    """Return the labels that Python takes for names: it reads the file, and then stops at them."""
    source = read_source(found)
    if source is None:
        return []
    labels = [p for p in pasted_in(source) if p.whole]
    try:
        tree = parse_python(found).tree if labels else ast.Module([], [])
    except PythonFault:
        return []
    alone = {s.lineno: _first_name(s.value) for s in ast.walk(tree) if isinstance(s, ast.Expr)}
    known = _bound(tree)
    return [p for p in labels if p.word == alone.get(p.line) and not {p.word, "*"} & known]


def _first_name(value: ast.expr) -> str:
    """Return the name with which a line begins that only reads names: `Python`, `ls -l`."""
    while isinstance(value, ast.BinOp):
        value = value.left
    return value.id if isinstance(value, ast.Name) else ""


def _bound(tree: ast.Module) -> set[str]:
    """Return every name that a file binds anywhere; `*` if it imports all names of a module."""
    names: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            names.add(node.name)
        elif isinstance(node, ast.alias):
            names.add((node.asname or node.name).partition(".")[0])
        elif isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load):
            names.add(node.id)
    return names


def _scan(source: SourceText) -> Iterator[Pasted]:
    text, at, line, counted = source.text, 0, 1, 0
    while (match := OPEN.search(text, at)) is not None:
        start, end = match.span()
        line, counted = line + _ends(text, counted, start), start
        at = end
        if match["quote"]:
            closed = _string(text, start, match["quote"])
            at = closed.end
            if closed.changes:
                signs = "".join(dict.fromkeys(text[s.start : s.end] for s in closed.changes))
                for change in closed.changes:
                    there = line + _ends(text, start, change.start)
                    yield Pasted("signs", there, signs, change)
            continue
        if match["line"]:
            whole = Splice(source.start_of(line), source.start_of(line + 1), "")
            yield Pasted("lines", line, match[0].strip(), whole, whole=True)
        elif match["prompt"]:
            yield Pasted("lines", line, match[0].strip(), Splice(start, end, ""))
        elif not match["comment"]:
            yield Pasted("signs", line, match[0], Splice(start, end, _plain(match)))


def _ends(text: str, start: int, end: int) -> int:
    """Return how many lines end in a range, as SourceText counts them."""
    part = text[start:end]
    return part.count("\n") + part.count("\r") - part.count("\r\n")


def _plain(match: re.Match[str]) -> str:
    """Return the code that a sign stands for; a wide space is as wide as two ordinary ones."""
    if match["blank"]:
        return "".join("  " if sign == WIDE else " " for sign in match[0])
    found = match["sign"] or ""
    return (SIGNS.get(found) or chr(ord(found) - FULL_WIDTH)) if found else ""


@dataclass(frozen=True)
class _Closed:
    """Where a string ends, and the changes of its quotes."""

    end: int
    changes: tuple[Splice, ...] = ()


def _string(text: str, start: int, quote: str) -> _Closed:
    family = SINGLE + "'" if quote[0] in SINGLE + "'" else DOUBLE + '"'
    plain = family[-1]
    three = text[start : start + 3]
    if len(quote) == 3 or (quote != plain and len(three) == 3 and set(three) <= set(family)):
        return _long(text, start, family, plain, is_plain=len(quote) == 3)
    end = _closer(text, start + 1, plain if quote == plain else family)
    if quote == plain and end < len(text) and text[end] == plain:
        return _Closed(end + 1)
    stop = end
    if quote == plain:  # it has no end on its line, unless a typographic quote is meant
        end = min(_closer(text, start + 1, family), stop)
    closed = end < len(text) and text[end] in family
    changes = [Splice(at, at + 1, plain) for at in (start, *([end] if closed else []))]
    kept = tuple(change for change in changes if text[change.start] != plain)
    return _Closed(end + 1 if closed else stop, kept)


def _closer(text: str, start: int, quotes: str) -> int:
    """Return where one of the quotes is first, or where the line ends."""
    match = INSIDE[quotes].match(text, start)
    return match.end() if match else start


def _long(text: str, start: int, family: str, plain: str, *, is_plain: bool) -> _Closed:
    """Return the end of a string in three quotes; typographic ones are replaced."""
    if is_plain:
        end = text.find(plain * 3, start + 3)
        return _Closed(len(text) if end < 0 else end + 3)
    match = re.compile(f"[{re.escape(family)}]{{3}}").search(text, start + 3)
    ends = [] if match is None else [match.start()]
    changes = [Splice(at, at + 3, plain * 3) for at in (start, *ends)]
    return _Closed(match.end() if match else start + 3, tuple(changes))
