"""The Markdown of a lesson: in styles for a terminal, or as plain text, with code in quotes."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from rich.cells import cell_len
from rich.markdown import Heading, Markdown, MarkdownElement, Paragraph, TableElement
from rich.table import Table
from rich.text import Text

from grader.report.wrap import breaks
from lab.guide.plain import CODE, quoted

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.console import Console, ConsoleOptions, RenderResult

FIRST_COLUMN = 0.45  # of a line: a table's first column, if no word in it is longer
WIDEST_NAME = 0.7  # of a line: the longest word for which it gets more


class _Table(TableElement):
    """A table of Markdown that cuts no name: the first column is as wide as its longest word."""

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        for table in super().__rich_console__(console, options):
            assert isinstance(table, Table)
            for column in table.columns:
                column.overflow = "fold"
            first = [str(cell) for cell in (table.columns[0].header, *table.columns[0].cells)]
            word = max((cell_len(word) for cell in first for word in cell.split()), default=0)
            if word <= WIDEST_NAME * options.max_width:
                share = int(FIRST_COLUMN * options.max_width)
                table.columns[0].width = max(word, min(share, max(map(cell_len, first))))
            yield table


class _Paragraph(Paragraph):
    """A paragraph whose lines are broken at words, and a longer name after a slash."""

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        del console
        parts = self.text.divide(breaks(self.text.plain, options.max_width))
        for part in parts:
            part.rstrip()
        yield Text("\n").join(parts)


class _PlainHeading(Heading):
    """A heading without lines around it."""

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        del console, options
        yield self.text


class StyledMarkdown(Markdown):
    """The Markdown of a lesson, for a terminal."""

    elements: ClassVar[dict[str, type[MarkdownElement]]] = {
        **Markdown.elements,
        "paragraph_open": _Paragraph,
        "table_open": _Table,
    }


class _PlainMarkdown(StyledMarkdown):
    elements: ClassVar[dict[str, type[MarkdownElement]]] = {
        **StyledMarkdown.elements,
        "heading_open": _PlainHeading,
    }

    def __init__(self, markup: str) -> None:
        super().__init__(markup, hyperlinks=False)
        for token in self.parsed:
            for child in token.children or ():
                if child.type == CODE:
                    child.type, child.tag, child.content = "text", "", quoted(child.content)


def plain_lines(markup: str, console: Console) -> Iterator[str]:
    """Yield the lines of Markdown as plain text, broken at words, in the console's width."""
    options = console.options.update(no_wrap=False, overflow="fold")
    before = ""
    for line in console.render_lines(_PlainMarkdown(markup), options, pad=False):
        text = "".join(segment.text for segment in line).rstrip()
        if text or before:  # (a table has empty lines of its own)
            yield text
        before = text
