"""The geometry of the plots."""

from __future__ import annotations

import pytest
from hypothesis import given, strategies

from grader.publish.pages.charts import LANES, WIDTH, histogram, path_plots, timeline
from grader.publish.pages.overview import Bin
from grader.report.model import Observed, RunInfo, Tick
from grader.run.in_probe.turtlesim import SIZE


def virtual(*instants: float, due: tuple[float, ...] = (), period: float | None = 1.0) -> Observed:
    ticks = [Tick(n=n, text=f"Hello time: {n}", virtual=at) for n, at in enumerate(instants)]
    return Observed(clock="virtual", ticks=ticks, period=period, due=list(due))


def wall(*instants: float, period: float | None = 1.0) -> Observed:
    ticks = [Tick(n=n, text="x", wall=1.8e9 + at) for n, at in enumerate(instants)]
    return Observed(clock="wall", ticks=ticks, period=period)


def test_only_a_tick_at_its_exact_instant_is_on_time() -> None:
    line = timeline(virtual(0.999, 2.0, 3.001, due=(1.0, 2.0, 3.0)))
    assert line is not None
    assert [dot.on_time for dot in line.dots] == [False, True, False]
    assert line.missed == (1.0, 3.0)


def test_a_tick_is_drawn_below_its_due_instant() -> None:
    line = timeline(virtual(1.0, 2.0, due=(1.0, 2.0)))
    assert line is not None
    assert [dot.x for dot in line.dots] == [x for x, _ in line.due]


def test_due_instants_continue_by_the_period_to_the_last_line() -> None:
    line = timeline(virtual(0.5, 1.0, 1.5, 2.0, 2.5, 3.0, due=(1.0,)))
    assert line is not None
    assert [at for _, at in line.due] == [1.0, 2.0, 3.0]
    assert [dot.on_time for dot in line.dots] == [False, True] * 3


def test_a_node_that_starts_late_is_measured_at_its_own_instants() -> None:
    line = timeline(virtual(1.25, 2.25, due=(1.25, 2.25)))
    assert line is not None
    assert all(dot.on_time for dot in line.dots)
    assert not line.missed


def test_without_due_instants_in_the_report_the_period_alone_gives_them() -> None:
    line = timeline(virtual(1.0, 2.0))
    assert line is not None
    assert [at for _, at in line.due] == [1.0, 2.0]


def test_an_old_report_has_lines_but_no_due_instants() -> None:
    line = timeline(virtual(1.0, 2.0, period=None))
    assert line is not None
    assert not line.due
    assert [dot.off for dot in line.dots] == [None, None]


def test_wall_clock_seconds_are_counted_from_the_first_line() -> None:
    line = timeline(wall(0, 1.01, 2.03))
    assert line is not None
    assert [dot.at for dot in line.dots] == pytest.approx([0, 1.01, 2.03], abs=1e-5)
    assert [at for _, at in line.due] == [0, 1, 2]
    assert line.dots[2].off == pytest.approx(0.03, abs=1e-5)


def test_a_run_without_lines_has_no_timeline() -> None:
    assert timeline(Observed()) is None
    assert timeline(virtual()) is None
    assert timeline(Observed(clock="wall", ticks=[Tick(n=0, text="x")])) is None


def test_lines_at_one_instant_share_one_label() -> None:
    line = timeline(virtual(1.0, 1.0, 2.0))
    assert line is not None
    assert [text for _, text in line.labels] == ["0, 1", "2"]


@given(
    strategies.lists(strategies.floats(-1e12, 1e12, allow_nan=False), min_size=1, max_size=250),
    strategies.floats(0, 1e6),
    strategies.booleans(),
)
def test_the_plot_stays_small_and_in_its_frame_whatever_instants_a_node_claims(
    instants: list[float], period: float, on_the_wall: bool
) -> None:
    """The student controls the time stamps of log records."""
    made = wall if on_the_wall else virtual
    line = timeline(made(*instants, period=period))
    assert line is not None
    assert len(line.dots) + line.left_out == len(instants)
    assert len(line.due) <= 400
    assert len(line.axis) <= 12
    for x in [dot.x for dot in line.dots] + [x for x, _ in (*line.due, *line.axis)]:
        assert LANES - 1 <= x <= WIDTH


def test_bars_stand_side_by_side_and_their_heights_are_the_counts() -> None:
    plot = histogram([Bin(0, 50, 2), Bin(50, 100, 8)])
    low, high = plot.bars
    assert high.height == pytest.approx(4 * low.height, abs=0.2)
    assert low.y + low.height == pytest.approx(plot.bottom, abs=0.2)
    assert low.x + low.width <= high.x
    assert high.x + high.width <= plot.width


def test_a_histogram_of_nothing_is_flat() -> None:
    assert [bar.height for bar in histogram([Bin(0, 100, 0)]).bars] == [0]


def test_a_path_is_seen_from_above_with_the_wanted_one_beside_it() -> None:
    run = RunInfo(
        name="drives",
        path={"turtle1": [(0.0, 0.0), (SIZE, 0.0), (SIZE, SIZE)], "turtle2": []},
        wanted={"turtle1": [(SIZE / 2, SIZE / 2)]},
    )
    (plot,) = path_plots([run])
    size = plot.size
    assert (plot.run, plot.turtle) == ("drives", "turtle1")
    assert plot.driven == (f"0.0,{size} {size},{size} {size},0.0",)
    assert plot.wanted == (f"{size / 2},{size / 2}",)
    assert (plot.start, plot.end) == ((0.0, size), (size, 0.0))
    assert path_plots([RunInfo(name="no world")]) == ()


def test_the_pieces_of_a_long_path_meet() -> None:
    points = [(at / 100, 1.0) for at in range(400)]
    (plot,) = path_plots([RunInfo(name="drives", path={"turtle1": points})])
    ends = [(piece.split()[0], piece.split()[-1]) for piece in plot.driven]
    assert all(before[1] == after[0] for before, after in zip(ends, ends[1:]))
    assert max(len(piece) for piece in plot.driven) < 1_000
    assert sum(len(piece.split()) - 1 for piece in plot.driven) == 399
