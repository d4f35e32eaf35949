"""The limits on a submission.

Units are seconds and bytes. An assignment (`limits:`) or the command line (`--limit name=value`)
overrides any of them; the report says what enforced each one. Time limits are on the run's clock, which
stands still while a process waits for a core (`scheduling`); no output extends them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace

from grader.base.errors import UsageError
from grader.base.i18n.message import joined, say
from grader.base.nearest import did_you_mean

MEGABYTE = 1_000_000
PROBE_MEMORY = 2_500 * MEGABYTE  # of addresses, of which a probe that nobody floods uses a third
RUNS = 2  # that fit into a verdict: a run, and a second one to confirm it
OVERRUN_SECONDS = 30.0  # of a run beyond its limits: the probe's answers and the cleanup


@dataclass(frozen=True)
class Limits:
    """The limits of one verdict."""

    build_seconds: float = 60
    """Time of `colcon build`."""
    start_seconds: float = 15
    """Time from `ros2 run` until a node is on the ROS graph."""
    run_seconds: float = 60
    """Time of the whole run."""
    stop_seconds: float = 5
    """Time from Ctrl+C until the end of `ros2 run`."""
    cpu_seconds: float = 60
    """Processor time of each process."""
    memory: float = 1_000 * MEGABYTE
    """Of all processes and files in memory together; of each process without a cgroup."""
    processes: float = 200
    """Processes and threads."""
    cpus: float = 2
    """Number of processors."""
    file_size: float = 100 * MEGABYTE
    """Size of one file."""
    workspace: float = 300 * MEGABYTE
    """Size of the workspace, a file system in memory; `/tmp`, `/dev/shm` and home: a tenth each."""
    output: float = 1 * MEGABYTE
    """Output of a command before it is stopped."""

    @property
    def max_run_seconds(self) -> float:
        """Seconds reserved for one run; no run is started with less time left."""
        return self.start_seconds + self.run_seconds + self.stop_seconds + OVERRUN_SECONDS

    @property
    def verdict_seconds(self) -> float:
        """The time limit of a verdict in seconds, from opened sandbox to last check.

        It includes everything that is repeated: runs, confirming runs, retries after grader faults.
        """
        return self.build_seconds + OVERRUN_SECONDS + RUNS * self.max_run_seconds

    def override(self, values: Mapping[str, float]) -> Limits:
        """Return a copy with other values; UsageError for an unknown name or a value <= 0."""
        for name, value in values.items():
            if name not in UNITS:
                known = say("Limits: {names}.", names=", ".join(UNITS))
                raise UsageError(
                    say("there is no limit '{name}'", name=name),
                    remedy=joined(did_you_mean(name, UNITS), known),
                )
            if not value > 0:
                number = f"{value:g}"
                raise UsageError(
                    say("the limit {name} must be above 0, not {value}", name=name, value=number)
                )
        return replace(self, **values)


def _unit(name: str) -> str:
    if name.endswith("_seconds"):
        return "s"
    return "" if name in ("processes", "cpus") else "bytes"


UNITS = {field.name: _unit(field.name) for field in fields(Limits)}
