"""Characters of a text that cannot be seen, or that look like others."""

from __future__ import annotations

import ast
import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass

from grader.base.lookalikes import LATIN
from grader.package.source.module import Module
from grader.package.source.node import NodeSource

DASHES_AND_QUOTES = {**dict.fromkeys("‐‑‒–—−", "-"), **dict.fromkeys("‘’", "'")}


def plain(sign: str) -> str:
    """Return what an English keyboard types for a character; itself if there is nothing."""
    if sign.isascii():
        return sign
    if unicodedata.category(sign) == "Zs":
        return " "
    if unicodedata.category(sign) == "Cf":
        return ""
    known = LATIN.get(sign) or DASHES_AND_QUOTES.get(sign) or unicodedata.normalize("NFKC", sign)
    return known if known.isascii() else sign


def plain_text(text: str) -> str:
    """Return a text with the characters of an English keyboard."""
    return "".join(map(plain, text))


def joined(text: str) -> str:
    """Return a text without its blanks."""
    return "".join(text.split())


def typed(code: str, head: str) -> str:
    """Return a string's code with the characters of an English keyboard, and the blanks of `head`.

    Some characters of other keyboards are as wide as one and a blank, so the blank is often missing.
    """
    letters = r"\s*".join(map(re.escape, joined(head)))
    return re.sub(rf"{letters}\s*" if letters else r"(?!)", lambda _: head, plain_text(code))


@dataclass(frozen=True)
class OddSign:
    """A character: of which sort, and the words beside it.

    `sort` is "space", "nothing" (it has no width) or "letter". `word` is the word with it; `before`
    and `after` are the words on both sides.
    """

    sign: str
    sort: str
    word: str
    before: str
    after: str

    @property
    def code(self) -> str:
        """The number of the character in Unicode, and its name."""
        return f"U+{ord(self.sign):04X} {unicodedata.name(self.sign, '')}".strip()


def odd_signs(text: str) -> list[OddSign]:
    """Return the characters of a text that look like others or like nothing."""
    found = []
    for at, sign in enumerate(text):
        new = plain(sign)
        if new == sign:
            continue
        sort = {" ": "space", "": "nothing"}.get(new, "letter")
        head = re.split(r"\s", text[:at])
        tail = re.split(r"\s", text[at + 1 :])
        word = f"{head[-1]}{sign}{tail[0]}"
        before = next((w for w in reversed(head) if w), "")
        after = next((w for w in tail if w), "")
        found.append(OddSign(sign, sort, word, before, after))
    return found


def strings_with(
    source: NodeSource, signs: set[str]
) -> list[tuple[Module, ast.Constant | ast.JoinedStr]]:
    """Return the strings of the node's functions in which one of these characters is typed."""
    return [
        (module, node) for module, node in _strings(source) if signs & set(module.text.code(node))
    ]


def _strings(source: NodeSource) -> Iterator[tuple[Module, ast.Constant | ast.JoinedStr]]:
    """Yield the strings that are values, an f-string as a whole."""
    for node in source.own_nodes:
        if isinstance(node, ast.Constant) and not isinstance(node.value, str):
            continue
        if not isinstance(node, ast.Constant | ast.JoinedStr):
            continue
        module = source.module_of(node)
        around = module.parents.get(node)
        if not isinstance(around, ast.JoinedStr | ast.FormattedValue | ast.Expr):
            yield module, node


def broken_texts(source: NodeSource) -> list[tuple[Module, ast.Constant | ast.JoinedStr]]:
    """Return the strings of the functions that have a line end written in them."""
    return [
        (module, node)
        for module, node in _strings(source)
        if source.function_around(node) is not None and "\\n" in module.text.code(node)
    ]
