"""Reads what another program writes into a pipe, and shows it meanwhile, as `tee -i` does."""

from __future__ import annotations

import codecs
import contextlib
import io
import signal
from collections.abc import Iterator
from typing import BinaryIO, TextIO

MOST = 1_000_000  # characters that are kept, at the end: errors come last
CHUNK = 4096  # bytes


@contextlib.contextmanager
def interrupts_ignored() -> Iterator[None]:
    """Within this context, Ctrl+C does not end this process.

    The terminal sends it to both sides of a pipe, but it is meant for the program before the pipe.
    """
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def read_and_echo(source: BinaryIO | None, echo: TextIO) -> str:
    """Return the end of what comes from `source`, written to `echo` as it comes, and a gap."""
    if not isinstance(source, io.BufferedReader):  # standard input is closed
        return ""
    decoder = io.IncrementalNewlineDecoder(codecs.getincrementaldecoder("utf-8")("replace"), True)
    kept = ""
    while chunk := source.read1(CHUNK):
        text = decoder.decode(chunk)
        echo.write(text)
        echo.flush()
        kept = (kept + text)[-MOST:]
    kept += (rest := decoder.decode(b"", final=True))
    echo.write(rest)
    if kept.strip():
        echo.write("\n" if kept.endswith("\n") else "\n\n")
    return kept
