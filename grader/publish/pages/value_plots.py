"""The geometry of the plots of a topic's values over ROS time; the template draws them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from grader.publish.pages.charts import EDGE, WIDTH, axis_marks
from grader.report.model import RunInfo, TopicPlot

LEFT = 56.0  # width of the values' names at the left
TOP, BOTTOM = 14.0, 104.0  # of the values
LEAST_BAND = 3.0  # height of a band for one value
LANE = 0.5  # the height (of 1) of the dots of a topic without values


@dataclass(frozen=True)
class Dot:
    """A message, and whether its value is as wanted."""

    x: float
    y: float
    right: bool


@dataclass(frozen=True)
class Box:
    """A band of wanted values."""

    x: float
    y: float
    width: float
    height: float


@dataclass(frozen=True)
class ValuePlot:
    """A plot: `due` are places on the axis of time; axes are (place, value) pairs."""

    run: str
    topic: str
    field: str
    dots: tuple[Dot, ...]
    boxes: tuple[Box, ...]
    due: tuple[float, ...]
    times: tuple[tuple[float, float], ...]
    values: tuple[tuple[float, float], ...]
    width: float = WIDTH
    height: float = 134.0
    left: float = LEFT
    bottom: float = BOTTOM

    @property
    def wrong(self) -> int:
        """How many messages have a value that is not as wanted."""
        return sum(not dot.right for dot in self.dots)


def value_plots(runs: Sequence[RunInfo]) -> tuple[ValuePlot, ...]:
    """Return the plots of all runs that have something to show."""
    return tuple(
        _plot(run.name, plot) for run in runs for plot in run.plots if plot.points or plot.bands
    )


def _plot(run: str, plot: TopicPlot) -> ValuePlot:
    first, last = plot.times
    low, high = plot.values

    def x(at: float) -> float:
        return round(LEFT + (at - first) / (last - first) * (WIDTH - LEFT - EDGE), 1)

    def y(value: float) -> float:
        share = (value - low) / (high - low) if plot.field else LANE
        return round(BOTTOM - share * (BOTTOM - TOP), 1)

    boxes = []
    for band in plot.bands:
        height = max(LEAST_BAND, y(band.low) - y(band.high))
        middle = (y(band.low) + y(band.high)) / 2
        width = max(1.0, x(band.last) - x(band.first))
        boxes.append(Box(x(band.first), round(middle - height / 2, 1), round(width, 1), height))
    return ValuePlot(
        run=run,
        topic=plot.topic,
        field=plot.field,
        dots=tuple(Dot(x(at), y(value), plot.is_right(at, value)) for at, value in plot.points),
        boxes=tuple(boxes),
        due=tuple(x(at) for at in plot.due),
        times=tuple((x(at), at) for at in axis_marks(first, last)),
        values=tuple((y(value), value) for value in (low, high)) if plot.field else (),
    )
