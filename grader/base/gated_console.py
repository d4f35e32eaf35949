"""The console of all that is printed with styles: its text passes the gate, the styles are ours.

(rich takes a few control characters out of a text, but no escape sequences and no bidi overrides.)
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, TextIO

from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment

from grader.base.gate import behind
from grader.base.plain_text import visible


class GatedConsole(Console):
    """A console on `file`, with markup and emoji codes as plain text unless they are asked for."""

    def __init__(self, file: TextIO, **options: Any) -> None:
        plain: dict[str, Any] = {"markup": False, "emoji": False, "highlight": False}
        super().__init__(file=behind(file), **(plain | options))

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterable[Segment]:
        """Render an object into segments; all but rich's own control codes is made visible."""
        for segment in super().render(renderable, options):
            yield segment if segment.control else segment._replace(text=visible(segment.text))
