"""Runs variants of a node's files for some milliseconds each, without a build or a probe.

What they log shows which of many changes may help. It is no verdict: ROS time jumps from timer to
timer, nobody else is on the network, and the student's code could say what it likes.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from grader.run.probe_link import Module, in_probe
from grader.sandbox.base import Sandbox

PROGRAM = Path(__file__).with_name("run_variants.py")
MOST_BYTES = 16_000_000  # of all answers
EACH_SECONDS = 2.0  # for one variant, without the time in which it waits for a core
START_SECONDS = 20.0  # in addition, for the import of ROS
PATIENCE = 3.0
"""Seconds of the run's clock for each second of processor time, after which something is wrong."""
MOST_LINES = 40
JOBS = 2
MALFORMED = (*(ValueError, TypeError, LookupError, AttributeError, OverflowError, RecursionError),)
"""The errors of reading what the student's process may have written instead of an answer."""


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


Place = tuple[str, int]
"""A file of the package, and a line."""
Values = tuple[tuple[str, tuple[str, ...]], ...]
"""Pieces of code, each with the values that it has first."""


@dataclass(frozen=True)
class TracedTimer:
    """A timer of a traced run: where it was made and first stopped, innermost place first.

    `calls` is how often its callback was called, `spun` whether an executor has its node.
    """

    made: tuple[Place, ...]
    spun: bool
    calls: int
    stopped: tuple[Place, ...] = ()


@dataclass(frozen=True)
class TracedCallback:
    """A callback of a subscription or a service (`how`): its function, and how often it was called."""

    how: str
    name: str
    made: tuple[Place, ...]
    function: str
    calls: int


@dataclass(frozen=True)
class TracedDone:
    """A message, a request, an answer or a line of the log: `how` is "published", "asked", "answered" or "logged".

    `at` is in nanoseconds, `places` are those of the call, innermost first, and `last` tells for each
    line that had run when it ran last: the higher, the later.
    """

    how: str
    what: str
    at: int
    places: tuple[Place, ...]
    last: Mapping[str, Mapping[int, int]]


@dataclass(frozen=True)
class Trace:
    """What a short run of a node did: how often each line ran, its timers, and what was logged.

    `logged` has for each line of the log the places of the call and the number of the timer whose
    callback it came from, -1 if from none. `stand` is where threads were at the end. `values`
    are those that pieces of code had first in a line, `ranges` the least and the greatest of
    numbers, `kinds` the different values that are none. `fields` are those of the message whose missing
    attribute ended the node.
    """

    ended: str
    lines: Mapping[str, Mapping[int, int]]
    timers: tuple[TracedTimer, ...] = ()
    logged: tuple[tuple[tuple[Place, ...], int], ...] = ()
    stand: tuple[tuple[Place, ...], ...] = ()
    values: tuple[tuple[Place, Values], ...] = ()
    callbacks: tuple[TracedCallback, ...] = ()
    done: tuple[TracedDone, ...] = ()
    raised: tuple[str, tuple[Place, ...]] | None = None
    fields: tuple[str, ...] = ()
    ranges: Mapping[Place, Mapping[str, tuple[float, float]]] = field(default_factory=dict)
    kinds: Mapping[Place, Mapping[str, tuple[str, ...]]] = field(default_factory=dict)

    def count(self, path: str, line: int) -> int:
        """Return how often a line ran."""
        return self.lines.get(path, {}).get(line, 0)


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

    `seconds` are of processor time, of all variants together. A variant is the new texts of modules
    by their names; `watched` is of the first variants. The workspace has been built.
    """
    found: list[ShortRun | None] = [None] * len(variants)
    watching = [*map(asdict, watched), *[None] * (len(variants) - len(watched))]
    asked = {"variants": variants, "watched": watching, "traced": [], "conditions": []}
    for said in answers(sandbox, module, function, asked, period=period, seconds=seconds):
        _take(said, found)
    return found


def trace_node(
    sandbox: Sandbox,
    module: str,
    function: str,
    files: Sequence[str],
    *,
    period: float,
    seconds: float,
    conditions: Sequence[Watched] = (),
) -> Trace | None:
    """Return what a node does, followed in these files; None if it was not run within `seconds`.

    The workspace has been built.
    """
    asked = {
        "variants": [{}],
        "watched": [None],
        "traced": files,
        "conditions": [*map(asdict, conditions)],
    }
    for said in answers(sandbox, module, function, asked, period=period, seconds=seconds):
        with suppress(*MALFORMED):
            return trace_from(json.loads(said)["seen"], files, conditions)
    return None


def answers(
    sandbox: Sandbox,
    module: str,
    function: str,
    more: Mapping[str, Any],
    *,
    period: float,
    seconds: float,
    modules: Sequence[Module] = (),
) -> list[str]:
    """Return what the program says, a line for each variant; `seconds` are of processor time."""
    asked = {
        "modules": [in_probe("short_trace"), *modules],
        "module": module,
        "function": function,
        "until": int((MOST_LINES + 5) * period * 1e9),
        "lines": MOST_LINES,
        "each": EACH_SECONDS,
        "seconds": seconds,
        "jobs": JOBS,
        **more,
    }
    outcome = sandbox.run(
        [
            "bash",
            "-c",
            sandbox.in_workspace('python3 -B -c "$0"'),
            PROGRAM.read_text(encoding="utf-8"),
        ],
        stdin=json.dumps(asked).encode(),
        seconds=PATIENCE * seconds + START_SECONDS,
        output=MOST_BYTES,
    )
    return outcome.output.decode("utf-8", "replace").splitlines()


def trace_from(seen: Any, files: Sequence[str], conditions: Sequence[Watched]) -> Trace:
    """Read a trace, which may be anything: raises an error of Python if it has another form.

    Only places in these files are kept.
    """

    def places(found: Any) -> tuple[Place, ...]:
        return tuple((path, int(line)) for path, line in found if path in files)

    found = seen["trace"]

    def last(said: Any) -> dict[str, dict[int, int]]:
        return {
            path: {int(row): int(n) for row, n in rows.items()}
            for path, rows in said.items()
            if path in files
        }

    callbacks = [
        TracedCallback(
            str(one["how"]),
            str(one["name"]),
            places(one["made"]),
            str(one["function"]),
            int(one["calls"]),
        )
        for one in found["callbacks"]
    ]
    done = [
        TracedDone(
            str(one["how"]),
            str(one["what"]),
            int(one["at"]),
            places(one["places"]),
            last(one["last"]),
        )
        for one in found["done"]
    ]
    raised = found["raised"]
    timers = [
        TracedTimer(
            places(one["made"]), bool(one["spun"]), int(one["calls"]), places(one["stopped"])
        )
        for one in found["timers"]
    ]
    return Trace(
        str(seen["ended"]),
        last(found["lines"]),
        tuple(timers),
        tuple((places(at), int(timer)) for at, timer in found["logged"]),
        tuple(map(places, found["stand"])),
        tuple(
            (
                (one.file, one.first),
                tuple((code, tuple(map(str, each))) for code, each in zip(one.code, values)),
            )
            for one, values in zip(conditions, found["values"])
        ),
        tuple(callbacks),
        tuple(done),
        (str(raised["text"]), places(raised["places"])) if raised else None,
        tuple(map(str, raised["fields"])) if raised else (),
        {
            (one.file, one.first): {
                code: (float(each[0]), float(each[1]))
                for code, each in zip(one.code, ranges)
                if each
            }
            for one, ranges in zip(conditions, found["ranges"])
        },
        {
            (one.file, one.first): {
                code: tuple(map(str, each)) for code, each in zip(one.code, kinds) if each
            }
            for one, kinds in zip(conditions, found["kinds"])
        },
    )


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
    except MALFORMED:
        return
