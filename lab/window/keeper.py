"""Keeps the shells of the page and its address while its server is started again.

    python -I -S keeper.py LISTENER PROGRAM ARGUMENT...

The server is a large program; this one is small (standard library only) and does nothing but start
shells on pseudo-terminals, hold their ends and their newest output, and start the server again if it
was killed. The two talk by JSON in packets, with descriptors beside them:

- `open` (number, rows, columns, environment, folder) starts a shell; the answer has its `pid`, and
  two descriptors: the terminal, and a file in memory for its output;
- `list` asks for the shells that run, after a new start; `forget` (number) closes one that has ended.
"""

from __future__ import annotations

import contextlib
import fcntl
import json
import os
import pty
import select
import signal
import socket
import struct
import subprocess
import sys
import termios
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

CHANNEL = "LAB_WINDOW_KEEPER"
"""The server's variable with the descriptor of its end."""
DESCRIPTOR = "LAB_WINDOW_DESCRIPTOR"
SHELL = ("bash",)
MOST_BYTES = 200_000  # of a packet
MOST_SHELLS = 64
SHORT_SECONDS = 5.0  # a server that ends so soon has not started
MOST_FAILURES = 3  # in a row
END_SECONDS = 8.0
STOPS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


@dataclass(frozen=True)
class Shell:
    """A running shell: its process, its terminal, and a file in memory for its output."""

    pid: int
    terminal: int
    memory: int


def start_shell(rows: int, columns: int, environment: Mapping[str, str], folder: str) -> Shell:
    """Start a shell on a new pseudo-terminal of a size in characters."""
    pid, terminal = pty.fork()
    if pid == 0:
        try:
            set_size(0, rows, columns)
            for number in (*STOPS, signal.SIGCHLD, signal.SIGPIPE):
                signal.signal(number, signal.SIG_DFL)
            os.chdir(folder)
            os.execvpe(SHELL[0], list(SHELL), dict(environment))  # noqa: S606 - it is one
        finally:
            os._exit(127)
    os.set_inheritable(terminal, False)
    return Shell(pid, terminal, os.memfd_create("terminal"))


def set_size(terminal: int, rows: int, columns: int) -> None:
    """Set a terminal's size in characters."""
    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))


class Keeper:
    """The shells by number, and the server."""

    def __init__(self, listener: int, words: Sequence[str]) -> None:
        self._listener = listener
        self._words = list(words)
        self._shells: dict[int, Shell] = {}
        self._server: subprocess.Popen[bytes] | None = None
        self._channel: socket.socket | None = None
        self._stopped = 0
        self._heard, self._say = os.pipe()
        os.set_blocking(self._heard, False)
        os.set_blocking(self._say, False)

    def run(self) -> int:
        """Run until the server ends by itself, or a signal ends both; return the exit status."""
        signal.set_wakeup_fd(self._say, warn_on_full_buffer=False)
        signal.signal(signal.SIGCHLD, lambda *_: None)
        for number in STOPS:
            signal.signal(number, self._stop)
        failures = 0
        while True:
            began = time.monotonic()
            status = self._serve()
            if self._stopped or status in (0, 2, 3):
                return status
            failures = failures + 1 if time.monotonic() - began < SHORT_SECONDS else 0
            if failures >= MOST_FAILURES:
                return 3

    def close(self) -> None:
        """Hang up the shells that are left."""
        for shell in self._shells.values():
            with contextlib.suppress(ProcessLookupError):
                os.killpg(shell.pid, signal.SIGHUP)
                os.killpg(shell.pid, signal.SIGCONT)

    def _serve(self) -> int:
        """Run the server to its end, and return its exit status."""
        ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self._channel = ours
        self._server = subprocess.Popen(
            self._words,
            pass_fds=[self._listener, theirs.fileno()],
            env={**os.environ, CHANNEL: str(theirs.fileno()), DESCRIPTOR: str(self._listener)},
            start_new_session=True,  # Ctrl+C is for this program, which tells the server once
        )
        theirs.close()
        with ours:
            open_to = [ours.fileno(), self._heard]
            while self._server.poll() is None:
                ready, _, _ = select.select(open_to, [], [])
                if self._heard in ready:
                    with contextlib.suppress(BlockingIOError):
                        os.read(self._heard, 1024)
                    self._reap()
                if ours.fileno() in ready and not self._answer(ours):
                    open_to = [self._heard]
        return self._server.returncode

    def _stop(self, number: int, _: object) -> None:
        self._stopped = number
        if self._server is not None and self._server.returncode is None:
            self._server.send_signal(signal.SIGINT)

    def _reap(self) -> None:
        """Wait for shells that have ended. (The server is another one's to wait for.)"""
        for shell in self._shells.values():
            with contextlib.suppress(ChildProcessError):
                os.waitpid(shell.pid, os.WNOHANG)

    def _answer(self, channel: socket.socket) -> bool:
        """Do what the server asks; False if it has closed its end."""
        try:
            text = channel.recv(MOST_BYTES)
        except OSError:
            return False
        if not text:
            return False
        asked: dict[str, Any] = json.loads(text)
        given: list[Shell] = []
        if asked["do"] == "open":
            shell = start_shell(
                asked["rows"], asked["columns"], asked["environment"], asked["folder"]
            )
            self._shells[asked["number"]] = shell
            given = [shell]
            answer: dict[str, Any] = {"pid": shell.pid}
        elif asked["do"] == "list":
            given = list(self._shells.values())
            answer = {"shells": [[n, shell.pid] for n, shell in self._shells.items()]}
        else:
            shell = self._shells.pop(asked["number"])
            os.close(shell.terminal)
            os.close(shell.memory)
            with contextlib.suppress(ChildProcessError):
                os.waitpid(shell.pid, os.WNOHANG)
            answer = {}
        descriptors = [fd for shell in given for fd in (shell.terminal, shell.memory)]
        try:
            socket.send_fds(channel, [json.dumps(answer).encode()], descriptors)
        except OSError:
            return False
        return True


def main() -> int:
    """Keep the shells of the server that the command line names."""
    listener = int(sys.argv[1])
    os.set_inheritable(listener, False)
    keeper = Keeper(listener, sys.argv[2:])
    try:
        return keeper.run()
    finally:
        keeper.close()


if __name__ == "__main__":
    raise SystemExit(main())
