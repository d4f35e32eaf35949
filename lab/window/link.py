"""The server's end of the bridge: starts it under ROS's Python, and starts it again."""

from __future__ import annotations

import asyncio
import contextlib
import json
from collections import deque
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from grader.base.errors import SurroundingsError
from grader.base.i18n.message import say
from grader.ros.distro import distros, sourced

PROGRAM = Path(__file__).resolve().parent / "bridge" / "__main__.py"
PROFILE = PROGRAM.with_name("fastdds.xml")
SCRIPT = '[ -z "$1" ] || ! [ -f "$1" ] || . "$1" > /dev/null; exec python3 "$0"'
OVERLAY = "ros2_ws/install/local_setup.bash"
LONGEST_LINE = 16 * 1024 * 1024  # bytes
MOST_WAITING = 1024 * 1024  # bytes of commands that the bridge has not read
AGAIN_SECONDS = 1.0
MOST_FAILURES = 3  # in a row, without having been ready
END_SECONDS = 2.0
LAST_LINES = 12  # of stderr

Message = dict[str, Any]


class Link:
    """A running bridge; `on_message` gets each of its messages.

    It also gets `{"kind": "bridge", "state": …}`: `ended` before it is started again, `failed` if it
    does not start, with the last lines that it printed.
    """

    def __init__(self, environment: Mapping[str, str], on_message: Callable[[Message], None]):
        _require_ros(environment)
        self._environment = bridge_environment(environment)
        self._on_message = on_message
        self._process: asyncio.subprocess.Process | None = None
        self._failures = 0

    async def run(self) -> None:
        """Keep the bridge running until this task is cancelled."""
        try:
            while self._failures < MOST_FAILURES:
                printed = await self._run_once()
                self._failures += 1
                failed = self._failures >= MOST_FAILURES
                state = "failed" if failed else "ended"
                self._on_message({"kind": "bridge", "state": state, "text": "\n".join(printed)})
                await asyncio.sleep(AGAIN_SECONDS)
        finally:
            await self._end()

    async def _run_once(self) -> list[str]:
        """Run the bridge until it ends; return the last lines that it printed."""
        self._process = process = await asyncio.create_subprocess_exec(
            *["bash", "-c", SCRIPT, str(PROGRAM), _overlay(self._environment)],
            stdin=asyncio.subprocess.PIPE,
            stdout=asyncio.subprocess.PIPE,
            stderr=asyncio.subprocess.PIPE,
            env=self._environment,
            limit=LONGEST_LINE,
            start_new_session=True,  # Ctrl+C is for the server, which ends the bridge
        )
        printed: deque[str] = deque(maxlen=LAST_LINES)
        assert process.stdout is not None and process.stderr is not None
        await asyncio.gather(self._read(process.stdout), _keep(process.stderr, printed))
        await process.wait()
        return list(printed)

    async def _read(self, stream: asyncio.StreamReader) -> None:
        async for line in stream:
            message = json.loads(line)
            if message["kind"] == "ready":
                self._failures = 0
            self._on_message(message)

    def send(self, command: Message) -> None:
        """Send a command; it is lost if the bridge does not read."""
        process = self._process
        if process is None or process.stdin is None or process.stdin.is_closing():
            return
        if process.stdin.transport.get_write_buffer_size() < MOST_WAITING:
            process.stdin.write(json.dumps(command).encode() + b"\n")

    def restart(self) -> None:
        """End the bridge; it is started again with the workspace as it is built now."""
        self._failures = 0
        if self._process is not None and self._process.stdin is not None:
            self._process.stdin.close()

    async def _end(self) -> None:
        process, self._process = self._process, None
        if process is None or process.returncode is not None:
            return
        assert process.stdin is not None
        process.stdin.close()
        try:
            await asyncio.wait_for(process.wait(), END_SECONDS)
        except asyncio.TimeoutError:
            with contextlib.suppress(ProcessLookupError):
                process.kill()
            await process.wait()


async def _keep(stream: asyncio.StreamReader, printed: deque[str]) -> None:
    async for line in stream:
        printed.append(line.decode(errors="replace").rstrip()[:500])


def bridge_environment(environment: Mapping[str, str]) -> dict[str, str]:
    """Return the environment of the bridge: the terminal's, and a Fast DDS profile if it has none."""
    own = dict(environment)
    if not any(row.dds_profile in own for row in distros().values()):
        own[sourced(own).dds_profile] = str(PROFILE)
    return own


def _overlay(environment: Mapping[str, str]) -> str:
    """Return the set-up file of the lab's workspace, which has the student's own interfaces."""
    if not environment.get("LAB_PROGRAMS"):
        return ""  # not in the lab: what the terminal has sourced
    return str(Path(environment.get("HOME", "/"), OVERLAY))


def _require_ros(environment: Mapping[str, str]) -> None:
    if not environment.get("AMENT_PREFIX_PATH"):
        raise SurroundingsError(
            say("ROS is not set up in this terminal, so the window cannot see any node"),
            remedy=say("Open the lab with make lab, and run the command there."),
        )
