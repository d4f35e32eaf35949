"""The programs of the window's tests: a ROS environment, nodes, and the window itself."""

from __future__ import annotations

import contextlib
import os
import queue
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from lab.window.link import bridge_environment
from tests.domains import new_domain

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SECONDS = 30.0  # in which anything must have happened
END_SECONDS = 10.0
ADDRESS = re.compile(r"http://127\.0\.0\.1:(\d+)/\?token=(\S+)")


def ros_environment(prefix: Path, folder: Path) -> dict[str, str]:
    """Return the environment of a terminal with ROS, whose nodes see only each other."""
    script = f'. "{prefix}/setup.bash" && env -0'
    clean = {"PATH": "/usr/local/bin:/usr/bin:/bin", "HOME": str(folder), "LC_ALL": "C.UTF-8"}
    found = subprocess.run(["bash", "-c", script], env=clean, capture_output=True, check=True)
    pairs = (entry.partition("=") for entry in found.stdout.decode().split("\0") if entry)
    own = {
        "ROS_DOMAIN_ID": new_domain(),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_LOG_DIR": str(folder / "log"),
    }
    return {name: value for name, _, value in pairs} | own


@contextlib.contextmanager
def started(
    words: list[str], env: Mapping[str, str], **options: Any
) -> Iterator[subprocess.Popen[bytes]]:
    """Run a program in a session of its own; at the end it gets Ctrl+C."""
    process = subprocess.Popen(
        words, env=dict(env), cwd=ROOT, stdout=subprocess.PIPE, start_new_session=True, **options
    )
    try:
        yield process
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGINT)
        try:
            process.wait(END_SECONDS)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            raise
        finally:
            assert process.stdout is not None
            process.stdout.close()


@contextlib.contextmanager
def nodes(env: Mapping[str, str], *names: str) -> Iterator[None]:
    """Run nodes of nodes.py in one program."""
    with started(["python3", str(HERE / "nodes.py"), *names], env) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == b"ready\n"
        yield


@contextlib.contextmanager
def turtles(env: Mapping[str, str], count: int, *options: str) -> Iterator[None]:
    """Run the stand-in for turtlesim."""
    with started(["python3", str(HERE / "turtles.py"), str(count), *options], env):
        yield


@dataclass(frozen=True)
class OpenWindow:
    """A running window."""

    process: subprocess.Popen[bytes]
    port: int
    token: str

    @property
    def origin(self) -> str:
        return f"http://127.0.0.1:{self.port}"

    @property
    def address(self) -> str:
        return f"{self.origin}/?token={self.token}"

    @property
    def bridge(self) -> int:
        """The process id of its bridge."""
        found: list[int] = until(lambda: children(self.process.pid))
        return found[0]


@contextlib.contextmanager
def window(env: Mapping[str, str], *options: str) -> Iterator[OpenWindow]:
    """Run the window's command, and wait for its address."""
    words = [sys.executable, "-m", "lab.window", "--no-open", *options]
    with started(words, env) as process:
        assert process.stdout is not None
        for line in process.stdout:
            match = ADDRESS.search(line.decode())
            if match:
                yield OpenWindow(process, int(match[1]), match[2])
                return
        raise AssertionError("the window did not say its address")


def children(parent: int) -> list[int]:
    """Return the process ids of a process' children."""
    path = Path(f"/proc/{parent}/task/{parent}/children")
    return [int(word) for word in path.read_text().split()]


def alive(process: int) -> bool:
    """Whether a process runs (an ended one that nobody has waited for does not)."""
    try:
        stat = Path(f"/proc/{process}/stat").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return False
    return stat.rpartition(")")[2].split()[0] != "Z"


def until(condition: Callable[[], Any], seconds: float = SECONDS) -> Any:
    """Wait until something outside this process is so, and return it."""
    deadline = time.monotonic() + seconds
    while not (found := condition()):
        assert time.monotonic() < deadline, "it did not happen in time"
        time.sleep(0.01)
    return found


@dataclass
class Talk:
    """A conversation with a bridge; what it says is read as it comes."""

    process: subprocess.Popen[bytes]
    heard: queue.Queue[dict[str, Any]] = field(default_factory=queue.Queue)

    def __post_init__(self) -> None:
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        import json

        assert self.process.stdout is not None
        with contextlib.suppress(ValueError):  # closed at the end of the test
            for line in self.process.stdout:
                self.heard.put(json.loads(line))

    def say(self, **command: Any) -> None:
        import json

        assert self.process.stdin is not None
        self.process.stdin.write(json.dumps(command).encode() + b"\n")
        self.process.stdin.flush()

    def hear(
        self, kind: str, fits: Callable[[dict[str, Any]], Any] = lambda _: True
    ) -> dict[str, Any]:
        """Return the next message of a kind that fits; others are passed over."""
        deadline = time.monotonic() + SECONDS
        passed: list[dict[str, Any]] = []
        while True:
            message = self._next(deadline, passed)
            if message["kind"] == kind and fits(message):
                return message
            passed.append(message)

    def hear_each(self, *kinds: str) -> dict[str, dict[str, Any]]:
        """Return the next message of each kind, in whatever order they come."""
        deadline = time.monotonic() + SECONDS
        found: dict[str, dict[str, Any]] = {}
        while len(found) < len(kinds):
            message = self._next(deadline, [*found.values()])
            if message["kind"] in kinds:
                found.setdefault(message["kind"], message)
        return found

    def _next(self, deadline: float, before: list[dict[str, Any]]) -> dict[str, Any]:
        """Return the next message; fail at the deadline with those that came before."""
        try:
            return self.heard.get(timeout=max(0.01, deadline - time.monotonic()))
        except queue.Empty:
            raise AssertionError(f"the bridge said only {before[-20:]}") from None


@contextlib.contextmanager
def bridge(env: Mapping[str, str]) -> Iterator[Talk]:
    """Run the bridge as the server does."""
    program = str(ROOT / "lab" / "window" / "bridge" / "__main__.py")
    with started(["python3", program], bridge_environment(env), stdin=subprocess.PIPE) as process:
        talk = Talk(process)
        talk.hear("ready")
        yield talk
