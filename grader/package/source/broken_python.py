"""A Python file with an error, and what is found at the error."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

from grader.package.edit.text import SourceText, Splice
from grader.package.source.python import PythonFault, parse_python

Cause = Literal["pasted", "document", "language", "signs"]
LONGEST = 500
"""Characters of a line that is examined: some patterns take quadratic time."""
MOST_TRIES = 8
"""How many places of a file are tried for one kind of slip."""
BLOCK = "def|class|if|elif|else|for|while|try|except|finally|with"


@dataclass(frozen=True)
class Slip:
    """A slip: its cause and variant, its line, what is written, and the line as it should be.

    `other` is the number of another line that explains it. `fixed` is the file after the change; None
    if more than one change is possible. Python may stop at another line of it.
    """

    cause: Cause
    variant: str
    line: int
    found: str
    wanted: str = ""
    fixed: bytes | None = None
    other: int = 0


@dataclass(frozen=True)
class Broken:
    """A file that Python cannot read: its text, its code without strings, and the line."""

    source: SourceText
    code: SourceText
    fault: PythonFault
    number: int

    @property
    def line(self) -> str:
        """The code of the line at which Python stops."""
        line = self.code.line(self.number)
        return line if len(line) <= LONGEST else ""

    def changed(self, *splices: Splice) -> bytes | None:
        """Return the file after a change if Python then reads further; None if it does not."""
        new = self.source.spliced(splices)
        after = fault_of(new) if new is not None else self.fault
        if new is None or after is None:
            return new
        return new if after.line is not None and after.line > self.number else None

    def within(self, start: int, end: int, new: str) -> Splice:
        """Return the splice that replaces columns of the line at which Python stops."""
        begin = self.code.start_of(self.number)
        return Splice(begin + start, begin + end, new)

    def expanded(self, match: re.Match[str], template: str) -> str:
        """Return a template with the groups of a match in the line, as they are written there."""
        written = self.source.line(self.number)

        def value(part: re.Match[str]) -> str:
            start, end = match.span(part["name"])
            return written[start:end] if start >= 0 else ""

        return re.sub(r"\\g<(?P<name>\w+)>", value, template)

    def slip(
        self, cause: Cause, variant: str, found: str, *splices: Splice, fixed: bytes | None = None
    ) -> Slip:
        """Return a slip of the line at which Python stops; `splices` show how it should be."""
        start, end = self.code.start_of(self.number), self.code.end_of(self.number)
        wanted = self.source.text[start:end]
        for splice in sorted(splices, key=lambda s: s.start, reverse=True):
            wanted = wanted[: splice.start - start] + splice.new + wanted[splice.end - start :]
        return Slip(cause, variant, self.number, found.strip(), wanted.strip(), fixed)


def fault_of(found: bytes) -> PythonFault | None:
    """Return why Python cannot read a file; None if it can."""
    try:
        parse_python(found)
    except PythonFault as fault:
        return fault
    return None
