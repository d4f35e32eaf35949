"""A student's file as text that can be changed in places; all other bytes are kept."""

from __future__ import annotations

import ast
import codecs
import io
import re
import tokenize
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

from grader.package.source.python import ENCODINGS

Positioned = ast.expr | ast.stmt | ast.keyword | ast.arg | ast.alias
"""The pieces of syntax that have a place in the text."""
LINE = re.compile(r"[^\r\n]*(?:\r\n|\r|\n)|[^\r\n]+\Z")
BOM = codecs.BOM_UTF8
MOST_BYTES = 20_000
"""A longer file is not fixed: each fix reads it again, and an exercise's has a tenth of that."""


@dataclass(frozen=True)
class Splice:
    """Replace the characters from `start` up to (not including) `end` with `new`."""

    start: int
    end: int
    new: str


@dataclass(frozen=True)
class SourceText:
    """The exact text of a file, including line ends; lines are counted from 1, as in Python."""

    text: str
    encoding: str
    mark: bytes = b""

    @cached_property
    def lines(self) -> list[str]:
        """The lines, each with its line end."""
        return LINE.findall(self.text)

    @cached_property
    def _starts(self) -> list[int]:
        starts = [0]
        for line in self.lines:
            starts.append(starts[-1] + len(line))
        return starts

    @property
    def newline(self) -> str:
        """The line end of the file: that of its first line."""
        first = self.lines[0] if self.lines else ""
        return next((end for end in ("\r\n", "\n", "\r") if first.endswith(end)), "\n")

    def start_of(self, line: int) -> int:
        """Return where a line begins; the end of the text for a line after the last."""
        return self._starts[min(max(line - 1, 0), len(self.lines))]

    def end_of(self, line: int) -> int:
        """Return where a line's own characters end, before its line end."""
        return self.start_of(line) + len(self.line(line))

    def line(self, line: int) -> str:
        """Return a line without its line end; empty if there is none."""
        return self.lines[line - 1].rstrip("\r\n") if 0 < line <= len(self.lines) else ""

    def at(self, line: int, column: int) -> int:
        """Return the offset of a position of Python's parser, whose columns count UTF-8 bytes."""
        before = self.line(line).encode("utf-8", "surrogatepass")[:column]
        return self.start_of(line) + len(before.decode("utf-8", "ignore"))

    def span(self, node: Positioned) -> tuple[int, int]:
        """Return the offsets at which a piece of syntax starts and ends."""
        end = self.at(node.end_lineno or node.lineno, node.end_col_offset or 0)
        return self.at(node.lineno, node.col_offset), end

    def code(self, node: Positioned) -> str:
        """Return a piece of syntax as it is written."""
        start, end = self.span(node)
        return self.text[start:end]

    def swap(self, node: Positioned, new: str) -> Splice:
        """Return the splice that replaces a piece of syntax."""
        start, end = self.span(node)
        return Splice(start, end, new)

    def plain_string(self, node: ast.expr | None) -> str | None:
        """Return the value of a single string literal without prefix or escapes, else None."""
        if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
            return None
        value = node.value
        return value if self.code(node) in (f"'{value}'", f'"{value}"') else None

    @property
    def quote(self) -> str:
        """The quotes that the file uses for most of its strings."""
        text = self.text.replace('"""', "").replace("'''", "")
        return '"' if text.count('"') > text.count("'") else "'"

    def before(self, line: int, *rows: str) -> Splice:
        """Return the splice that inserts whole lines before a line (after the last: at the end).

        A last line without a line end gets one, since another line follows it now.
        """
        start = self.start_of(line)
        glue = self.newline if start and self.text[start - 1] not in "\r\n" else ""
        return Splice(start, start, glue + "".join(row + self.newline for row in rows))

    def without(self, line: int) -> Splice:
        """Return the splice that removes a whole line."""
        return Splice(self.start_of(line), self.start_of(line + 1), "")

    def spliced(self, splices: Iterable[Splice]) -> bytes | None:
        """Return the file's bytes with the splices; None if they overlap or cannot be encoded."""
        kept: list[str] = []
        done = 0
        for splice in sorted(splices, key=lambda s: (s.start, s.end)):
            if splice.start < done:
                return None
            kept += (self.text[done : splice.start], splice.new)
            done = splice.end
        kept.append(self.text[done:])
        try:
            return self.mark + "".join(kept).encode(self.encoding)
        except UnicodeError:
            return None


def indent_of(line: str) -> str:
    """Return the spaces and tabs at the start of a line."""
    return line[: len(line) - len(line.lstrip(" \t"))]


def read_text(found: bytes | None, encoding: str = "utf-8") -> SourceText | None:
    """Return a file's text; None if writing it again would not give the same bytes."""
    if found is None or len(found) > MOST_BYTES or b"\0" in found:
        return None
    mark = BOM if found.startswith(BOM) else b""
    name = "utf-8" if mark else encoding
    try:
        text = found[len(mark) :].decode(name)
        same = mark + text.encode(name) == found
    except UnicodeError:
        return None
    return SourceText(text, name, mark) if same else None


def read_source(found: bytes | None) -> SourceText | None:
    """Return a Python file's text in the encoding that it declares (PEP 263), or None."""
    if found is None:
        return None
    try:
        declared, _ = tokenize.detect_encoding(io.BytesIO(found).readline)
        name = codecs.lookup(declared).name
    except (SyntaxError, LookupError):
        return None
    name = name.removesuffix("-sig")
    return read_text(found, name) if ENCODINGS.fullmatch(name) else None
