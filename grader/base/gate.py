"""The gate: every text on its way to a terminal passes here, so that none from outside steers it.

A command runs behind it (`gated_output`): standard output and standard error are gates, and what is
printed on them, also by a library, by a warning or in a traceback, is made visible and is not
endless. Only what our own renderers have made goes past it (`behind`), with its styles; its text
passed the gate in their console (`grader.base.gated_console`).
"""

from __future__ import annotations

import contextlib
import io
import sys
from collections.abc import Iterator
from typing import BinaryIO, TextIO, cast

from grader.base.plain_text import bounded, encodable


class Gate(io.TextIOBase):
    """A text stream on which nothing is written but visible text, newlines and blanks.

    It has no `buffer`: who has bytes for a program to read asks for `bytes_of`.
    """

    def __init__(self, behind: TextIO) -> None:
        self.behind = behind

    def write(self, text: str) -> int:
        """Write the text as it may be shown; return how many characters of it were taken: all."""
        self.behind.write(encodable(bounded(text), self.encoding))
        return len(text)

    def flush(self) -> None:
        """Hand on what was written."""
        self.behind.flush()

    def close(self) -> None:
        """Leave the stream as it is: it is not ours to close."""

    def writable(self) -> bool:
        """It is there to be written to."""
        return True

    def fileno(self) -> int:
        """Return the stream's descriptor."""
        return self.behind.fileno()

    def isatty(self) -> bool:
        """Whether a terminal is behind it."""
        return self.behind.isatty()

    @property
    def encoding(self) -> str:  # type: ignore[override]
        """The stream's encoding."""
        return getattr(self.behind, "encoding", None) or "utf-8"


def gate(file: TextIO) -> TextIO:
    """Return a stream's gate: itself if it is one."""
    return file if isinstance(file, Gate) else cast("TextIO", Gate(file))


def behind(file: TextIO) -> TextIO:
    """Return the stream behind a gate, for pages and consoles of our own making and nothing else."""
    return file.behind if isinstance(file, Gate) else file


def bytes_of(file: TextIO) -> BinaryIO:
    """Return the stream for what another program reads, byte for byte; no terminal may be there."""
    return behind(file).buffer


def show(page: str, file: TextIO) -> None:
    """Write a page that our own renderers made: its styles reach the terminal."""
    out = behind(file)
    out.write(encodable(page, out.encoding))
    out.flush()


@contextlib.contextmanager
def gated_output() -> Iterator[None]:
    """Put a gate before standard output and standard error while this lasts."""
    kept = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = gate(kept[0]), gate(kept[1])
    try:
        yield
    finally:
        sys.stdout, sys.stderr = kept
