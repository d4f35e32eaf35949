"""The geometry of the two plots, in the units of their view box; the templates draw them.

They do not use matplotlib: it puts 45 style attributes into one such plot, which the page's
content security policy forbids, fixes the colours for light or dark, and takes 18 ms per plot
(measured with 3.11), with 174 MB to install. These set colours by class and keep text as text.
"""

from __future__ import annotations

import bisect
import math
from collections.abc import Sequence
from dataclasses import dataclass

from grader.publish.pages.overview import Bin
from grader.report.model import Observed, RunInfo, Tick
from grader.run.in_probe.turtlesim import SIZE

WIDTH = 400.0
EDGE = 24.0  # margin at the ends of an axis
LANES = 44.0  # width of the lane names at the left of the timeline
ON_TIME = 0.0005  # seconds of ROS time: instants are reported to 1 ms, and 1 ms early is early
PIECE = 60  # points of a piece of a line: a page cuts longer texts
MOST_DUE, MOST_TICKS, MOST_LABELS = 400, 200, 12
HIGHEST_LABEL, LABEL_WIDTH = 999, 14.0
STEPS = (1, 2, 5)


@dataclass(frozen=True)
class Bar:
    """A bar of the histogram, standing on `bottom`."""

    bin: Bin
    x: float
    y: float
    width: float
    height: float


@dataclass(frozen=True)
class Histogram:
    """Bars of equal width without gaps along the points axis."""

    bars: tuple[Bar, ...]
    width: float = WIDTH
    height: float = 150.0
    bottom: float = 122.0


def histogram(bins: Sequence[Bin]) -> Histogram:
    """Return the bars, scaled so that the highest fills the height."""
    top, bottom = 18.0, Histogram.bottom
    most = max((b.count for b in bins), default=0) or 1
    step = (WIDTH - 2 * EDGE) / max(len(bins), 1)
    bars = []
    for number, one in enumerate(bins):
        height = (bottom - top) * one.count / most
        left = EDGE + number * step + 1
        bars.append(Bar(one, round(left, 1), round(bottom - height, 1), step - 2, round(height, 1)))
    return Histogram(tuple(bars))


@dataclass(frozen=True)
class Dot:
    """A log line: `at` in seconds on the axis, `off` in seconds from the nearest due instant."""

    tick: Tick
    at: float
    x: float
    off: float | None

    @property
    def on_time(self) -> bool:
        """Whether it came at a due instant, within the precision of the reported instants."""
        return self.off is not None and abs(self.off) <= ON_TIME


@dataclass(frozen=True)
class Timeline:
    """Ticks against due instants: (x, seconds) pairs for the due instants and the axis."""

    clock: str
    dots: tuple[Dot, ...]
    due: tuple[tuple[float, float], ...]
    axis: tuple[tuple[float, float], ...]
    missed: tuple[float, ...] = ()
    left_out: int = 0
    width: float = WIDTH
    height: float = 106.0

    @property
    def labels(self) -> list[tuple[float, str]]:
        """The numbers above the dots: none if there are too many, one for dots close together."""
        if len(self.dots) > MOST_LABELS:
            return []
        found: list[tuple[float, str]] = []
        for dot in sorted(self.dots, key=lambda dot: dot.x):
            if dot.tick.n is None or abs(dot.tick.n) > HIGHEST_LABEL:
                continue
            if found and dot.x - found[-1][0] < LABEL_WIDTH:
                found[-1] = (found[-1][0], f"{found[-1][1]}, {dot.tick.n}")
            else:
                found.append((dot.x, str(dot.tick.n)))
        return found


def timeline(observed: Observed) -> Timeline | None:
    """Return the plot of a run; None if no line came or the times are unknown.

    Instants are ROS time on the virtual clock. On the wall clock no instant is due by itself, so
    they count from the first line.
    """
    virtual = observed.clock == "virtual"
    timed = [(tick.virtual if virtual else tick.wall, tick) for tick in observed.ticks]
    known = [(at, t) for at, t in timed if at is not None and math.isfinite(at)]
    if not known or observed.clock is None:
        return None
    zero = 0.0 if virtual else known[0][0]
    ticks = [(at - zero, t) for at, t in known[:MOST_TICKS]]
    due = _due(observed, [at for at, _ in ticks])
    start, end = (pick([0.0, *due, *(at for at, _ in ticks)]) for pick in (min, max))
    span = max(end - start, 1e-3)

    def x(at: float) -> float:
        return round(LANES + (at - start) / span * (WIDTH - LANES - EDGE), 1)

    dots = tuple(Dot(tick, at, x(at), _off(at, due)) for at, tick in ticks)
    return Timeline(
        clock=observed.clock,
        dots=dots,
        due=tuple((x(at), at) for at in due),
        axis=tuple((x(at), at) for at in axis_marks(start, end)),
        missed=_missed(due, dots) if virtual else (),
        left_out=len(known) - len(ticks),
    )


@dataclass(frozen=True)
class PathPlot:
    """Where a turtle drove, seen from above: pieces of lines as `x,y x,y …`, for polylines."""

    run: str
    turtle: str
    driven: tuple[str, ...]
    wanted: tuple[str, ...]
    start: tuple[float, float]
    end: tuple[float, float]
    size: float = WIDTH / 2


def path_plots(runs: Sequence[RunInfo]) -> tuple[PathPlot, ...]:
    """Return a plot for each turtle of each run that has a world."""

    def place(x: float, y: float) -> tuple[float, float]:
        scale = PathPlot.size / SIZE
        return round(x * scale, 1), round(PathPlot.size - y * scale, 1)

    def lines(points: Sequence[tuple[float, float]]) -> tuple[str, ...]:
        pieces = [points[at : at + PIECE + 1] for at in range(0, max(1, len(points) - 1), PIECE)]
        return tuple(" ".join("{},{}".format(*place(x, y)) for x, y in piece) for piece in pieces)

    return tuple(
        PathPlot(
            run=run.name,
            turtle=turtle,
            driven=lines(points),
            wanted=lines(run.wanted.get(turtle, [])) if run.wanted.get(turtle) else (),
            start=place(*points[0]),
            end=place(*points[-1]),
        )
        for run in runs
        for turtle, points in run.path.items()
        if points
    )


def _due(observed: Observed, came: Sequence[float]) -> list[float]:
    """Return the due instants: those that were awaited, then one per period up to the last tick.

    None is added before the first: a node may start its timer at any time.
    """
    period = observed.period or 0.0
    virtual = observed.clock == "virtual"
    due = sorted(observed.due[:MOST_DUE]) if virtual else []
    if period <= 0:
        return due
    first = due[-1] if due else (period if virtual else 0.0)
    begun = len(due)
    last = max(came)
    for number in range(1 if due else 0, MOST_DUE - begun):
        at = first + number * period
        if at > last + period / 2:
            break
        due.append(at)
    return due


def _off(at: float, due: Sequence[float]) -> float | None:
    if not due:
        return None
    place = bisect.bisect(due, at)
    return min((at - other for other in due[max(place - 1, 0) : place + 1]), key=abs)


def _missed(due: Sequence[float], dots: Sequence[Dot]) -> tuple[float, ...]:
    """Return the due instants at which no line came."""
    came = sorted(dot.at for dot in dots)
    return tuple(at for at in due if (off := _off(at, came)) is None or abs(off) > ON_TIME)


def axis_marks(start: float, end: float) -> list[float]:
    """Return round numbers for the axis, at most twelve."""
    span = max(end - start, 1e-3)
    size = 10.0 ** math.floor(math.log10(span / 10))
    step = next(s * size for s in (*STEPS, 10, 20) if span / (s * size) <= 11)
    first = math.ceil(start / step - 1e-9)
    count = math.floor((end - first * step) / step + 1e-9) + 1
    return [round((first + k) * step, 9) for k in range(count)]
