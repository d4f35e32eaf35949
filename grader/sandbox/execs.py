"""Commands in a running container (`docker exec`) and the sockets connected to them."""

from __future__ import annotations

import select
import socket
import struct
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import docker.errors
import requests.exceptions
from pexpect.socket_pexpect import SocketSpawn

from grader.base.errors import SurroundingsError
from grader.sandbox.base import COLUMNS, ROWS, Console, Outcome, Pipe
from grader.sandbox.processes import descendants
from grader.sandbox.scheduling import Limit

if TYPE_CHECKING:
    from docker import APIClient

End = Literal["interrupted", "otherwise"]  # how a command on a console ended
HEADER = struct.Struct(">BxxxL")  # of a frame: stream number, length (Docker's API, attach)
STDERR = 2
MAX_STDERR = 4_000  # bytes that are kept
DRAIN_SECONDS = 1.0  # of silence after which the output of an ended command is complete
STATUS_SECONDS = 5.0  # to wait for the status of a command that has closed its streams
POLL_SECONDS = 0.002
GONE = 137  # the exit status of a command whose container was killed


@contextmanager
def docker_errors(doing: str) -> Iterator[None]:
    """Turn errors of the daemon and of its connection into SurroundingsError."""
    try:
        yield
    except docker.errors.APIError as error:
        said = str(error.explanation or error)
        remedy = "Free some disk space for Docker (`docker system df` shows what uses it)."
        raise SurroundingsError(
            f"Docker refused while {doing}: {said}",
            remedy=remedy if "no space left" in said else "Check the daemon with `docker info`.",
        ) from error
    except (docker.errors.DockerException, requests.exceptions.RequestException, OSError) as error:
        raise SurroundingsError(
            f"the connection to the Docker daemon was lost while {doing}",
            remedy="Start it (`sudo systemctl start docker`) and run the command again.",
        ) from error


class Exec:
    """A command in a container. Raises what the Docker SDK raises."""

    def __init__(
        self, api: APIClient, container: str, argv: Sequence[str], *, user: int, tty: bool = False
    ) -> None:
        made = api.exec_create(container, list(argv), stdin=True, tty=tty, user=f"{user}:{user}")
        self._api = api
        self._id: str = made["Id"]
        self._reply = api.exec_start(self._id, tty=tty, socket=True)
        self.socket = socket_of(self._reply)
        self._early = already_read(self._reply, self.socket)
        if tty:
            self.resize(ROWS, COLUMNS)

    def resize(self, rows: int, columns: int) -> None:
        """Set the size of its pseudo-terminal."""
        try:
            self._api.exec_resize(self._id, height=rows, width=columns)
        except docker.errors.APIError:
            if self.status() is None:  # (a command that has ended has no terminal to resize)
                raise

    def wait_for_output(self, seconds: float) -> bool:
        """Wait for output or its end; return whether there is something to read."""
        timeout = self.timeout(max(0.0, seconds))
        return bool(select.select([self.socket], [], [], timeout)[0] or self._early)

    def timeout(self, seconds: float) -> float:
        """Return how long to wait for the socket: 0 if there is output already."""
        return 0 if self._early else seconds

    def receive(self) -> bytes:
        """Return the next output, b"" at the end."""
        if self._early:
            data, self._early = self._early, b""
            return data
        try:
            return self.socket.recv(1 << 18)
        except ConnectionError:
            return b""

    def status(self) -> int | None:
        """Return its exit status, None while it runs."""
        try:
            state: dict[str, Any] = self._api.exec_inspect(self._id)
        except docker.errors.NotFound:
            return GONE
        return None if state["Running"] else int(state["ExitCode"] or 0)

    def processes(self) -> set[int]:
        """Return the ids of its processes if this machine runs the daemon, else none."""
        with suppress(docker.errors.APIError, OSError):
            state: dict[str, Any] = self._api.exec_inspect(self._id)
            pid = int(state.get("Pid") or 0)
            groups = Path(f"/proc/{pid}/cgroup").read_text(encoding="utf-8") if pid else ""
            if str(state.get("ContainerID")) in groups:
                return {pid, *descendants(pid)}
        return set()

    def wait(self, seconds: float) -> int | None:
        """Wait for its exit status; None if it did not end in time."""
        deadline = time.monotonic() + seconds
        while (status := self.status()) is None and time.monotonic() < deadline:
            time.sleep(POLL_SECONDS)  # the API has no call that waits for the end of an exec
        return status

    def close(self) -> None:
        """Close the socket; the command itself ends with its container."""
        self.socket.close()
        self._reply.close()


def socket_of(reply: object) -> socket.socket:
    """Return the socket behind the file-like wrapper that the SDK returns."""
    found = getattr(reply, "_sock", reply)
    assert isinstance(found, socket.socket)
    return found


def already_read(reply: object, line: socket.socket) -> bytes:
    """Return the bytes that arrived with the response headers, from the HTTP reader's buffer.

    (The SDK returns the raw socket below that reader, so these bytes would be lost.)
    """
    response = getattr(reply, "_response", None)
    reader = getattr(getattr(getattr(response, "raw", None), "_fp", None), "fp", None)
    if reader is None:
        line.settimeout(None)
        return b""
    line.setblocking(False)
    try:
        return bytes(reader.read1(len(reader.peek())) if reader.peek() else b"")
    except (BlockingIOError, ValueError, TypeError):
        return b""
    finally:
        line.settimeout(None)


class Frames:
    """Splits a stream into the frames of stdout and stderr."""

    def __init__(self) -> None:
        self._raw = bytearray()

    def feed(self, data: bytes) -> Iterator[tuple[int, bytes]]:
        """Yield the stream number and the bytes of each complete frame."""
        self._raw += data
        while len(self._raw) >= HEADER.size:
            stream, size = HEADER.unpack_from(self._raw)
            if len(self._raw) < HEADER.size + size:
                return
            yield stream, bytes(self._raw[HEADER.size : HEADER.size + size])
            del self._raw[: HEADER.size + size]


def communicate(command: Exec, stdin: bytes, *, limit: Limit, max_output: int) -> Outcome:
    """Write stdin and read both output streams to their end or to a limit."""
    begin = time.monotonic()
    ended: float | None = None
    frames, output, rest = Frames(), bytearray(), memoryview(stdin)
    line = command.socket
    line.setblocking(False)
    if not rest:
        line.shutdown(socket.SHUT_WR)

    def outcome(status: int | None, stopped_by: str = "") -> Outcome:
        return Outcome(status, bytes(output[:max_output]), time.monotonic() - begin, stopped_by)

    while True:
        if limit.over:
            return outcome(None, limit.name)
        can_write = select.select([line], [line] if rest else [], [], command.timeout(limit.slice))[
            1
        ]
        if can_write:
            rest = _send(line, rest)
        if command.wait_for_output(0):
            data = command.receive()
            if not data:
                break
            for _, text in frames.feed(data):
                output += text
            if len(output) >= max_output:
                return outcome(None, "output")
            ended = None
        # a background process keeps the streams open, so the status is polled; output of the ended
        # command may still arrive
        elif not can_write and ended is None:
            ended = time.monotonic() if command.status() is not None else None
        elif ended is not None and time.monotonic() - ended > DRAIN_SECONDS:
            break
    status = command.wait(max(STATUS_SECONDS, limit.left))
    return outcome(status, limit.name if status is None else "")


def _send(line: socket.socket, rest: memoryview) -> memoryview:
    try:
        rest = rest[line.send(rest[: 1 << 16]) :]
    except BrokenPipeError:
        rest = rest[:0]
    if not rest:
        line.shutdown(socket.SHUT_WR)
    return rest


class ExecConsole(Console):
    """A command in a container on a pseudo-terminal, with pexpect on the exec's socket.

    (pexpect's SocketSpawn has no sendintr, wait or terminate: Ctrl+C is sent as a byte, and the
    command is killed with its container.)
    """

    def __init__(self, command: Exec, *, ended: Callable[[End], None]) -> None:
        self._command = command
        self._spawn = SocketSpawn(command.socket, timeout=None)
        self._spawn.delaybeforesend = None
        self._ended = ended
        self._interrupted = False
        self._status: int | None = None

    def wait(self, seconds: float) -> bool:
        return self._command.wait_for_output(seconds)

    def read(self) -> bytes:
        return self._command.receive()

    def interrupt(self) -> None:
        self._interrupted = True
        self._spawn.send(b"\x03")

    def type(self, keys: bytes) -> None:
        self._spawn.send(keys)

    def resize(self, rows: int, columns: int) -> None:
        with docker_errors("resizing the terminal"):
            self._command.resize(rows, columns)

    def poll(self) -> tuple[int | None, int | None] | None:
        if self._status is None:
            with docker_errors("running the node"):
                self._status = self._command.status()
        return None if self._status is None else (self._status, None)

    def processes(self) -> set[int]:
        return self._command.processes()

    def end(self) -> None:
        how: End = "interrupted" if self._interrupted and self.poll() is not None else "otherwise"
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
        left, deadline = seconds, time.monotonic() + seconds
        output = b""
        while not output:
            # frames of stderr, however many, do not extend the time
            if left < 0 or not self._command.wait_for_output(left):
                return None
            data = self._command.receive()
            if not data:
                return b""
            for stream, text in self._frames.feed(data):
                if stream == STDERR:
                    self._errors = (self._errors + text)[-MAX_STDERR:]
                else:
                    output += text
            left = deadline - time.monotonic()
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

    def processes(self) -> set[int]:
        return self._command.processes()
