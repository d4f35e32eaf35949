"""Runs `check` for the page: one at a time, in a program of its own."""

from __future__ import annotations

import asyncio
import contextlib
import os
import signal
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

Message = dict[str, Any]
MOST_OUTPUT = 200_000  # bytes of what it prints, the newest
PART = 64 * 1024
END_SECONDS = 5.0


class Checking:
    """The program, and what it printed; `on_change` gets each change of state."""

    def __init__(
        self, program: Path, environment: Mapping[str, str], on_change: Callable[[Message], None]
    ) -> None:
        self._program = program
        self._environment = {**environment, "TERM": "dumb", "NO_COLOR": "1"}
        self._on_change = on_change
        self._process: asyncio.subprocess.Process | None = None
        self._running: asyncio.Task[None] | None = None
        self.state: Message = {"kind": "check", "state": "idle", "printed": ""}

    def start(self) -> None:
        """Start it, unless it runs."""
        if self._running is None:
            self._running = asyncio.create_task(self._run())

    def stop(self) -> None:
        """End it as Ctrl+C does."""
        if self._process is not None and self._process.returncode is None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGINT)

    async def close(self) -> None:
        """End it, and wait until it has ended."""
        running = self._running
        if running is None:
            return
        self.stop()
        with contextlib.suppress(asyncio.TimeoutError):
            await asyncio.wait_for(asyncio.shield(running), END_SECONDS)
            return
        if self._process is not None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGKILL)

    async def _run(self) -> None:
        self._say(state="running", printed="")
        printed, status = b"", None
        try:
            self._process = await asyncio.create_subprocess_exec(
                str(self._program),
                stdin=asyncio.subprocess.DEVNULL,
                stdout=asyncio.subprocess.PIPE,
                stderr=asyncio.subprocess.STDOUT,
                env=self._environment,
                start_new_session=True,
            )
            assert self._process.stdout is not None
            while part := await self._process.stdout.read(PART):
                printed = (printed + part)[-MOST_OUTPUT:]
            status = await self._process.wait()
        except OSError as error:
            printed += str(error).encode()
        finally:
            self._running = self._process = None
        self._say(state="ended", status=status, printed=printed.decode("utf-8", "replace"))

    def _say(self, **changes: Any) -> None:
        self.state = {"kind": "check", **changes}
        self._on_change(self.state)
