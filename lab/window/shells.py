"""Where the shells of the terminals come from: the keeper, which outlives this server, or this one."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import socket
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Protocol

from lab.window.keeper import MOST_BYTES, MOST_SHELLS, Shell, start_shell


class Shells(Protocol):
    """Starts shells, and knows those of the server before."""

    def open(self, number: int, rows: int, columns: int) -> Shell:
        """Start a shell."""

    def kept(self) -> dict[int, Shell]:
        """Return the shells that run already, by number."""

    def forget(self, number: int, shell: Shell) -> None:
        """Note that a shell has ended."""


class OwnShells:
    """Shells of this process, which end with it."""

    def __init__(self, environment: Mapping[str, str], folder: Path) -> None:
        self._environment = dict(environment)
        self._folder = str(folder)

    def open(self, number: int, rows: int, columns: int) -> Shell:
        """Start a shell."""
        del number
        return start_shell(rows, columns, self._environment, self._folder)

    def kept(self) -> dict[int, Shell]:
        """Return none: they have ended with the server before."""
        return {}

    def forget(self, number: int, shell: Shell) -> None:
        """Wait for a shell that has ended; it is killed if it has only closed its terminal."""
        del number
        with contextlib.suppress(OSError):
            os.kill(shell.pid, signal.SIGKILL)
            os.waitpid(shell.pid, 0)


class KeptShells:
    """Shells of the keeper at the other end of a socket."""

    def __init__(self, channel: int, environment: Mapping[str, str], folder: Path) -> None:
        self.channel = socket.socket(fileno=channel)
        os.set_inheritable(channel, False)
        self._environment = dict(environment)
        self._folder = str(folder)

    def open(self, number: int, rows: int, columns: int) -> Shell:
        """Start a shell."""
        answer, (terminal, memory) = self._ask(
            do="open",
            number=number,
            rows=rows,
            columns=columns,
            environment=self._environment,
            folder=self._folder,
        )
        return Shell(int(answer["pid"]), terminal, memory)

    def kept(self) -> dict[int, Shell]:
        """Return the shells that run already, by number."""
        answer, given = self._ask(do="list")
        pairs = zip(given[::2], given[1::2])
        return {n: Shell(pid, *pair) for (n, pid), pair in zip(answer["shells"], pairs)}

    def forget(self, number: int, shell: Shell) -> None:
        """Close the keeper's ends of a shell that has ended."""
        del shell
        with contextlib.suppress(OSError):
            self._ask(do="forget", number=number)

    def _ask(self, **asked: object) -> tuple[Any, list[int]]:
        self.channel.sendall(json.dumps(asked).encode())
        text, given, _, _ = socket.recv_fds(self.channel, MOST_BYTES, 2 * MOST_SHELLS)
        return json.loads(text or b"{}"), list(given)
