"""Progress during the work: a live line on a terminal, one line per stage elsewhere."""

from __future__ import annotations

import contextlib
import io
import sys
import time
from types import TracebackType
from typing import TYPE_CHECKING, TextIO, cast

from grader.base.gate import behind, gate
from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from grader.base.plain_text import encodable, one_line
from grader.base.stream import is_terminal, takes_styles, width_of
from grader.report.events import (
    CheckFinished,
    CheckStarted,
    Event,
    Note,
    StageFinished,
    StageStarted,
    TickSeen,
)
from grader.report.notice import for_terminal

if TYPE_CHECKING:
    from rich.live import Live
    from rich.text import Text

REFRESH = 8  # times a second
SPINNER = "|/-\\"


class LiveProgress:
    """A listener that shows stage, check and elapsed time on a terminal (standard error).

    Used as a context manager; at the end the line is removed and the cursor is visible. If `file`
    is not a terminal, or `TERM=dumb`, each stage and note is one plain line and nothing else is
    printed. A closed terminal never disturbs the work: what cannot be written is dropped.
    """

    def __init__(
        self, file: TextIO | None = None, *, show_hidden: bool = False, lang: str = "en"
    ) -> None:
        self._file = gate(file or sys.stderr)
        self._show_hidden = show_hidden
        self._live: Live | None = None
        self._translate = Translator(lang)
        self._stage = self._translate(say("Starting"))
        self._hidden = self._translate(say("a hidden check"))
        self._check = ""
        self._tick = ""
        self._begin = time.monotonic()

    def __enter__(self) -> LiveProgress:
        self._begin = time.monotonic()
        if is_terminal(self._file):
            self._live = self._start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if self._live is not None:
            self._live.stop()
            self._live = None

    def __call__(self, event: Event) -> None:
        """Handle one event of marking."""
        match event:
            case StageStarted(title=title):
                self._stage, self._check, self._tick = one_line(title, most=80), "", ""
                self._begin = time.monotonic()
                if self._live is None:
                    self._print(f"{self._stage} ...\n")
            case StageFinished():
                self._check = self._tick = ""
            case CheckStarted(title=title, visibility=visibility):
                seen = self._show_hidden or visibility == "visible"
                self._check = one_line(title, most=100) if seen else self._hidden
            case CheckFinished():
                self._check = ""
            case TickSeen(text=text):
                self._tick = one_line(text, most=60)
            case Note(text=text):
                note = one_line(self._translate(text), most=500)
                if self._live is not None:
                    wrapped = for_terminal(note, width_of(self._file))
                    self._live.console.print(wrapped, soft_wrap=True)
                else:
                    self._print(f"{note}\n")

    def _print(self, text: str) -> None:
        stream = _LossyStream(self._file)
        stream.write(text)
        stream.flush()

    def _line(self) -> Text:
        """Return the current line; rich calls this at each refresh, in its own thread."""
        from rich.text import Text  # noqa: PLC0415

        now = time.monotonic()
        spinner = SPINNER[int(now * REFRESH) % len(SPINNER)]
        line = Text.assemble(
            (f"{spinner} {self._stage}", "bold cyan"), f"  {int(now - self._begin)} s"
        )
        for part in (self._tick, self._check):
            line.append(f"  {part}" if part else "")
        line.truncate(max(width_of(self._file) - 1, 1))
        return line

    def _start(self) -> Live:
        from rich.live import Live  # noqa: PLC0415 - only needed on a terminal

        from grader.base.gated_console import GatedConsole  # noqa: PLC0415

        styled = takes_styles(self._file)
        console = GatedConsole(
            cast("TextIO", _LossyStream(behind(self._file))),
            force_terminal=True,
            force_jupyter=False,
            color_system="standard" if styled else None,
            no_color=not styled,
        )
        live = Live(
            get_renderable=self._line,
            console=console,
            refresh_per_second=REFRESH,
            transient=True,
            redirect_stdout=False,  # it may be a pipe, and the live line is on standard error
            redirect_stderr=False,
        )
        live.start()
        console.show_cursor(True)  # if killed now, the terminal is still usable
        return live


class _LossyStream(io.TextIOBase):
    """A stream that never raises: what it cannot write is dropped."""

    def __init__(self, file: TextIO) -> None:
        self._to = file

    def write(self, text: str) -> int:
        with contextlib.suppress(OSError, ValueError):
            self._to.write(encodable(text, self._to.encoding))
        return len(text)

    def flush(self) -> None:
        with contextlib.suppress(OSError, ValueError):
            self._to.flush()

    def isatty(self) -> bool:
        return self._to.isatty()
