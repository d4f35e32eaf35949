"""JSON lines between the bridge and the server: one thread reads commands, the loop writes."""

from __future__ import annotations

import json
import os
import queue
import threading
from collections.abc import Callable, Iterator
from typing import Any

BLOCK = 65_536  # bytes
MOST_COMMANDS = 1_000  # that wait; the reader stops until they are taken


class Wire:
    """The bridge's end of the pipe. `wake` is called from another thread for each command."""

    def __init__(self, wake: Callable[[], None]) -> None:
        # the output of C libraries must not get between the messages
        self._out = os.fdopen(os.dup(1), "w", encoding="utf-8", newline="\n")
        os.dup2(2, 1)
        self._commands: queue.Queue[dict[str, Any]] = queue.Queue(MOST_COMMANDS)
        self._wake = wake
        self.ended = False
        """Whether the server has closed its end."""
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        rest = b""
        # not sys.stdin: at the end, Python would wait for the lock that its reader holds
        while block := os.read(0, BLOCK):
            *lines, rest = (rest + block).split(b"\n")
            for line in lines:
                self._commands.put(json.loads(line))
            self._wake()
        self.ended = True
        self._wake()

    def commands(self) -> Iterator[dict[str, Any]]:
        """Yield the commands that have arrived."""
        while True:
            try:
                yield self._commands.get_nowait()
            except queue.Empty:
                return

    def send(self, kind: str, **content: Any) -> None:
        """Send a message; the bridge ends if nobody reads it any more."""
        try:
            text = json.dumps({"kind": kind, **content}, allow_nan=False, separators=(",", ":"))
            self._out.write(text + "\n")
            self._out.flush()
        except BrokenPipeError:
            self.ended = True
