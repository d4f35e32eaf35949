"""The calling terminal: signals while something else has it, and having it back afterwards."""

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
    """Leave Ctrl+C to what runs on the terminal; what is started in the block ignores it too."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


@contextlib.contextmanager
def foreground_again() -> Iterator[None]:
    """Take the terminal back at the end.

    A shell in a PID namespace makes itself the terminal's foreground group, and cannot hand it
    back at its end: the group that it took it from has no number in there.
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
def raw() -> Iterator[None]:
    """Hand every key on as it is, Ctrl+C included; the terminal is as before afterwards."""
    before = termios.tcgetattr(TERMINAL)
    try:
        tty.setraw(TERMINAL)
        yield
    finally:
        termios.tcsetattr(TERMINAL, termios.TCSADRAIN, before)


@contextlib.contextmanager
def on_new_size(tell: Callable[[], None]) -> Iterator[None]:
    """Call `tell` whenever the terminal's window has another size."""

    def changed(number: int, frame: FrameType | None) -> None:
        del number, frame
        tell()

    before = signal.signal(signal.SIGWINCH, changed)
    try:
        yield
    finally:
        signal.signal(signal.SIGWINCH, before)
