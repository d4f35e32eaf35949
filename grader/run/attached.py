"""Connects a person's terminal with a command on a pseudo-terminal in the sandbox."""

from __future__ import annotations

import contextlib
import fcntl
import os
import re
import select
import signal
import struct
import termios
import threading
import tty
from collections.abc import Callable, Iterator

from grader.run.terminal import without_codes
from grader.sandbox.base import Console

STEP_SECONDS = 0.5  # between two looks whether the command has ended
END_SECONDS = 2.0  # for the rest of the output after its end
# strings that a terminal takes as commands: OSC (title, clipboard), DCS, SOS, PM, APC (ECMA-48, 5.6)
STRINGS = re.compile(
    rb"(?:\x1b[\]PX^_]|\xc2[\x9d\x90\x98\x9e\x9f]).*?(?:\x07|\x1b\\|\xc2\x9c)", re.DOTALL
)
OPEN = re.compile(rb"(?:\x1b(?:[\]PX^_].*)?|\xc2(?:[\x9d\x90\x98\x9e\x9f].*)?)\Z", re.DOTALL)
LONGEST = 65_536  # bytes of such a string whose end is waited for


class Harmless:
    """Leaves out of a command's output what could change the person's clipboard or title."""

    def __init__(self) -> None:
        self._rest = b""

    def __call__(self, data: bytes) -> bytes:
        """Return what can be shown so far."""
        text = STRINGS.sub(b"", self._rest + data)
        begun = OPEN.search(text)
        if begun is None:
            self._rest = b""
            return text
        self._rest = text[begun.start() :] if len(text) - begun.start() < LONGEST else b""
        return text[: begun.start()]


def attach(console: Console, *, keyboard: int, screen: int) -> int:
    """Pass keys and output on until the command ends; return its exit status.

    `keyboard` and `screen` are the descriptors of the person's terminal.
    """
    harmless = Harmless()
    with _raw(keyboard), _size_of(screen, console.resize), _typing(keyboard, console):
        while console.poll() is None:
            if console.wait(STEP_SECONDS):
                _show(screen, harmless(console.read()))
        while console.wait(0) and (rest := console.read()):
            _show(screen, harmless(rest))
    return _status(console)


def follow(console: Console, show: Callable[[str], None]) -> int:
    """Show the output of a command line by line, without colours, until it ends.

    Return its exit status.
    """
    rest = b""

    def take() -> None:
        nonlocal rest
        *lines, rest = (rest + console.read()).split(b"\n")
        for line in lines:
            show(_plain(line))
        if len(rest) > LONGEST:
            show(_plain(rest))
            rest = b""

    while console.poll() is None:
        if console.wait(STEP_SECONDS):
            take()
    while console.wait(0) and (more := console.read()):
        rest += more
    for line in rest.splitlines():
        show(_plain(line))
    return _status(console)


def _plain(line: bytes) -> str:
    return without_codes(line.decode("utf-8", errors="replace")).rstrip("\r")


def _status(console: Console) -> int:
    status, ended_by = console.poll() or (None, None)
    return status if status is not None else 128 + (ended_by or 0)


def _show(screen: int, data: bytes) -> None:
    while data:
        data = data[os.write(screen, data) :]


@contextlib.contextmanager
def _raw(keyboard: int) -> Iterator[None]:
    """Pass each key on at once, Ctrl+C included; the terminal is as before afterwards."""
    before = termios.tcgetattr(keyboard)
    try:
        tty.setraw(keyboard)
        yield
    finally:
        termios.tcsetattr(keyboard, termios.TCSADRAIN, before)


@contextlib.contextmanager
def _size_of(screen: int, resize: Callable[[int, int], None]) -> Iterator[None]:
    """Keep the size of the command's terminal that of the person's."""

    def tell(*_: object) -> None:
        with contextlib.suppress(OSError):
            size = fcntl.ioctl(screen, termios.TIOCGWINSZ, b"\0" * 8)
            rows, columns = struct.unpack("hhhh", size)[:2]
            if rows > 0 and columns > 0:
                resize(rows, columns)

    before = signal.signal(signal.SIGWINCH, tell)
    try:
        tell()
        yield
    finally:
        signal.signal(signal.SIGWINCH, before)


@contextlib.contextmanager
def _typing(keyboard: int, console: Console) -> Iterator[None]:
    """Send keys from another thread: both ends are waited for at once."""
    stop, stopped = os.pipe()

    def send() -> None:
        with contextlib.suppress(OSError):
            while stop not in (ready := select.select([keyboard, stop], [], [])[0]):
                if keyboard in ready:
                    keys = os.read(keyboard, 1024)
                    if not keys:
                        return
                    console.type(keys)

    thread = threading.Thread(target=send, daemon=True)
    thread.start()
    try:
        yield
    finally:
        os.close(stopped)
        thread.join(END_SECONDS)
        os.close(stop)
