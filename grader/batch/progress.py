"""The progress of a class run: a bar with the time left on a terminal, plain lines elsewhere."""

from __future__ import annotations

import time
from types import TracebackType
from typing import TYPE_CHECKING, TextIO

from grader.base.gate import gate
from grader.base.plain_text import one_line
from grader.base.stream import is_terminal
from grader.batch.run import Listener
from grader.batch.work import Done

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

QUIET_SECONDS = 10.0  # between two plain lines
MANY = 500  # attempts between two lines: reading so many takes a while


class ClassProgress(Listener):
    """Shows how far a class run is; a context manager."""

    def __init__(self, file: TextIO) -> None:
        self._file = gate(file)
        self._bar: Progress | None = None
        self._line: TaskID | None = None
        self._total = self._done = self._faults = 0
        self._running: list[str] = []
        self._begin = self._printed = time.monotonic()

    def __enter__(self) -> ClassProgress:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._bar is not None:
            self._bar.stop()
            self._bar = None

    def took_in(self, count: int) -> None:
        """Print a line now and then while the class is read."""
        if count % MANY == 0:
            self._print(f"{count} submissions read ...")

    def begins(self, total: int) -> None:
        """Start the bar, or print a line."""
        self._total = total
        self._begin = self._printed = time.monotonic()
        if total and is_terminal(self._file):
            self._bar = _bar(self._file)
            self._line = self._bar.add_task("", total=total, names="", rest="")
            self._bar.start()
        elif total:
            self._print(f"marking {total} submission{'s' if total > 1 else ''} ...")

    def started(self, name: str) -> None:
        """Show whose submission is being marked."""
        self._running.append(name)
        self._show()

    def finished(self, name: str, done: Done) -> None:
        """Update the number of finished submissions."""
        self._done += 1
        self._faults += done.answer.report is None
        if name in self._running:
            self._running.remove(name)
        now = time.monotonic()
        if self._bar is None and (now - self._printed > QUIET_SECONDS or self._done == self._total):
            self._printed = now
            self._print(f"{self._done} of {self._total} marked{self._words()}")
        self._show()

    def _show(self) -> None:
        if self._bar is not None and self._line is not None:
            names = ", ".join(one_line(name, most=24) for name in self._running[:4])
            self._bar.update(self._line, completed=self._done, names=names, rest=self._words())

    def _words(self) -> str:
        left = self._total - self._done
        words = ""
        if left and self._done:
            seconds = (time.monotonic() - self._begin) / self._done * left
            words = f", about {rough(seconds)} left"
        if self._faults:
            words += f", {self._faults} not marked because the grader failed"
        return words

    def _print(self, text: str) -> None:
        self._file.write(f"{text}\n")
        self._file.flush()


def rough(seconds: float) -> str:
    """Return a rounded duration: 40 s, 12 min, 2.5 h."""
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


def _bar(file: TextIO) -> Progress:
    # importing rich takes 35 ms, which a run with nothing to mark need not pay
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn  # noqa: PLC0415

    from grader.base.gated_console import GatedConsole  # noqa: PLC0415

    return Progress(
        MofNCompleteColumn(),
        BarColumn(bar_width=30),
        TextColumn("marked{task.fields[rest]}", markup=False),
        TextColumn("{task.fields[names]}", style="dim", markup=False),
        console=GatedConsole(file),
        transient=True,
    )
