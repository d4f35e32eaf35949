"""Context managers for the calling terminal: signals, foreground process group, raw mode, size."""

from __future__ import annotations

import contextlib
import os
import signal
import termios
import tty
from collections.abc import Callable, Iterator
from types import FrameType

TERMINAL = 0  # standard input


@contextlib.contextmanager
def ignoring_interrupts() -> Iterator[None]:
    """Ignore Ctrl+C in this process and in processes started in the block."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


@contextlib.contextmanager
def restoring_foreground() -> Iterator[None]:
    """Make this process group the terminal's foreground group again at the end.

    A shell in a PID namespace makes itself the foreground group and cannot restore the previous
    one, which has no id in its namespace.
    """
    try:
        ours = os.tcgetpgrp(TERMINAL) == os.getpgrp()
    except OSError:
        ours = False
    try:
        yield
    finally:
        if ours:
            before = signal.signal(signal.SIGTTOU, signal.SIG_IGN)
            with contextlib.suppress(OSError):
                os.tcsetpgrp(TERMINAL, os.getpgrp())
            signal.signal(signal.SIGTTOU, before)


@contextlib.contextmanager
def raw_mode() -> Iterator[None]:
    """Put the terminal into raw mode: every key, also Ctrl+C, is read as bytes."""
    before = termios.tcgetattr(TERMINAL)
    try:
        tty.setraw(TERMINAL)
        yield
    finally:
        termios.tcsetattr(TERMINAL, termios.TCSADRAIN, before)


@contextlib.contextmanager
def on_resize(callback: Callable[[], None]) -> Iterator[None]:
    """Call `callback` whenever the size of the terminal changes."""

    def changed(number: int, frame: FrameType | None) -> None:
        del number, frame
        callback()

    before = signal.signal(signal.SIGWINCH, changed)
    try:
        yield
    finally:
        signal.signal(signal.SIGWINCH, before)
