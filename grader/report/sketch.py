"""Sketches of plots in characters, for the terminal: a topic's values, a turtle's path.

They are ASCII, so that they are the same in a pipe, a log file and an old terminal.
"""

from __future__ import annotations

from collections.abc import Sequence

from grader.report.model import TopicPlot

WIDEST, LEAST = 60, 16  # columns
ROWS = 9  # of a plot of values
RIGHT, WRONG, WANTED, DUE = "*", "x", "-", "|"
LABEL = 10  # columns, of a value at the left
SIDES = 2.1  # height of a character for its width


def value_sketch(plot: TopicPlot, columns: int, *, rows: int = ROWS) -> list[str]:
    """Return the lines of a plot that is at most so many columns wide, and so many rows high."""
    width = max(LEAST, min(WIDEST, columns) - LABEL - 2)
    first, last = plot.times
    low, high = plot.values
    rows = rows if plot.field else 1
    grid = [[" "] * width for _ in range(rows)]

    def column(at: float) -> int:
        return min(width - 1, max(0, round((at - first) / (last - first) * (width - 1))))

    def row(value: float) -> int:
        if not plot.field:
            return 0
        return rows - 1 - round((value - low) / (high - low) * (rows - 1))

    for band in plot.bands:
        for place in range(column(band.first), column(band.last) + 1):
            for height in {row(band.low), row(band.high)}:
                grid[height][place] = WANTED
    for right in (True, False):
        for at, value in plot.points:
            if plot.is_right(at, value) is right:
                grid[row(value)][column(at)] = RIGHT if right else WRONG
    names = {0: f"{high:.6g}", rows - 1: f"{low:.6g}"} if plot.field else {}
    lines = [f"{names.get(n, ''):>{LABEL}} |{''.join(cells)}" for n, cells in enumerate(grid)]
    ticks = ["-"] * width
    for at in plot.due:
        ticks[column(at)] = DUE
    end = f"{last:g} s"
    lines.append(f"{'':>{LABEL}} +{''.join(ticks)}")
    lines.append(f"{'':>{LABEL}}  {first:<{width - len(end)}g}{end}")
    return [line.rstrip() for line in lines]


def path_sketch(
    driven: Sequence[tuple[float, float]], wanted: Sequence[tuple[float, float]], columns: int
) -> list[str]:
    """Return the lines of a path seen from above, over the wanted one; S is the start, E the end."""
    points = [*driven, *wanted]
    if not points:
        return []
    left, right = (pick(x for x, _ in points) for pick in (min, max))
    down, up = (pick(y for _, y in points) for pick in (min, max))
    side = max(right - left, up - down, 1e-3)
    width = max(LEAST, min(WIDEST // 2, columns))
    rows = max(2, round(width / SIDES))
    grid = [[" "] * width for _ in range(rows)]

    def put(point: tuple[float, float], mark: str) -> None:
        column = round((point[0] - left) / side * (width - 1))
        row = rows - 1 - round((point[1] - down) / side * (rows - 1))
        grid[min(max(row, 0), rows - 1)][min(max(column, 0), width - 1)] = mark

    for marks, path in ((".", wanted), (RIGHT, driven)):
        for point in path:
            put(point, marks)
    if driven:
        put(driven[0], "S")
        put(driven[-1], "E")
    return ["".join(cells).rstrip() for cells in grid]
