"""What the runner says while it works; whoever wants to know (live terminal, ledger, …) listens.

The runner calls one `Listener` with each event, in order, in the thread in which it works; a
listener returns at once and raises nothing. Durations are seconds of wall time.
"""

from __future__ import annotations

from collections.abc import Callable
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from typing import TypeAlias

    from grader.report.model import CheckResult
    from grader.report.model import Visibility


@dataclass(frozen=True)
class StageStarted:
    """A stage (`intake`, `build`, `run`, …) begins; `title` is for people, e.g. "Building"."""

    stage: str
    title: str


@dataclass(frozen=True)
class StageFinished:
    """A stage is over, however it went, after `seconds`."""

    stage: str
    seconds: float


@dataclass(frozen=True)
class CheckStarted:
    """A check is asked now. Who shows events to a student leaves out those that are not visible."""

    id: str
    title: str
    visibility: Visibility = "visible"


@dataclass(frozen=True)
class CheckFinished:
    """A check has its result, which does not change any more in this attempt."""

    result: CheckResult


@dataclass(frozen=True)
class TickSeen:
    """A line of the count has come: its number (None if it has none), its text, its ROS time (s).

    `text` was written by the submission: it may hold anything, control sequences too.
    """

    n: int | None
    text: str
    virtual: float | None


@dataclass(frozen=True)
class Note:
    """Something worth knowing that is no verdict, e.g. why there is a second attempt."""

    text: str


Event: TypeAlias = StageStarted | StageFinished | CheckStarted | CheckFinished | TickSeen | Note
Listener: TypeAlias = Callable[[Event], None]


def to_all(listeners: Sequence[Listener]) -> Listener:
    """Return one listener that hands each event to all of these, in their order."""

    def tell(event: Event) -> None:
        for listener in listeners:
            listener(event)

    return tell
