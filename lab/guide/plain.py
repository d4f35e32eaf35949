"""A paragraph of Markdown as plain words, without what styles it for a terminal."""

from __future__ import annotations

from markdown_it import MarkdownIt

CODE, BREAK = "code_inline", "softbreak"  # markdown-it's names for `code` and a new line
MARKDOWN = MarkdownIt()


def plain_words(markup: str) -> str:
    """Return a paragraph of Markdown as one line of plain text, with code in quotes."""
    words = ""
    for token in MARKDOWN.parse(markup):
        for child in token.children or ():
            content = quoted(child.content) if child.type == CODE else child.content
            words += " " if child.type == BREAK else content
    return " ".join(words.split())


def quoted(code: str) -> str:
    """Return code in quotes; what has quotes of its own stays as it is."""
    return code if "'" in code else f"'{code}'"
