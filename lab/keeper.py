"""The first process of the lab's container: it lives as long as a terminal is open.

`keeper.py` waits for terminals. `keeper.py lease MARK` stands for one: the lab runs it beside each
shell and holds its standard input open. Whichever way the lab ends, also by `kill -9`, that input
ends, the shell with this mark is hung up on, and after the last one the container ends.

Standard library only: it runs on the image's own Python.
"""

from __future__ import annotations

import os
import selectors
import signal
import socket
import sys
import time
from pathlib import Path

ADDRESS = "\0ros2-teaching-lab"  # in the container's own network namespace: no file is left over
FIRST_SECONDS = 60.0  # for the first terminal to come; a lab that was killed while it opened
LEASE_SECONDS = 20.0  # for the keeper to be there, in a container that has just been started
POLL_SECONDS = 0.02
VARIABLE = "LAB_TERMINAL"
READY, LAST, OTHERS = b"ready\n", b"last\n", b"others\n"


def keep() -> None:
    """Wait until terminals have come and all of them have gone again."""
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    terminals: dict[socket.socket, str] = {}
    with socket.socket(socket.AF_UNIX) as door, selectors.DefaultSelector() as selector:
        door.bind(ADDRESS)
        door.listen()
        selector.register(door, selectors.EVENT_READ)
        timeout: float | None = FIRST_SECONDS
        while True:
            events = selector.select(timeout)
            if not events:
                return
            timeout = None
            for key, _ in events:
                if key.fileobj is door:
                    terminal, _ = door.accept()
                    mark = terminal.makefile("r").readline().strip()
                    terminals[terminal] = mark
                    selector.register(terminal, selectors.EVENT_READ)
                    terminal.sendall(READY)
                    continue
                gone = next(each for each in terminals if each is key.fileobj)
                selector.unregister(gone)
                hang_up(terminals.pop(gone))
                _answer(gone, OTHERS if terminals else LAST)
            if not terminals:
                return


def _answer(terminal: socket.socket, text: bytes) -> None:
    with terminal:
        try:
            terminal.sendall(text)
        except OSError:
            return  # it does not wait for it


def hang_up(mark: str) -> None:
    """Tell every process of a terminal that the terminal is gone."""
    wanted = f"{VARIABLE}={mark}".encode()
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit() or int(entry.name) == os.getpid():
            continue
        try:
            if wanted in (entry / "environ").read_bytes().split(b"\0"):
                os.kill(int(entry.name), signal.SIGHUP)
                os.kill(int(entry.name), signal.SIGCONT)
        except OSError:
            continue  # it has ended, or is not ours


def lease(mark: str) -> int:
    """Stand for a terminal until standard input ends; say `ready`, and at last who is left."""
    deadline = time.monotonic() + LEASE_SECONDS
    while True:
        try:
            keeper = socket.socket(socket.AF_UNIX)
            keeper.connect(ADDRESS)
            break
        except OSError:
            keeper.close()
            if time.monotonic() > deadline:
                return 1
            time.sleep(POLL_SECONDS)
    with keeper, keeper.makefile("rb") as answers:
        keeper.sendall(f"{mark}\n".encode())
        _say(answers.readline())
        while os.read(0, 4096):
            pass
        keeper.shutdown(socket.SHUT_WR)
        _say(answers.readline())
    return 0


def _say(text: bytes) -> None:
    try:
        sys.stdout.buffer.write(text)
        sys.stdout.buffer.flush()
    except OSError:
        return  # nobody listens any more


if __name__ == "__main__":
    if sys.argv[1:2] == ["lease"]:
        raise SystemExit(lease(sys.argv[2]))
    keep()
