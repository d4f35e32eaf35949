"""Connects a command started with `docker exec` to this program's input and output.

The Docker SDK returns only the raw connection. Its format is defined in the Docker Engine API,
"Attach to a container": with a terminal plain bytes, without one frames with a header of 8 bytes
(stream, 0, 0, 0, length).
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
from lab.terminal import TERMINAL, on_resize, raw_mode

STDOUT, STDERR = 1, 2
CHUNK = 65536
STATUS_SECONDS = 10.0
POLL_SECONDS = 0.01
# Keys that detach. They cannot be disabled; Docker's default begins with Ctrl+P, which is "previous
# line" in a shell, so these begin with a key that nothing here uses.
DETACH_KEYS = "ctrl-^,ctrl-@"


class ExecStream:
    """A command started in a container, and the connection to it."""

    def __init__(
        self, api: docker.APIClient, container: str, words: list[str], **options: Any
    ) -> None:
        self._api = api
        self._tty = bool(options.get("tty"))
        made = api.exec_create(container, words, stdin=True, detach_keys=DETACH_KEYS, **options)
        self._id: str = made["Id"]
        connection: Any = api.exec_start(self._id, tty=self._tty, socket=True)
        self._socket: socket.socket = socket_of(connection)
        self._connection = connection  # (garbage collection would close the socket)
        self._rest = already_read(connection, self._socket)

    def close(self) -> None:
        """Close the connection, which also ends the command's input."""
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)
        self._connection.close()
        self._socket.close()

    def end_input(self) -> None:
        """End its standard input; its output can still be read."""
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
        """Forward input and output until the command ends; return its exit status."""
        if self._tty:
            with on_resize(self._resize), raw_mode():
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
                if not sized:  # before its first output it may not have been able to resize
                    self._resize()
                    sized = True
                _write_out(data, frames)
            if TERMINAL in ready:
                try:
                    keys = os.read(TERMINAL, CHUNK)
                except OSError:  # the terminal is closed
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
            state = self._api.exec_inspect(self._id)
            if not state["Running"] and state["ExitCode"] is not None:
                return int(state["ExitCode"])
            time.sleep(POLL_SECONDS)  # the connection is closed; only the status is missing
        raise SurroundingsError("Docker does not report the exit status of the command in the lab")


def _write_out(data: bytes, frames: Frames | None) -> None:
    parts = [(STDOUT, data)] if frames is None else frames.feed(data)
    for stream, part in parts:
        left = memoryview(part)
        while left:
            left = left[os.write(STDERR if stream == STDERR else STDOUT, left) :]
