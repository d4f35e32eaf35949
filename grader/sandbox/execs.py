"""A command in a running container, and the socket over which it talks to us."""

from __future__ import annotations

import select
import socket
import struct
import time
from collections.abc import Callable
from collections.abc import Iterator
from collections.abc import Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING
from typing import Any
from typing import Literal

import docker.errors
import requests.exceptions
from pexpect.socket_pexpect import SocketSpawn

from grader.errors import SurroundingsError
from grader.sandbox.base import COLUMNS
from grader.sandbox.base import ROWS
from grader.sandbox.base import Console
from grader.sandbox.base import Outcome
from grader.sandbox.base import Pipe

if TYPE_CHECKING:
    from docker import APIClient

End = Literal["as asked", "otherwise"]  # whether Ctrl+C ended a command on a console
HEADER = struct.Struct(">BxxxL")  # of a frame: which stream, how many bytes (Docker's API, attach)
STDERR = 2
MOST_ERRORS = 4_000  # bytes of stderr that are kept
LOOK_SECONDS = 0.25  # how often it is asked whether a silent command has ended
STATUS_SECONDS = 5.0  # in which the status of a command that has let go of its streams is known
POLL_SECONDS = 0.002
GONE = 137  # the status of a command whose container was killed


@contextmanager
def docker_errors(doing: str) -> Iterator[None]:
    """Turn what the daemon (or its absence) raises into SurroundingsError."""
    try:
        yield
    except docker.errors.APIError as error:
        said = str(error.explanation or error)
        remedy = "Free some space for Docker (`docker system df` says what takes it)."
        raise SurroundingsError(
            f"Docker refused while {doing}: {said}",
            remedy=remedy if "no space left" in said else "`docker info` tells how the daemon is.",
        ) from error
    except (docker.errors.DockerException, requests.exceptions.RequestException, OSError) as error:
        raise SurroundingsError(
            f"the Docker daemon went away while {doing}",
            remedy="Start it (`sudo systemctl start docker`) and run the command again.",
        ) from error


class Exec:
    """One command in a container. Raises what the Docker SDK raises."""

    def __init__(
        self, api: APIClient, container: str, argv: Sequence[str], *, user: int, tty: bool = False
    ) -> None:
        made = api.exec_create(container, list(argv), stdin=True, tty=tty, user=f"{user}:{user}")
        self._api = api
        self._id: str = made["Id"]
        self._reply = api.exec_start(self._id, tty=tty, socket=True)
        self.socket = socket_of(self._reply)
        if tty:
            api.exec_resize(self._id, height=ROWS, width=COLUMNS)

    def status(self) -> int | None:
        """Return its exit status, None while it runs."""
        try:
            state: dict[str, Any] = self._api.exec_inspect(self._id)
        except docker.errors.NotFound:
            return GONE
        return None if state["Running"] else int(state["ExitCode"] or 0)

    def wait(self, seconds: float) -> int | None:
        """Wait for its exit status; None if it did not end in time."""
        deadline = time.monotonic() + seconds
        while (status := self.status()) is None and time.monotonic() < deadline:
            time.sleep(POLL_SECONDS)  # the API cannot be waited on for the end of an exec
        return status

    def close(self) -> None:
        """Let go of the socket; the command itself ends with its container."""
        self.socket.close()
        self._reply.close()


def socket_of(reply: object) -> socket.socket:
    """Return the socket itself behind what the SDK gives for it (a file-like wrapper)."""
    found = getattr(reply, "_sock", reply)
    assert isinstance(found, socket.socket)
    return found


class Frames:
    """Takes the frames of stdout and stderr apart."""

    def __init__(self) -> None:
        self._raw = bytearray()

    def feed(self, data: bytes) -> Iterator[tuple[int, bytes]]:
        """Yield the stream's number and the bytes of each whole frame."""
        self._raw += data
        while len(self._raw) >= HEADER.size:
            stream, size = HEADER.unpack_from(self._raw)
            if len(self._raw) < HEADER.size + size:
                return
            yield stream, bytes(self._raw[HEADER.size : HEADER.size + size])
            del self._raw[: HEADER.size + size]


def converse(command: Exec, stdin: bytes, *, seconds: float, most: int) -> Outcome:
    """Feed stdin, read both streams to their end, cut while they are read."""
    begin = time.monotonic()
    frames, output, rest = Frames(), bytearray(), memoryview(stdin)
    line = command.socket
    line.setblocking(False)
    if not rest:
        line.shutdown(socket.SHUT_WR)

    def outcome(status: int | None, stopped_by: str = "") -> Outcome:
        return Outcome(status, bytes(output[:most]), time.monotonic() - begin, stopped_by)

    while True:
        left = begin + seconds - time.monotonic()
        if left <= 0:
            return outcome(None, "wall time")
        can_read, can_write, _ = select.select(
            [line], [line] if rest else [], [], min(left, LOOK_SECONDS)
        )
        if can_write:
            rest = _send(line, rest)
        if can_read:
            data = line.recv(1 << 16)
            if not data:
                break
            for _, text in frames.feed(data):
                output += text
            if len(output) >= most:
                return outcome(None, "output")
        # what it left in the background keeps the streams open: that it has ended is asked for
        elif not can_write and command.status() is not None:
            break
    return outcome(command.wait(STATUS_SECONDS))


def _send(line: socket.socket, rest: memoryview) -> memoryview:
    try:
        rest = rest[line.send(rest[: 1 << 16]) :]
    except BrokenPipeError:
        rest = rest[:0]
    if not rest:
        line.shutdown(socket.SHUT_WR)
    return rest


class ExecConsole(Console):
    """A command in a container on a pseudo-terminal, by pexpect over the exec's socket.

    (Such a spawn of pexpect has no sendintr, wait or terminate: Ctrl+C is a byte that is sent, the
    end is the container's.)
    """

    def __init__(self, command: Exec, *, ended: Callable[[End], None]) -> None:
        self._command = command
        self._spawn = SocketSpawn(command.socket, timeout=None)
        self._spawn.delaybeforesend = None
        self._ended = ended
        self._interrupted = False
        self._status: int | None = None

    def fileno(self) -> int:
        return self._command.socket.fileno()

    def read(self) -> bytes:
        try:
            return self._command.socket.recv(65536)
        except OSError:
            return b""

    def interrupt(self) -> None:
        self._interrupted = True
        self._spawn.send(b"\x03")

    def poll(self) -> tuple[int | None, int | None] | None:
        if self._status is None:
            self._status = self._command.status()
        return None if self._status is None else (self._status, None)

    def end(self) -> None:
        how: End = "as asked" if self._interrupted and self.poll() is not None else "otherwise"
        self._command.close()
        self._ended(how)


class ExecPipe(Pipe):
    """A command in a container with pipes."""

    def __init__(self, command: Exec, *, ended: Callable[[], None]) -> None:
        self._command = command
        self._ended = ended
        self._frames = Frames()
        self._errors = b""

    def write(self, data: bytes) -> None:
        self._command.socket.sendall(data)

    def read(self, seconds: float) -> bytes | None:
        deadline = time.monotonic() + seconds
        output = b""
        while not output:
            left = max(0.0, deadline - time.monotonic())
            if not select.select([self._command.socket], [], [], left)[0]:
                return None
            try:
                data = self._command.socket.recv(1 << 20)
            except OSError:
                data = b""
            if not data:
                return b""
            for stream, text in self._frames.feed(data):
                if stream == STDERR:
                    self._errors = (self._errors + text)[-MOST_ERRORS:]
                else:
                    output += text
        return output

    def errors(self) -> bytes:
        return self._errors

    def finish(self, seconds: float) -> None:
        with docker_errors("ending the probe"):
            ended = self._command.wait(seconds) is not None
        self._command.close()
        if not ended:
            self._ended()

    def kill(self) -> None:
        self._ended()
