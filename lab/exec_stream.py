"""What runs in a container by `docker exec`, joined to this program's own input and output.

The Docker SDK hands out the raw connection and no more. Source of its form: Docker Engine API,
"Attach to a container": with a terminal the bytes as they are, without one frames with a header of
8 bytes (stream, 0, 0, 0, length).
"""

from __future__ import annotations

import contextlib
import os
import select
import socket
import time
from typing import Any

import docker
from docker.errors import APIError

from grader.base.errors import SurroundingsError
from grader.sandbox.execs import Frames, already_read, socket_of
from lab.terminal import TERMINAL, on_new_size, raw

STDOUT, STDERR = 1, 2
CHUNK = 65536
STATUS_SECONDS = 10.0
POLL_SECONDS = 0.01
# Keys that end an attachment instead of going through. Docker's default begins with Ctrl+P, which
# is a shell's "line before"; these begin with one that nothing here uses. It cannot be switched off.
DETACH_KEYS = "ctrl-^,ctrl-@"


class ExecStream:
    """A command in a container that has been started, and the connection to it."""

    def __init__(
        self, api: docker.APIClient, container: str, words: list[str], **options: Any
    ) -> None:
        self._api = api
        self._tty = bool(options.get("tty"))
        made = api.exec_create(container, words, stdin=True, detach_keys=DETACH_KEYS, **options)
        self._id: str = made["Id"]
        connection: Any = api.exec_start(self._id, tty=self._tty, socket=True)
        self._socket: socket.socket = socket_of(connection)
        self._connection = connection  # (it would close the socket if it were let go)
        self._rest = already_read(connection, self._socket)

    def close(self) -> None:
        """Let go of it: its input ends."""
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)
        self._connection.close()
        self._socket.close()

    def end_input(self) -> None:
        """End its standard input; what it says can still be read."""
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_WR)

    def read(self) -> bytes:
        """Return the next bytes, b"" at the end."""
        if self._rest:
            data, self._rest = self._rest, b""
            return data
        try:
            return self._socket.recv(CHUNK)
        except ConnectionResetError:
            return b""

    def read_line(self, seconds: float) -> bytes:
        """Return the next line of standard output (without a terminal), b"" if none comes."""
        deadline = time.monotonic() + seconds
        frames = Frames()
        text = b""
        while not text.endswith(b"\n"):
            left = max(0.0, deadline - time.monotonic())
            if not self._rest and not select.select([self._socket], [], [], left)[0]:
                return b""
            data = self.read()
            if not data:
                return b""
            text += b"".join(part for stream, part in frames.feed(data) if stream == STDOUT)
        return text

    def run(self) -> int:
        """Join it to this program's input and output until it ends; return its exit status."""
        if self._tty:
            with on_new_size(self._resize), raw():
                self._resize()
                self._pump()
        else:
            self._pump()
        return self._status()

    def _pump(self) -> None:
        frames = None if self._tty else Frames()
        sources: list[Any] = [self._socket, TERMINAL]
        if self._rest:
            _write_out(self.read(), frames)
            self._resize()
        sized = not self._tty
        while True:
            ready, _, _ = select.select(sources, [], [])
            if self._socket in ready:
                data = self.read()
                if not data:
                    return
                if not sized:  # before its first words it may not have been there to be told
                    self._resize()
                    sized = True
                _write_out(data, frames)
            if TERMINAL in ready:
                try:
                    keys = os.read(TERMINAL, CHUNK)
                except OSError:  # the terminal has gone
                    keys = b""
                if keys:
                    with contextlib.suppress(BrokenPipeError):
                        self._socket.sendall(keys)
                else:
                    sources.remove(TERMINAL)
                    self.end_input()
                    if self._tty:
                        return

    def _resize(self) -> None:
        if self._tty:
            with contextlib.suppress(OSError, APIError):
                size = os.get_terminal_size(TERMINAL)
                self._api.exec_resize(self._id, height=size.lines, width=size.columns)

    def _status(self) -> int:
        deadline = time.monotonic() + STATUS_SECONDS
        while time.monotonic() < deadline:
            told = self._api.exec_inspect(self._id)
            if not told["Running"] and told["ExitCode"] is not None:
                return int(told["ExitCode"])
            time.sleep(POLL_SECONDS)  # the connection is shut: only the status is to come
        raise SurroundingsError("Docker does not say how the command in the lab ended")


def _write_out(data: bytes, frames: Frames | None) -> None:
    parts = [(STDOUT, data)] if frames is None else frames.feed(data)
    for stream, part in parts:
        left = memoryview(part)
        while left:
            left = left[os.write(STDERR if stream == STDERR else STDOUT, left) :]
