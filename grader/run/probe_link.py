"""The grader's side of the probe: one JSON line out, one in. Its answers are untrusted data."""

from __future__ import annotations

import contextlib
import json
import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from grader.base.errors import SurroundingsError
from grader.sandbox.base import Sandbox

SOURCE = Path(__file__).with_name("probe.py")
Module = tuple[str, str]  # its name and its text
START_SECONDS = 30.0
LONGEST_ANSWER = 8_000_000  # bytes
END_SECONDS = 1.0
UNPACK = """\
place=$(mktemp -d)
head -c {size} | tar -xf - -C "$place"
export AMENT_PREFIX_PATH="$place" LD_LIBRARY_PATH="$place/lib"
export PYTHONPATH=$(echo "$place"/lib/python3*/site-packages)
"""
STAMP_TOLERANCE = 250_000_000  # ns between a record's stamp and the time of reading, to agree
PATIENCE = 20.0  # seconds in addition to a command's own, within which the answer must come


def in_probe(name: str) -> Module:
    """Return a module of `in_probe`, for the probe, which has no other of the grader's modules."""
    text = SOURCE.with_name("in_probe").joinpath(f"{name}.py").read_text(encoding="utf-8")
    return f"grader.run.in_probe.{name}", text


LEVELS = {"debug": 10, "info": 20, "warn": 30, "error": 40, "fatal": 50}
"""Of log records, as in rcl_interfaces/msg/Log."""


@dataclass(frozen=True)
class LogRecord:
    """One record of /rosout; `level` is one of LEVELS' values.

    In nanoseconds since the epoch, `stamp` is when the sender says that it was logged, `read` when
    the probe read it, 0 if that is unknown.
    """

    level: int
    name: str
    text: str
    function: str
    file: str
    line: int
    stamp: int
    read: int = 0

    @property
    def agrees(self) -> bool:
        """Whether it was read soon after its stamp says that it was logged."""
        return 0 <= self.read - self.stamp <= STAMP_TOLERANCE

    def is_forged(self, began: int) -> bool:
        """Whether no logger can have made the stamp: it is of the future, or from before the run.

        The run `began` then (0 if that is unknown), by the clock of the probe. A record can be read
        late, under load or because it was sent before the probe was known. Of a clock that was set
        back during the run, nothing is known.
        """
        if self.read <= 0:
            return False
        early = 0 < began <= self.read and self.stamp < began - STAMP_TOLERANCE
        return early or self.stamp > self.read + STAMP_TOLERANCE


@dataclass(frozen=True)
class NodeSeen:
    """A node on the graph: its full name, and which endpoints it has.

    `clock` is a /clock subscription, `rosout` a /rosout publisher, `parameters` the parameter
    service, `services` any service that can be asked. `answers` is whether one ever answered,
    `sim_time` the value of use_sim_time, None if it is unknown.
    """

    name: str
    clock: bool
    rosout: bool
    parameters: bool
    services: bool = False
    answers: bool = False
    sim_time: bool | None = None

    @property
    def logger(self) -> str:
        """The name of the node's logger (rcl's `rcl_node_get_logger_name`)."""
        return self.name.strip("/").replace("/", ".")


@dataclass(frozen=True)
class Answer:
    """An answer of the probe.

    `barrier` is whether the nodes that spin answered, None if unknown; `silent` is the number of
    nodes that were asked and have never answered. `doubled` has the nodes with more than one
    publisher on /rosout.
    """

    barrier: bool | None = None
    logs: tuple[LogRecord, ...] = ()
    nodes: tuple[NodeSeen, ...] = ()
    clocks: int = 0
    matched: bool = False
    silent: int = 0
    doubled: tuple[str, ...] = ()


class ProbeError(SurroundingsError):
    """The probe did not answer: a fault of the grader's side, never of the student's."""


class ProbeLink:
    """A probe in a sandbox. It starts at once and answers as soon as rclpy is up.

    `interfaces` is a tar archive of more interfaces that it can use.
    """

    def __init__(self, sandbox: Sandbox, interfaces: bytes = b"") -> None:
        setup = f'. "{sandbox.ros_path}/setup.bash"; exec python3 -c "$PROBE"'
        if interfaces:
            setup = f"{UNPACK.format(size=len(interfaces))}{setup}"
        script = (
            f"PROBE=$(cat <<'PROBE_ENDS'\n{SOURCE.read_text(encoding='utf-8')}\nPROBE_ENDS\n)\n"
        )
        self.pipe = sandbox.probe(["bash", "-c", script + setup])
        if interfaces:
            with contextlib.suppress(OSError):  # (a probe that has ended is noticed later)
                self.pipe.write(interfaces)
        self._buffer = b""
        self._ready = False
        self._shown: tuple[int, int] | None = None  # its clock and ours (ns) at its last answer
        self._run_clock = sandbox.run_clock
        self.until = math.inf
        """The time (of the run's clock) until which answers are awaited."""

    def ready(self) -> None:
        """Wait until rclpy is up in the probe."""
        if not self._ready:
            self._read(START_SECONDS)
            self._ready = True

    def now(self) -> int:
        """Return what the probe's clock shows (ns), as its last answer said it; 0 if unknown.

        It may be a little early: an answer is read later than it was written.
        """
        if self._shown is None:
            return 0
        theirs, ours = self._shown
        return theirs + time.monotonic_ns() - ours

    def extend(self, modules: Sequence[Module]) -> None:
        """Add the commands of the last of these modules to the probe."""
        self.said("extend", seconds=1, modules=modules)

    def ask(self, do: str, *, seconds: float = 0, **more: int | str) -> Answer:
        """Send one command and return the answer; ProbeError if none comes."""
        return self.answer_of(self.said(do, seconds=seconds, **more))

    def said(self, do: str, *, seconds: float = 0, **more: object) -> dict[str, Any]:
        """Send one command and return the answer as it came; ProbeError if none comes."""
        self.ready()
        try:
            command = {"do": do, "seconds": seconds, **more}
            self.pipe.write(json.dumps(command).encode() + b"\n")
        except OSError as error:
            raise self._lost("it has ended") from error
        return self._read(seconds + PATIENCE)

    def answer_of(self, said: Mapping[str, Any]) -> Answer:
        """Return what every answer has; ProbeError if it does not have that."""
        try:
            return Answer(
                barrier=said["barrier"],
                logs=tuple(LogRecord(**log) for log in said["logs"]),
                nodes=tuple(NodeSeen(**node) for node in said.get("nodes", ())),
                clocks=said["clocks"],
                matched=said.get("matched", False),
                silent=said.get("silent", 0),
                doubled=tuple(str(name) for name in said.get("doubled", ())),
            )
        except (KeyError, TypeError) as error:
            raise self._lost("its answer lacks keys or has unknown ones") from error

    def _read(self, seconds: float) -> dict[str, Any]:
        limit = self._run_clock.limit(min(seconds, self.until - self._run_clock.now()))
        while b"\n" not in self._buffer:
            data = self.pipe.read(limit.slice)
            if limit.over and b"\n" not in (data or b""):  # (an unfinished answer extends nothing)
                raise self._lost(f"no answer within {seconds:.0f} s")
            if data is None:
                continue
            if not data or len(self._buffer) > LONGEST_ANSWER:
                raise self._lost("it has ended")
            self._buffer += data
        line, _, self._buffer = self._buffer.partition(b"\n")
        try:
            answer = json.loads(line)
        except ValueError as error:
            raise self._lost("its answer is not JSON") from error
        if not isinstance(answer, dict):
            raise self._lost("its answer is not a JSON object")
        if isinstance(answer.get("now"), int):
            self._shown = (answer["now"], time.monotonic_ns())
        return answer

    def _lost(self, why: str) -> ProbeError:
        self.pipe.kill()
        said = self.pipe.errors().decode(errors="replace").strip()
        return ProbeError(f"the probe failed: {why}" + (f"\n{said}" if said else ""))

    def close(self) -> None:
        """Tell the probe to end, and kill it if it does not."""
        with contextlib.suppress(OSError, ValueError):
            self.pipe.write(b'{"do": "end"}\n')
        self.pipe.finish(END_SECONDS)
