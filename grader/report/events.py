"""The events of marking, for listeners (live terminal, ledger, …).

Marking calls one `Listener` with each event, in order, in its own thread; a listener returns
immediately and raises nothing. Durations are seconds of wall time.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from typing import TypeAlias

    from grader.report.model import CheckResult, Visibility


@dataclass(frozen=True)
class StageStarted:
    """A stage (`intake`, `build`, `run`, …) begins; `title` is for people, e.g. "Building"."""

    stage: str
    title: str


@dataclass(frozen=True)
class StageFinished:
    """A stage ended, with or without success, after `seconds`."""

    stage: str
    seconds: float


@dataclass(frozen=True)
class CheckStarted:
    """A check begins. A listener for students leaves out those that are not visible."""

    id: str
    title: str
    visibility: Visibility = "visible"


@dataclass(frozen=True)
class CheckFinished:
    """A check has its result, which is final for this attempt."""

    result: CheckResult


@dataclass(frozen=True)
class TickSeen:
    """A line of the count: its number (None if it has none), its text, its ROS time (s).

    `text` comes from the submission: it may contain anything, including control sequences.
    """

    n: int | None
    text: str
    virtual: float | None


@dataclass(frozen=True)
class Note:
    """Information that is not a verdict, e.g. why there is a second attempt."""

    text: str


Event: TypeAlias = StageStarted | StageFinished | CheckStarted | CheckFinished | TickSeen | Note
Listener: TypeAlias = Callable[[Event], None]


def to_all(listeners: Sequence[Listener]) -> Listener:
    """Return one listener that passes each event to all of these, in their order."""

    def notify(event: Event) -> None:
        for listener in listeners:
            listener(event)

    return notify
