"""What happens while the lab is watched: keys, changed files, another size of the terminal."""

from __future__ import annotations

import contextlib
import os
import select
import signal
import sys
import termios
import threading
import tty
from collections.abc import Collection, Iterator
from pathlib import Path

from lab.guide.progress import FILE, FOLDER, LESSON_FILE

IGNORED = {"build", "log", "__pycache__", ".git", ".vscode"}
DEBOUNCE = 100  # ms in which further changes belong to the same event
STEP = 50  # ms without a change that end an event
FIRST = 100  # ms after which the watch says that it runs: what changed before is looked at then
CHANGED = 0  # no signal has this number
KEPT = ("terminal", FILE, LESSON_FILE)  # of the folder .lab


def counts(path: Path, workspace: Path, kept: Collection[str] = KEPT) -> bool:
    """Whether the guide looks again when this file changes; `kept` are those of the folder .lab."""
    parts = path.relative_to(workspace).parts
    if parts[:1] == (FOLDER,):
        return parts[-1] in kept and len(parts) == 2
    return not IGNORED.intersection(parts)


class Events:
    """An iterator of events: a key, `changed`, or `resize`."""

    def __init__(self, workspace: Path, *, tick: float) -> None:
        self._workspace = workspace
        self._tick = tick
        self._input = sys.stdin.fileno()
        self._heard, self._say = os.pipe()  # numbers of signals, and CHANGED
        os.set_blocking(self._say, False)
        self._stop = threading.Event()
        self._before = termios.tcgetattr(self._input)

    def __iter__(self) -> Iterator[str]:
        while True:
            ready, _, _ = select.select([self._input, self._heard], [], [], self._tick)
            if self._input in ready:
                key = os.read(self._input, 1).decode("utf-8", "replace")
                if key:  # (Ctrl+C discards the keys before it)
                    yield key.lower()
            elif self._heard in ready:
                for each in dict.fromkeys(os.read(self._heard, 1024)):
                    if each == signal.SIGINT:
                        raise KeyboardInterrupt
                    if each in (signal.SIGWINCH, CHANGED):
                        yield "resize" if each == signal.SIGWINCH else "changed"
            else:
                yield "changed"

    @contextlib.contextmanager
    def paused(self) -> Iterator[None]:
        """Give the terminal and Ctrl+C their usual settings, for a command that uses them."""
        self.restore()
        try:
            yield
        finally:
            self._take()

    def start(self) -> None:
        """Read single keys, and watch the files."""
        self._take()
        signal.signal(signal.SIGWINCH, lambda *_: None)
        threading.Thread(target=self._watch, daemon=True).start()

    def _take(self) -> None:
        # a signal may reach another thread: only this wakes `select` then
        signal.set_wakeup_fd(self._say, warn_on_full_buffer=False)
        signal.signal(signal.SIGINT, lambda *_: None)
        tty.setcbreak(self._input, termios.TCSADRAIN)
        mode = termios.tcgetattr(self._input)
        mode[6][termios.VMIN] = 0  # a read never waits
        termios.tcsetattr(self._input, termios.TCSADRAIN, mode)

    def restore(self) -> None:
        """Give the terminal and Ctrl+C their usual settings."""
        signal.set_wakeup_fd(-1)
        signal.signal(signal.SIGINT, signal.default_int_handler)
        termios.tcsetattr(self._input, termios.TCSADRAIN, self._before)

    def close(self) -> None:
        """Stop watching."""
        self._stop.set()
        signal.signal(signal.SIGWINCH, signal.SIG_DFL)
        self.restore()

    def _watch(self) -> None:
        from watchfiles import watch  # noqa: PLC0415 - only a watch needs it

        changes = watch(
            self._workspace,
            watch_filter=lambda _, path: counts(Path(path), self._workspace),
            debounce=DEBOUNCE,
            step=STEP,
            stop_event=self._stop,
            rust_timeout=FIRST,
            yield_on_timeout=True,
            raise_interrupt=False,
            ignore_permission_denied=True,
        )
        is_first = True
        with contextlib.suppress(OSError):
            for found in changes:
                if found or is_first:
                    os.write(self._say, bytes([CHANGED]))
                is_first = False


@contextlib.contextmanager
def events(workspace: Path, *, tick: float) -> Iterator[Events]:
    """Yield the events of this terminal and a workspace; `changed` also comes each `tick` seconds."""
    found = Events(workspace.resolve(), tick=tick)
    found.start()
    try:
        yield found
    finally:
        found.close()
