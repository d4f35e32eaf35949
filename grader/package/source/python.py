"""A Python file as text and syntax tree: decoded and parsed as Python does, never run."""

from __future__ import annotations

import ast
import codecs
import io
import re
import sys
import tokenize
import warnings
from dataclasses import dataclass

from grader.base.i18n.message import say
from grader.package.source.budget import MOST_BYTES, MOST_DEPTH, MOST_PARTS, first_beyond
from grader.package.source.kept import keep_small
from grader.package.source.newer_python import SINCE, first_difference, with_older_quotes

SHEBANG = "#!/usr/bin/env python3"
PART = re.compile(r"\.?\d[\w.]*|\w+|[^\w\s]")
"""The first line that the course asks for."""

ENCODINGS = re.compile(
    r"utf-8(-sig)?|ascii|iso8859-\d+|cp\d+|koi8-[rut]|mac-\w+|gbk|gb2312|gb18030|big5(hkscs)?"
    r"|shift_jis\w*|euc[_-](jp|kr)\w*"
)
"""The accepted encodings, by the names of Python's codecs: only those of linear cost."""


class PythonFault(Exception):  # noqa: N818 - a fault in the student's file, not an error
    """Why Python cannot read a file: `kind` is `encoding`, `syntax`, `indentation`, `tabs`,
    `null` or `size`; `line` is counted from 1, `shown` is that line's text, and `part` is what is
    written in it where Python stops ("" if that is not known).
    """

    def __init__(
        self, kind: str, text: str, line: int | None = None, shown: str = "", part: str = ""
    ) -> None:
        super().__init__(text)
        self.kind = kind
        self.text = text
        self.line = line
        self.shown = shown
        self.part = part


@dataclass(frozen=True)
class PythonFile:
    """A file that Python can read.

    `newer` is the line of the first f-string that only Python 3.12 and later can read, if this
    Python is older; 0 if there is none.
    """

    text: str
    tree: ast.Module
    newer: int = 0


def has_no_code(found: bytes) -> bool:
    """Return whether a file is empty or has only comments and a text that describes it."""
    if not found.strip():
        return True
    try:
        body = parse_python(found).tree.body
    except PythonFault:
        return False
    texts = [n for n in body if isinstance(n, ast.Expr) and isinstance(n.value, ast.Constant)]
    return len(texts) == len(body)


def parse_python(found: bytes) -> PythonFile:
    """Parse a file's bytes; PythonFault if this interpreter's version of Python cannot.

    An f-string with its own quotes in a value is read as Python 3.12 does.

    The tree is shared: nobody may change it.
    """
    result = _parsed(found)
    if isinstance(result, PythonFault):
        raise result.with_traceback(None)
    return result


@keep_small
def _parsed(found: bytes) -> PythonFile | PythonFault:
    try:
        return _parse(found)
    except PythonFault as fault:
        return fault


def _parse(found: bytes) -> PythonFile:
    if len(found) > MOST_BYTES:
        raise PythonFault("size", say("the file is larger than {size} kB", size=MOST_BYTES // 1000))
    text = decode(found)
    try:
        return PythonFile(text, _bounded(_compiled(text)))
    except SyntaxError as error:
        older = with_older_quotes(text) if sys.version_info < SINCE else None
        if older is None:
            raise _fault(error, text) from None
    except (RecursionError, MemoryError, OverflowError, ValueError) as error:
        raise PythonFault(
            "syntax", say("too deeply nested to be read ({error})", error=str(error))
        ) from None
    try:
        return PythonFile(text, _bounded(_compiled(older)), newer=first_difference(text, older))
    except SyntaxError as error:
        raise _fault(error, text) from None


def _compiled(text: str) -> ast.Module:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        tree = ast.parse(text)
        # (the compiler refuses what the parser accepts, e.g. a return outside a function)
        compile(text, "<file>", "exec", dont_inherit=True)
    return tree


def _bounded(tree: ast.Module) -> ast.Module:
    """Return the tree of a file, without numbers that are too large; PythonFault if it has too much."""
    line = first_beyond(tree)
    if line:
        count = f"{MOST_PARTS:,}"
        text = say(
            "the file has more than {count} names, numbers and calls, or more than {depth} inside "
            "each other",
            count=count,
            depth=MOST_DEPTH,
        )
        raise PythonFault("size", text, line)
    return tree


def can_parse(found: bytes) -> bool:
    """Return whether `parse_python` accepts a file's bytes."""
    try:
        parse_python(found)
    except PythonFault:
        return False
    return True


def _fault(error: SyntaxError, text: str) -> PythonFault:
    kind = "syntax"
    if isinstance(error, TabError):
        kind = "tabs"
    elif isinstance(error, IndentationError):
        kind = "indentation"
    lines = text.splitlines()
    line = error.lineno if error.lineno and error.lineno > 0 else None
    row = lines[line - 1] if line and line <= len(lines) else ""
    reason = f"{type(error).__name__}: {error.msg}"[:300]
    return PythonFault(kind, reason, line, row.strip()[:160], _part(error, row))


def _part(error: SyntaxError, row: str) -> str:
    """Return the word or sign of a line at which Python stops; "" if that is not certain."""
    if not error.offset or error.offset < 1 or not row.isascii() or error.text is None:
        return ""
    if error.text.rstrip("\r\n") != row.rstrip("\r\n"):
        return ""
    match = PART.match(row, error.offset - 1)
    return match[0] if match is not None else ""


def decode(found: bytes) -> str:
    """Return the text (PEP 263) with Unix line ends and without a byte order mark."""
    if found[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise PythonFault("encoding", say("the file is UTF-16, but Python reads UTF-8"), 1)
    if b"\0" in found:
        line = found.count(b"\n", 0, found.index(b"\0")) + 1
        raise PythonFault("null", say("the file contains null bytes: it is not text"), line)
    try:
        declared, _ = tokenize.detect_encoding(io.BytesIO(found).readline)
        name = codecs.lookup(declared).name
    except (SyntaxError, LookupError) as error:
        # (detect_encoding also decodes the first two lines, with the same kind of error)
        bad = _first_undecodable(found)
        reason: str = say("the file is not UTF-8 text") if bad else str(error)
        raise PythonFault("encoding", reason, bad or 1) from None
    if not ENCODINGS.fullmatch(name):
        raise PythonFault(
            "encoding", say("the file declares the encoding {name}; use UTF-8", name=name), 1
        )
    try:
        text = found.decode(name)
    except UnicodeDecodeError as error:
        line = found.count(b"\n", 0, error.start) + 1
        reason = say("the file is not UTF-8 text")
        if not name.startswith("utf-8"):
            reason = say("the file is not valid {name}, the encoding it declares", name=name)
        raise PythonFault("encoding", reason, line) from None
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _first_undecodable(found: bytes) -> int | None:
    try:
        found.decode("utf-8")
    except UnicodeDecodeError as error:
        return found.count(b"\n", 0, error.start) + 1
    return None
