"""A gate before the terminal, so that untrusted text cannot control it.

While a command runs (`gated_output`), standard output and standard error are gates: whatever is
printed on them, also by a library, a warning or a traceback, has its control characters escaped
and its length bounded. Only pages of our own renderers bypass the gate (`behind`), because of their
styles; their text is escaped in their console (`grader.base.gated_console`).
"""

from __future__ import annotations

import contextlib
import io
import os
import sys
from collections.abc import Iterator, Mapping
from typing import BinaryIO, TextIO, cast

from grader.base.plain_text import bounded, encodable, simpler

COERCED = ("C.UTF-8", "C.utf8", "UTF-8")  # PEP 538


class Gate(io.TextIOBase):
    """A text stream to which only visible text, newlines and spaces are written.

    It has no `buffer`: to write bytes for another program, use `bytes_of`.
    """

    def __init__(self, behind: TextIO) -> None:
        self.behind = behind

    def write(self, text: str) -> int:
        """Write the text, escaped and bounded; return the number of its characters."""
        self.behind.write(readable(bounded(text), self.behind))
        return len(text)

    def flush(self) -> None:
        """Flush the stream behind the gate."""
        self.behind.flush()

    def close(self) -> None:
        """Do nothing: the stream behind the gate belongs to the caller."""

    def writable(self) -> bool:
        """Return True."""
        return True

    def fileno(self) -> int:
        """Return the stream's file descriptor."""
        return self.behind.fileno()

    def isatty(self) -> bool:
        """Whether the stream behind the gate is a terminal."""
        return self.behind.isatty()

    @property
    def encoding(self) -> str:  # type: ignore[override]
        """The stream's encoding."""
        return getattr(self.behind, "encoding", None) or "utf-8"


class Readable(io.TextIOBase):
    """A stream for our own renderers to which only what it can show is written (`readable`)."""

    def __init__(self, behind: TextIO) -> None:
        self._to = behind

    def write(self, text: str) -> int:
        """Write the text; return the number of its characters."""
        self._to.write(readable(text, self._to))
        return len(text)

    def flush(self) -> None:
        """Flush the stream."""
        self._to.flush()

    def fileno(self) -> int:
        """Return the stream's file descriptor."""
        return self._to.fileno()

    def isatty(self) -> bool:
        """Whether the stream is a terminal."""
        return self._to.isatty()

    @property
    def encoding(self) -> str:  # type: ignore[override]
        """The stream's encoding."""
        return getattr(self._to, "encoding", None) or "utf-8"


def gate(file: TextIO) -> TextIO:
    """Return a gate before a stream; the stream itself if it is a gate."""
    return file if isinstance(file, Gate) else cast("TextIO", Gate(file))


def behind(file: TextIO) -> TextIO:
    """Return the stream behind a gate; only for pages and consoles of our own renderers."""
    return file.behind if isinstance(file, Gate) else file


def bytes_of(file: TextIO) -> BinaryIO:
    """Return the stream for bytes that another program reads; it must not be a terminal."""
    return behind(file).buffer


def show(page: str, file: TextIO) -> None:
    """Write a page of our own renderers, with its styles."""
    out = behind(file)
    out.write(readable(page, out))
    out.flush()


def readable(text: str, file: TextIO) -> str:
    """Return a text that a stream can encode and, if it is a terminal, that the terminal can show.

    A terminal without UTF-8 gets punctuation in ASCII: Python writes UTF-8 even in the locale C
    (PEP 538 and 540).
    """
    if not text.isascii() and not is_utf8(os.environ) and _is_terminal(file):
        text = simpler(text)
    return encodable(text, getattr(file, "encoding", None))


def is_utf8(environment: Mapping[str, str]) -> bool:
    """Whether the locale of the environment has the encoding UTF-8.

    Python itself sets LC_CTYPE to one of COERCED in the locale C, so these say nothing.
    """
    names = ("LC_ALL", "LC_CTYPE", "LANG")
    locales = [environment.get(name, "") for name in names]
    if locales[1] in COERCED:
        locales[1] = ""
    locale = next(filter(None, locales), "")
    return "utf8" in locale.lower().replace("-", "")


def _is_terminal(file: TextIO) -> bool:
    try:
        return file.isatty()
    except ValueError:  # it is closed
        return False


@contextlib.contextmanager
def gated_output() -> Iterator[None]:
    """Put gates before standard output and standard error while the block runs."""
    kept = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = gate(kept[0]), gate(kept[1])
    try:
        yield
    finally:
        sys.stdout, sys.stderr = kept
