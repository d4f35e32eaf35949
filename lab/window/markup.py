"""The Markdown of a lesson as data: the page makes elements of it, never HTML of a text.

A node is a text, or a list of a tag, its attributes and its nodes: ["p", {}, ["Save the ", …]].
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from markdown_it import MarkdownIt
from markdown_it.token import Token

from grader.report.commands import is_command

Node = Any
TAGS = {
    *("p", "h1", "h2", "h3", "h4", "ul", "ol", "li", "em", "strong", "blockquote", "hr", "br"),
    *("table", "thead", "tbody", "tr", "th", "td", "code", "pre", "a"),
}
LINKS = ("https://", "http://")


def markup(text: str) -> list[Node]:
    """Return Markdown as nodes. A block of code is one node `code`, with its lines.

    Each line says whether it is a command that a terminal takes.
    """
    return _nested(iter(MarkdownIt("commonmark").enable("table").parse(text)))


def _nested(tokens: Iterator[Token]) -> list[Node]:
    found: list[Node] = []
    for token in tokens:
        if token.nesting < 0:
            break
        if token.nesting > 0:
            below = _nested(tokens)
            if token.hidden:  # the paragraph of a short list's entry
                found += below
            else:
                found.append([_tag(token.tag), _attributes(token), below])
        else:
            found += _single(token)
    return found


def _single(token: Token) -> Sequence[Node]:
    if token.type == "inline":
        return _nested(iter(token.children or ()))
    if token.type in ("fence", "code_block"):
        lines = token.content.rstrip("\n").split("\n")
        return [["code-lines", {}, [[line, is_command(line)] for line in lines]]]
    if token.type == "code_inline":
        command = (
            {"command": "yes"} if is_command(token.content) and token.content.count(" ") > 1 else {}
        )
        return [["code", command, [token.content]]]
    if token.type in ("softbreak", "text"):
        return [token.content or " "]
    if token.type == "image":
        return [token.content]
    if token.type.startswith("html_"):
        return [] if token.content.startswith("<!--") else [token.content]
    return [[_tag(token.tag), {}, []]]


def _tag(tag: str) -> str:
    return tag if tag in TAGS else "span"


def _attributes(token: Token) -> dict[str, str]:
    address = str(token.attrGet("href") or "")
    return {"href": address} if address.startswith(LINKS) else {}
