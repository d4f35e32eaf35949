"""Runs variants of a node's files for some milliseconds each, without a build or a probe.

What they log shows which of many changes may help. It is no verdict: ROS time jumps from timer to
timer, nobody else is on the network, and the student's code could say what it likes.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from grader.sandbox.base import Sandbox

PROGRAM = Path(__file__).with_name("run_variants.py")
MOST_BYTES = 4_000_000  # of all answers
EACH_SECONDS = 2.0  # of wall time for one variant
START_SECONDS = 5.0  # of wall time in addition, for the import of ROS
MOST_LINES = 40
JOBS = 2


@dataclass(frozen=True)
class ShortRun:
    """What a variant logged (instant in nanoseconds of ROS time, logger, text), and how it ended.

    `ended` is "lines" or "time" if it still ran, "waits" if it waits for what never comes,
    "returned", "exit", "killed", or an exception with its line. `steps` is how often ROS time went on,
    `slept` whether the code called time.sleep, which holds up the callbacks. `values` are those that
    watched code had first, as Python writes them.
    """

    lines: tuple[tuple[int, str, str], ...]
    ended: str
    steps: int
    slept: bool = False
    values: tuple[tuple[str, ...], ...] = ()

    @property
    def lives(self) -> bool:
        """Whether the node still ran at the end."""
        return self.ended in ("lines", "time")


@dataclass(frozen=True)
class Watched:
    """Code whose values are asked for just before a statement runs, the lines `first` to `last`."""

    file: str
    first: int
    last: int
    code: tuple[str, ...]


KILLED = ShortRun((), "killed", 0)


def run_variants(
    sandbox: Sandbox,
    module: str,
    function: str,
    variants: Sequence[Mapping[str, str]],
    *,
    period: float,
    seconds: float,
    watched: Sequence[Watched] = (),
) -> list[ShortRun | None]:
    """Return what each variant did; None for those that were not run within `seconds`.

    A variant is the new texts of modules by their names; `watched` is of the first variants. The
    workspace has been built.
    """
    asked = {
        "module": module,
        "function": function,
        "variants": variants,
        "watched": [*map(asdict, watched), *[None] * (len(variants) - len(watched))],
        "until": int((MOST_LINES + 5) * period * 1e9),
        "lines": MOST_LINES,
        "each": EACH_SECONDS,
        "seconds": seconds,
        "jobs": JOBS,
    }
    setup = f'. "{sandbox.ros_path}/setup.bash"; . install/local_setup.bash'
    outcome = sandbox.run(
        ["bash", "-c", f'{setup}; exec python3 -B -c "$0"', PROGRAM.read_text(encoding="utf-8")],
        stdin=json.dumps(asked).encode(),
        seconds=seconds + START_SECONDS,
        output=MOST_BYTES,
    )
    found: list[ShortRun | None] = [None] * len(variants)
    for line in outcome.output.decode("utf-8", "replace").splitlines():
        _take(line, found)
    return found


def _take(line: str, found: list[ShortRun | None]) -> None:
    """Read a line of the output, which may be anything."""
    try:
        said = json.loads(line)
        index, seen = said["index"], said["seen"]
        run = KILLED
        if seen is not None:
            lines = tuple((int(at), str(name), str(text)) for at, name, text in seen["lines"])
            values = tuple(tuple(map(str, each)) for each in seen["values"])
            ended, steps = str(seen["ended"]), int(seen["steps"])
            run = ShortRun(lines, ended, steps, bool(seen["slept"]), values)
        if isinstance(index, int) and 0 <= index < len(found):
            found[index] = run
    except (ValueError, TypeError, LookupError, RecursionError):
        return
