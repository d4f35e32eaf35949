"""The base of the sandboxes whose commands are child processes of the grader.

Pipes and pseudo-terminals are the grader's own.
"""

from __future__ import annotations

import contextlib
import os
import select
import selectors
import signal
import subprocess
import time
from abc import abstractmethod
from collections.abc import Mapping, Sequence
from pathlib import Path

import pexpect

from grader.base.errors import SurroundingsError
from grader.base.i18n.message import say
from grader.sandbox.base import COLUMNS, PATH, ROWS, Console, Outcome, Pipe, Role, Sandbox
from grader.sandbox.processes import descendants
from grader.sandbox.scheduling import Limit

END_SECONDS = 2.0  # to wait for a killed command
KILL_SECONDS = 5.0
POLL_SECONDS = 0.002  # between two checks of a process that is ending
MAX_STDERR = 4_000  # bytes that are kept
OUT_OF_MEMORY = (b"MemoryError", b"bad_alloc", b"Cannot allocate memory")


class LocalSandbox(Sandbox):
    """A sandbox whose commands are started on this machine."""

    _latest_probe: LocalPipe | None = None

    @abstractmethod
    def command(self, argv: Sequence[str], *, role: Role = "student") -> list[str]:
        """Return the command line that runs `argv` in the sandbox."""

    def outer_environment(self, role: Role) -> Mapping[str, str]:
        """Return the environment for the command line that `command` returns."""
        del role
        return {"PATH": PATH, "LANG": "C.UTF-8"}

    def run(
        self,
        argv: Sequence[str],
        *,
        role: Role = "student",
        stdin: bytes = b"",
        seconds: float,
        output: float | None = None,
    ) -> Outcome:
        max_output = int(self.limits.output if output is None else output)
        command = self.command(argv, role=role)
        started = time.monotonic()
        with subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            start_new_session=True,
            env=self.outer_environment(role),
        ) as process:
            try:
                limit = self.run_clock.limit(seconds)
                text, stopped_by = _communicate(process, stdin, limit, max_output)
            finally:
                self.end(process)
        status = None if stopped_by else process.returncode
        return Outcome(status, text, time.monotonic() - started, stopped_by)

    def probe(self, argv: Sequence[str]) -> Pipe:
        command = self.command(argv, role="probe")
        self._latest_probe = LocalPipe(self, command, self.outer_environment("probe"))
        return self._latest_probe

    def probe_limit_hit(self) -> str:
        said = self._latest_probe.errors() if self._latest_probe is not None else b""
        return "memory" if any(words in said for words in OUT_OF_MEMORY) else ""

    def console(self, argv: Sequence[str], *, probe: Pipe | None = None) -> Console:
        del probe
        return LocalConsole(self.command(argv), self.outer_environment("student"))

    def end(self, process: subprocess.Popen[bytes]) -> None:
        """Kill a process started from `command`, and everything that it started."""
        if process.poll() is None:
            kill_children(process.pid)
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(END_SECONDS)
        if process.poll() is None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)


class LocalConsole(Console):
    """A local command on a pseudo-terminal, with pexpect."""

    def __init__(self, command: Sequence[str], env: Mapping[str, str]) -> None:
        self._spawn = pexpect.spawn(
            command[0],
            list(command[1:]),
            env=dict(env),
            timeout=None,
            dimensions=(ROWS, COLUMNS),
        )
        self._spawn.delayafterclose = self._spawn.delayafterterminate = 0
        self._spawn.ptyproc.delayafterclose = self._spawn.ptyproc.delayafterterminate = 0
        self._spawn.delaybeforesend = None

    def wait(self, seconds: float) -> bool:
        return bool(select.select([self._spawn.child_fd], [], [], max(0.0, seconds))[0])

    def read(self) -> bytes:
        try:
            return os.read(int(self._spawn.child_fd), 65536)
        except OSError:  # Linux returns EIO after the last process has closed the terminal
            return b""

    def interrupt(self) -> None:
        self._spawn.sendintr()

    def type(self, keys: bytes) -> None:
        while keys:
            keys = keys[os.write(int(self._spawn.child_fd), keys) :]

    def resize(self, rows: int, columns: int) -> None:
        self._spawn.setwinsize(rows, columns)

    def poll(self) -> tuple[int | None, int | None] | None:
        if self._spawn.isalive():
            return None
        return self._spawn.exitstatus, self._spawn.signalstatus

    def processes(self) -> set[int]:
        return descendants(self._spawn.pid)

    def end(self) -> None:
        begin = time.monotonic()
        while self._spawn.isalive() and time.monotonic() < begin + KILL_SECONDS:
            if time.monotonic() < begin + KILL_SECONDS / 2:
                kill_children(self._spawn.pid)
            else:
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(self._spawn.pid, signal.SIGKILL)
            time.sleep(POLL_SECONDS)
        self._spawn.close(force=False)


class LocalPipe(Pipe):
    """A local command with pipes."""

    def __init__(
        self, sandbox: LocalSandbox, command: Sequence[str], env: Mapping[str, str]
    ) -> None:
        self._sandbox = sandbox
        self._process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=True,
            env=dict(env),
        )
        self.pid = self._process.pid
        """Of the process that started the command; the command is one of its descendants."""
        self._errors = b""
        self._errors_end = False

    def write(self, data: bytes) -> None:
        assert self._process.stdin is not None
        self._process.stdin.write(data)
        self._process.stdin.flush()

    def read(self, seconds: float) -> bytes | None:
        assert self._process.stdout is not None
        output = self._process.stdout.fileno()
        left, deadline = seconds, time.monotonic() + seconds
        while True:
            # stderr is read as well: a full pipe would block the command
            ready = select.select([output, *self._errors_from], [], [], max(0.0, left))[0]
            if output in ready:
                return os.read(output, 1 << 20)
            if ready:
                self._take_errors()
            left = deadline - time.monotonic()
            if left <= 0 or not ready:
                return None

    @property
    def _errors_from(self) -> list[int]:
        assert self._process.stderr is not None
        return [] if self._errors_end else [self._process.stderr.fileno()]

    def _take_errors(self) -> None:
        (descriptor,) = self._errors_from
        data = os.read(descriptor, 1 << 16)
        self._errors = (self._errors + data)[-MAX_STDERR:]
        self._errors_end = not data

    def errors(self) -> bytes:
        deadline = time.monotonic() + END_SECONDS
        while self._errors_from and time.monotonic() < deadline:
            if not select.select(self._errors_from, [], [], 0)[0]:
                break
            self._take_errors()
        return self._errors

    def finish(self, seconds: float) -> None:
        with contextlib.suppress(OSError, ValueError, subprocess.TimeoutExpired):
            assert self._process.stdin is not None
            self._process.stdin.close()
            self._process.wait(seconds)
        self.kill()
        for stream in (self._process.stdin, self._process.stdout, self._process.stderr):
            if stream is not None:
                with contextlib.suppress(OSError):
                    stream.close()
        self._process.wait()

    def kill(self) -> None:
        self._sandbox.end(self._process)

    def processes(self) -> set[int]:
        return descendants(self.pid)


def kill_children(pid: int) -> None:
    """Kill the children of a process started from `command`, so that it reaps them and exits.

    (Killing it together with them would leave an orphan, and a PID namespace does not end before
    the last of its processes is reaped.)
    """
    with contextlib.suppress(OSError):
        children = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
        for child in children:
            os.kill(int(child), signal.SIGKILL)
        os.kill(pid, signal.SIGCONT if children else signal.SIGKILL)


def _communicate(
    process: subprocess.Popen[bytes], stdin: bytes, limit: Limit, max_output: int
) -> tuple[bytes, str]:
    """Write stdin, read the output to its end or a limit; return it and the limit that was hit."""
    assert process.stdin is not None and process.stdout is not None
    output = bytearray()
    rest = memoryview(stdin)
    os.set_blocking(process.stdin.fileno(), False)
    with selectors.DefaultSelector() as selector:
        selector.register(process.stdout, selectors.EVENT_READ)
        if rest:
            selector.register(process.stdin, selectors.EVENT_WRITE)
        else:
            process.stdin.close()
        while True:
            if limit.over:
                return bytes(output), limit.name
            for key, _ in selector.select(limit.slice):
                if key.fileobj is process.stdin:
                    try:
                        rest = rest[os.write(key.fd, rest[:65536]) :]
                    except BrokenPipeError:
                        rest = rest[:0]
                    if not rest:
                        selector.unregister(process.stdin)
                        process.stdin.close()
                    continue
                data = os.read(key.fd, 65536)
                if not data:
                    return _wait(process, limit, output)
                output += data[: max_output - len(output)]
                if len(output) >= max_output:
                    return bytes(output), "output"


def _wait(process: subprocess.Popen[bytes], limit: Limit, output: bytearray) -> tuple[bytes, str]:
    while not limit.over:
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(limit.slice)
            return bytes(output), ""
    return bytes(output), limit.name


def require_program(program: str, found: str | None) -> str:
    """Return `found`, the path of a program; raise SurroundingsError if it is None."""
    if found is None:
        raise SurroundingsError(
            say("the program {program} is missing", program=program),
            remedy=say(
                "Install it (Debian and Ubuntu: `sudo apt-get install bubblewrap util-linux "
                "coreutils`)."
            ),
        )
    return found
