"""The terminals of the page: shells on pseudo-terminals, whose newest output is kept.

A page that is opened again gets the output that it has not seen. A program is read as fast as the
fastest page shows its output, and at any speed while no page is open.

terminado would do the pseudo-terminals, but it neither waits for a slow page nor knows what a page
has seen, and its shells end with the server.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import signal
from collections.abc import Callable
from pathlib import Path

from lab.window.keeper import Shell, set_size
from lab.window.shells import Shells

KEPT = 512 * 1024  # bytes of output
MOST_UNSEEN = 256 * 1024  # bytes that were sent to a page and that it has not shown
PART = 64 * 1024  # bytes that are read or sent at once
MOST_TERMINALS = 12
SMALLEST, LARGEST = 2, 1000  # rows and columns
NONE = -1  # no descriptor
END_SECONDS = 2.0
HANG_UP_SECONDS = 0.05
RESET = b"\x1bc"  # the terminal's own reset: what follows does not depend on what was before


class Output:
    """The newest bytes of an output, by their place in the whole of it.

    They are also in a file in memory, if there is one, from which the next server reads them.
    """

    def __init__(self, memory: int = NONE) -> None:
        self._memory = memory
        self._bytes = bytearray()
        if memory != NONE:
            self._bytes += os.pread(memory, 2 * KEPT, 0)
        self.end = len(self._bytes)

    @property
    def begin(self) -> int:
        """The place of the first byte that is kept."""
        return self.end - len(self._bytes)

    def add(self, data: bytes) -> None:
        """Append bytes, and forget the oldest ones."""
        if self._memory != NONE:
            os.pwrite(self._memory, data, len(self._bytes))
        self._bytes += data
        self.end += len(data)
        if len(self._bytes) > 2 * KEPT:
            del self._bytes[:-KEPT]
            if self._memory != NONE:
                os.pwrite(self._memory, self._bytes, 0)
                os.ftruncate(self._memory, len(self._bytes))

    def part(self, place: int) -> tuple[bytes, int]:
        """Return the bytes from a place on, at most PART, and the place behind them.

        If they are forgotten, what comes instead begins with a reset and a new line's first byte.
        """
        if place >= self.begin:
            start = place - self.begin
            data = bytes(self._bytes[start : start + PART])
            return data, place + len(data)
        line = self._bytes.find(b"\n") + 1
        data = bytes(self._bytes[line : line + PART])
        return RESET + data, self.begin + line + len(data)


class Viewer:
    """One page that shows a terminal: `send` gets its next bytes, `ended` is called at its end."""

    def __init__(
        self, terminal: Terminal, send: Callable[[bytes], None], ended: Callable[[], None]
    ) -> None:
        self._terminal = terminal
        self._send = send
        self.ended = ended
        self._place = terminal.output.begin
        self._unseen = 0

    @property
    def lags(self) -> bool:
        """Whether the page has not shown what it was sent."""
        return self._unseen >= MOST_UNSEEN

    @property
    def waiting(self) -> int:
        """How many bytes there are for it now: the history of a page that has just been opened."""
        return self._terminal.output.end - max(self._place, self._terminal.output.begin)

    def show(self) -> None:
        """Send what is new, as long as the page shows it."""
        while not self.lags and self._place < self._terminal.output.end:
            data, self._place = self._terminal.output.part(self._place)
            self._unseen += len(data)
            self._send(data)

    def took(self, count: int) -> None:
        """Note that the page has shown `count` more bytes."""
        self._unseen = max(self._unseen - count, 0)
        self._terminal.flow()


class Terminal:
    """A shell on a pseudo-terminal; it starts with the size of the first page that shows it."""

    def __init__(self, number: int, shells: Shells, on_end: Callable[[], None]) -> None:
        self.number = number
        self.output = Output()
        self.viewers: set[Viewer] = set()
        self._shells = shells
        self._on_end = on_end
        self._shell: Shell | None = None
        self._fd = NONE
        self._waiting = bytearray()  # typed, and not taken yet
        self._reads = False
        self._loop = asyncio.get_running_loop()

    def start(self, rows: int, columns: int) -> None:
        """Start the shell, which breaks its first lines as the page is wide; once."""
        if self._shell is None:
            self.take(self._shells.open(self.number, *_allowed(rows, columns)))

    def take(self, shell: Shell) -> None:
        """Go on with a shell that runs."""
        self._shell, self._fd = shell, shell.terminal
        self.output = Output(shell.memory)
        os.set_blocking(self._fd, False)
        self.flow()
        self._write()

    def view(self, send: Callable[[bytes], None], ended: Callable[[], None]) -> Viewer:
        """Show the terminal on one more page."""
        viewer = Viewer(self, send, ended)
        self.viewers.add(viewer)
        return viewer

    def leave(self, viewer: Viewer) -> None:
        """Forget a page."""
        self.viewers.discard(viewer)
        self.flow()

    def flow(self) -> None:
        """Send what the pages have room for, and read on if one of them has shown it all."""
        for viewer in self.viewers:
            viewer.show()
        wanted = not self.viewers or not all(viewer.lags for viewer in self.viewers)
        if self._fd == NONE or wanted == self._reads:
            return
        self._reads = wanted
        if wanted:
            self._loop.add_reader(self._fd, self._read)
        else:
            self._loop.remove_reader(self._fd)

    def type(self, text: str) -> None:
        """Type into the terminal."""
        self._waiting += text.encode()
        self._write()

    def resize(self, rows: int, columns: int) -> None:
        """Set the size in characters."""
        self.start(rows, columns)
        if self._fd != NONE:
            set_size(self._fd, *_allowed(rows, columns))

    async def end(self) -> None:
        """Hang up; who does not end then is killed, and the terminal is closed on it.

        Readline looks for a signal and then waits for a key: a signal between the two is kept until
        the next one, so the shell is hung up more than once. At another moment the first signal
        ends it at once, and it does not hang up its jobs.
        """
        if self._shell is None or self._fd == NONE:
            self._on_end()
            return
        with contextlib.suppress(asyncio.TimeoutError):
            await asyncio.wait_for(self._hang_up(self._shell.pid), END_SECONDS)
            return
        for pid in _session(self._shell.pid):
            _signal(pid, signal.SIGHUP, os.kill)
            _signal(pid, signal.SIGCONT, os.kill)
        _signal(self._shell.pid, signal.SIGKILL)
        if self._fd != NONE:
            self._close()

    async def _hang_up(self, group: int) -> None:
        while self._fd != NONE:
            _signal(group, signal.SIGHUP)
            _signal(group, signal.SIGCONT)
            await asyncio.sleep(HANG_UP_SECONDS)

    def _write(self) -> None:
        if self._fd == NONE:
            return
        try:
            while self._waiting:
                del self._waiting[: os.write(self._fd, self._waiting[:PART])]
        except BlockingIOError:
            self._loop.add_writer(self._fd, self._write)
            return
        except OSError:
            self._waiting.clear()
        self._loop.remove_writer(self._fd)

    def _read(self) -> None:
        try:
            data = os.read(self._fd, PART)
        except BlockingIOError:
            return
        except OSError:  # EIO: nobody has the terminal open any more
            data = b""
        if data:
            self.output.add(data)
            self.flow()
        else:
            self._close()

    def _close(self) -> None:
        assert self._shell is not None
        for remove in (self._loop.remove_reader, self._loop.remove_writer):
            remove(self._fd)
        os.close(self._fd)
        os.close(self._shell.memory)
        self._fd = NONE
        self._shells.forget(self.number, self._shell)
        for viewer in list(self.viewers):
            viewer.ended()
        self._on_end()


def _signal(to: int, number: int, kill: Callable[[int, int], None] = os.killpg) -> None:
    with contextlib.suppress(ProcessLookupError):
        kill(to, number)


def _session(leader: int) -> list[int]:
    """Return the processes that a shell has started, which are still in its session."""
    found = []
    for entry in Path("/proc").iterdir():
        with contextlib.suppress(ValueError, ProcessLookupError):
            if os.getsid(int(entry.name)) == leader:
                found.append(int(entry.name))
    return found


def _allowed(rows: int, columns: int) -> tuple[int, int]:
    return min(max(rows, SMALLEST), LARGEST), min(max(columns, SMALLEST), LARGEST)


class Terminals:
    """The terminals by number; `on_change` is called when there is one more or one less."""

    def __init__(self, shells: Shells, on_change: Callable[[], None]) -> None:
        self._shells = shells
        self._on_change = on_change
        self._all: dict[int, Terminal] = {}
        self._last = 0

    def take_kept(self) -> None:
        """Go on with the shells of the server before."""
        for number, shell in self._shells.kept().items():
            self._last = max(self._last, number)
            self._add(number).take(shell)

    @property
    def numbers(self) -> list[int]:
        """The numbers of the terminals that are open."""
        return sorted(self._all)

    def get(self, number: int) -> Terminal | None:
        """Return a terminal; None if it has ended."""
        return self._all.get(number)

    def open(self) -> int:
        """Open one more, and return its number; 0 if there are too many."""
        if len(self._all) >= MOST_TERMINALS:
            return 0
        self._last += 1
        number = self._last
        self._add(number)
        self._on_change()
        return number

    def _add(self, number: int) -> Terminal:
        made = Terminal(number, self._shells, lambda: self._forget(number))
        self._all[number] = made
        return made

    async def close(self, number: int) -> None:
        """Hang one up."""
        terminal = self._all.get(number)
        if terminal is not None:
            await terminal.end()

    async def close_all(self) -> None:
        """Hang all up."""
        await asyncio.gather(*(terminal.end() for terminal in list(self._all.values())))

    def _forget(self, number: int) -> None:
        self._all.pop(number, None)
        self._on_change()
