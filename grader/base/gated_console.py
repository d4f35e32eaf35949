"""The console for output with styles: it escapes untrusted text and keeps our styles.

(rich removes a few control characters from a text, but no escape sequences and bidi overrides.)
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, TextIO, cast

from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment

from grader.base.gate import Readable, behind
from grader.base.plain_text import visible


class Code:
    """A line of code after its lead: its tabs stay tabs, so that it can be copied."""

    def __init__(self, lead: tuple[str, str], line: tuple[str, str]) -> None:
        self._parts = (lead, line)

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> Iterator[Segment]:
        """Yield the two parts with their styles."""
        del options
        for text, style in self._parts:
            yield Segment(text, console.get_style(style) if style else None)
        yield Segment.line()


class GatedConsole(Console):
    """A console on `file`; markup and emoji codes are plain text unless the options enable them."""

    def __init__(self, file: TextIO, **options: Any) -> None:
        plain: dict[str, Any] = {"markup": False, "emoji": False, "highlight": False}
        super().__init__(file=cast("TextIO", Readable(behind(file))), **(plain | options))

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterable[Segment]:
        """Render an object into segments, with everything escaped except rich's own control codes."""
        tabs = isinstance(renderable, Code)
        for segment in super().render(renderable, options):
            yield segment if segment.control else _shown(segment, tabs=tabs)


def _shown(segment: Segment, *, tabs: bool) -> Segment:
    return segment._replace(text=visible(segment.text, tabs=tabs))
