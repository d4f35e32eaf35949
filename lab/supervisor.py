"""The main process of the lab's container: it runs as long as a terminal is open.

`supervisor.py` waits for terminals. `supervisor.py lease MARK` represents one: the lab runs it
beside each shell and keeps its standard input open. However the lab ends (also by `kill -9`), that
input ends, the processes with this mark get SIGHUP, and after the last terminal the container ends.

It runs with the image's own Python, so it uses only the standard library.
"""

from __future__ import annotations

import os
import selectors
import signal
import socket
import sys
import time
from pathlib import Path

ADDRESS = "\0ros2-teaching-lab"  # abstract: bound to the container's network namespace, no file
FIRST_SECONDS = 60.0  # to wait for the first terminal; the lab may be killed while it opens
LEASE_SECONDS = 20.0  # to wait for the supervisor in a container that has just been started
POLL_SECONDS = 0.02
VARIABLE = "LAB_TERMINAL"
READY, LAST, OTHERS = b"ready\n", b"last\n", b"others\n"


def supervise() -> None:
    """Wait for terminals, and return when all of them have closed."""
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    os.chdir("/")  # the container's folder is the workspace, which it must not hold
    terminals: dict[socket.socket, str] = {}
    with socket.socket(socket.AF_UNIX) as server, selectors.DefaultSelector() as selector:
        server.bind(ADDRESS)
        server.listen()
        selector.register(server, selectors.EVENT_READ)
        timeout: float | None = FIRST_SECONDS
        while True:
            events = selector.select(timeout)
            if not events:
                return
            timeout = None
            for key, _ in events:
                if key.fileobj is server:
                    terminal, _ = server.accept()
                    mark = terminal.makefile("r").readline().strip()
                    terminals[terminal] = mark
                    selector.register(terminal, selectors.EVENT_READ)
                    terminal.sendall(READY)
                    continue
                closed = next(each for each in terminals if each is key.fileobj)
                selector.unregister(closed)
                hang_up(terminals.pop(closed))
                _answer(closed, OTHERS if terminals else LAST)
            if not terminals:
                return


def _answer(terminal: socket.socket, text: bytes) -> None:
    with terminal:
        try:
            terminal.sendall(text)
        except OSError:
            return  # the lease has ended already


def hang_up(mark: str) -> None:
    """Send SIGHUP to every process of a terminal."""
    wanted = f"{VARIABLE}={mark}".encode()
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit() or int(entry.name) == os.getpid():
            continue
        try:
            if wanted in (entry / "environ").read_bytes().split(b"\0"):
                os.kill(int(entry.name), signal.SIGHUP)
                os.kill(int(entry.name), signal.SIGCONT)
        except OSError:
            continue  # it has ended, or belongs to another user


def lease(mark: str) -> int:
    """Represent a terminal until stdin ends; print `ready`, then `last` or `others`."""
    deadline = time.monotonic() + LEASE_SECONDS
    while True:
        try:
            supervisor = socket.socket(socket.AF_UNIX)
            supervisor.connect(ADDRESS)
            break
        except OSError:
            supervisor.close()
            if time.monotonic() > deadline:
                return 1
            time.sleep(POLL_SECONDS)
    with supervisor, supervisor.makefile("rb") as answers:
        supervisor.sendall(f"{mark}\n".encode())
        _print(answers.readline())
        while os.read(0, 4096):
            pass
        supervisor.shutdown(socket.SHUT_WR)
        _print(answers.readline())
    return 0


def _print(text: bytes) -> None:
    try:
        sys.stdout.buffer.write(text)
        sys.stdout.buffer.flush()
    except OSError:
        return  # the lab has ended


if __name__ == "__main__":
    if sys.argv[1:2] == ["lease"]:
        raise SystemExit(lease(sys.argv[2]))
    supervise()
