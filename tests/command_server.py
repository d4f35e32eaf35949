"""Starts `python -m MODULE` without its imports: forks of a process that has already made them.

A start of the grader is mostly imports. Each command is still a process of its own, with its own
arguments, environment, folder, output and exit status. What the tests start by other means (make,
a terminal, a sandbox, a signal's target) is started afresh.
"""

from __future__ import annotations

import atexit
import contextlib
import functools
import gc
import importlib
import io
import json
import os
import pkgutil
import runpy
import signal
import socket
import subprocess
import sys
import traceback
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = ("grader", "lab")
# programs of their own, modules of ROS, and Dask
NOT_IMPORTED = (
    "__main__",
    "bootstrap",
    "probe",
    "in_probe",
    "bridge",
    "turtlesim_programs",
    "ros2_command",
    "ros2cli_extensions",
    "cluster",
    "cluster_worker",
)
# what the tests' own commands import
OTHERS = ("tests.recorded", "tests.batch.in_process", "tests.report.samples")
PIPE_BYTES = 65_536  # what a pipe holds (pipe(7))
LONGEST = 1 << 20  # bytes of a request


class Commands:
    """The client's side: a server that this process has started."""

    def __init__(self) -> None:
        self._socket, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            self.process = subprocess.Popen(
                [sys.executable, "-m", "tests.command_server", str(theirs.fileno())],
                cwd=ROOT,
                env={**os.environ, "PYTHONPATH": str(ROOT)},
                stdin=subprocess.DEVNULL,
                pass_fds=[theirs.fileno()],
            )
        atexit.register(self.close)

    def close(self) -> None:
        """End the server."""
        self._socket.close()
        self.process.wait()

    def run(
        self, words: Sequence[str], *, cwd: Path, env: dict[str, str], timeout: float, stdin: str
    ) -> subprocess.CompletedProcess[str]:
        """Run `python -m` with these words to its end, and return it with its output."""
        request = json.dumps({"words": list(words), "cwd": str(cwd), "env": env})
        with _input(stdin) as given, _memory() as out, _memory() as err:
            streams = [given.fileno(), out.fileno(), err.fileno()]
            socket.send_fds(self._socket, [request.encode()], streams)
            self._socket.settimeout(None)
            pid = int(self._socket.recv(LONGEST))
            self._socket.settimeout(timeout)
            try:
                status = int(self._socket.recv(LONGEST))
            except TimeoutError:
                os.kill(pid, signal.SIGKILL)
                self._socket.settimeout(None)
                self._socket.recv(LONGEST)
                raise subprocess.TimeoutExpired(list(words), timeout) from None
            return subprocess.CompletedProcess(list(words), status, _text(out), _text(err))


@functools.cache
def commands() -> Commands:
    """Return this process' server, started at the first use; it ends with this process."""
    return Commands()


def _memory() -> io.FileIO:
    return io.FileIO(os.memfd_create("stream"), "r+")


def _input(text: str) -> io.FileIO:
    """Return a stream with this text: a pipe, or a file in memory if a pipe would not hold it."""
    data = text.encode()
    if len(data) > PIPE_BYTES:
        file = _memory()
        file.write(data)
        file.seek(0)
        return file
    reader, writer = os.pipe()
    with io.FileIO(writer, "w") as file:
        file.write(data)
    return io.FileIO(reader)


def _text(file: io.FileIO) -> str:
    """Return a file's text as `subprocess` does, with \\n for every line end."""
    file.seek(0)
    return io.TextIOWrapper(io.BytesIO(file.read()), encoding="utf-8").read()


def _import_all() -> None:
    for package in PACKAGES:
        importlib.import_module(package)
        _import_below(package, [str(ROOT / package)])
    for module in OTHERS:
        importlib.import_module(module)
    gc.collect()
    gc.freeze()  # so that a collection in a command copies no pages


def _import_below(package: str, folders: list[str]) -> None:
    for found in pkgutil.iter_modules(folders):
        if found.name not in NOT_IMPORTED:
            module = importlib.import_module(f"{package}.{found.name}")
            if found.ispkg:
                _import_below(module.__name__, list(module.__path__))


def _serve(connection: socket.socket) -> None:
    while True:
        data, files, _, _ = socket.recv_fds(connection, LONGEST, 3)
        if not data:
            return
        pid = os.fork()
        if pid == 0:
            connection.close()
            _become(json.loads(data), files)
        for file in files:
            os.close(file)
        connection.send(str(pid).encode())
        connection.send(str(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])).encode())


def _become(request: dict[str, object], files: list[int]) -> None:
    """Run the command in this process and end it."""
    words, env = request["words"], request["env"]
    assert isinstance(words, list)
    assert isinstance(env, dict)
    for number, file in enumerate(files):
        os.dup2(file, number)
        os.close(file)
    os.chdir(str(request["cwd"]))
    os.environ.clear()
    os.environ.update(env)
    sys.argv = words
    status = _status_of(words[0])
    with contextlib.suppress(BaseException):
        atexit._run_exitfuncs()
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError, ValueError):
            stream.flush()
    os._exit(status)


def _status_of(module: str) -> int:
    """Run a module as a program; return its exit status as Python computes it."""
    if not hasattr(sys.modules.get(module), "__path__"):  # else its __main__ is run
        sys.modules.pop(module, None)
    try:
        runpy.run_module(module, run_name="__main__", alter_sys=True)
    except SystemExit as ended:
        if ended.code is None or isinstance(ended.code, int):
            return (ended.code or 0) & 0xFF
        print(ended.code, file=sys.stderr)
        return 1
    except BaseException:
        traceback.print_exc()
        return 1
    return 0


if __name__ == "__main__":
    _import_all()
    with socket.socket(fileno=int(sys.argv[1])) as connected:
        _serve(connected)
