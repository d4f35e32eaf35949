"""The console for output with styles: it escapes untrusted text and keeps our styles.

(rich removes a few control characters from a text, but no escape sequences and bidi overrides.)
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, TextIO, cast

from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment

from grader.base.gate import Readable, behind
from grader.base.plain_text import visible


class GatedConsole(Console):
    """A console on `file`; markup and emoji codes are plain text unless the options enable them."""

    def __init__(self, file: TextIO, **options: Any) -> None:
        plain: dict[str, Any] = {"markup": False, "emoji": False, "highlight": False}
        super().__init__(file=cast("TextIO", Readable(behind(file))), **(plain | options))

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterable[Segment]:
        """Render an object into segments, with everything escaped except rich's own control codes."""
        for segment in super().render(renderable, options):
            yield segment if segment.control else segment._replace(text=visible(segment.text))
