"""A line of code at which a change is tried: its tokens and its open brackets."""

from __future__ import annotations

import re
from dataclasses import dataclass

from grader.package.edit.text import Splice
from grader.package.source.broken_python import BLOCK, Broken

TOKEN = re.compile(
    r"(?P<text>[A-Za-z]{0,2}(?:\"\"\"|'''|\"_*\"|'_*'))|(?P<name>[^\W\d]\w*)|(?P<number>\d[\w.]*)"
    r"|(?P<open>[(\[{])|(?P<close>[)\]}])"
    r"|(?P<sign>->|:=|\*\*|//|[=!<>+\-*/%&|^]=|[^\s\w])"
)
PAIRS = {"(": ")", "[": "]", "{": "}"}
HEAD = re.compile(rf"[ \t]*(?:async[ \t]+)?(?:{BLOCK}|match|case)\b")


@dataclass(frozen=True)
class Token:
    """A token of a line of code, by its columns."""

    kind: str
    text: str
    start: int
    end: int


@dataclass(frozen=True)
class Line:
    """A line at which a change is tried: its code, its tokens, and the brackets open before it."""

    broken: Broken
    number: int
    code: str
    tokens: tuple[Token, ...]
    opened: str

    @property
    def is_head(self) -> bool:
        """Whether it begins a block."""
        return HEAD.match(self.code) is not None and not self.opened

    @property
    def first(self) -> str:
        """Its first word."""
        return self.tokens[0].text if self.tokens else ""

    def change(self, variant: str, cost: float, *edits: tuple[int, int, str]) -> Change:
        """Return a change of some columns of the line."""
        begin = self.broken.code.start_of(self.number)
        splices = tuple(Splice(begin + a, begin + b, new) for a, b, new in edits)
        return Change(variant, cost, self.number, splices)


@dataclass(frozen=True)
class Change:
    """A change, how unusual it is, and the line that it is told of; `other` is one that explains it."""

    variant: str
    cost: float
    number: int
    splices: tuple[Splice, ...]
    other: int = 0


def opened_in(code: str) -> str:
    """Return the brackets that are open at the end of some code."""
    opened: list[str] = []
    for sign in re.findall(r"[()\[\]{}]", code):
        if sign in PAIRS:
            opened.append(sign)
        elif opened and PAIRS[opened[-1]] == sign:
            opened.pop()
    return "".join(opened)
