"""Plots of what the checks of topics judge: from a real run to the page and the terminal."""

from __future__ import annotations

import math
import re
import shutil
from pathlib import Path

import pytest
from hypothesis import given, strategies

from grader.publish.feedback import html_page
from grader.publish.pages import write_site
from grader.publish.pages.value_plots import value_plots
from grader.report.model import Band, Report, RunInfo, TopicPlot
from grader.report.sketch import path_sketch, value_sketch
from grader.verdict.evidence_file import Judged
from tests.pages import classes
from tests.pages.axe import axe_source, violations
from tests.pages.browser import Open
from tests.processes import ROOT
from tests.report.samples import render_report
from tests.test_scenarios import marked

LESSON = ROOT / "lab" / "course" / "draw_circle" / "assignment.yaml"
SOLUTION = ROOT / "grader" / "keys" / "draw_circle" / "solution"
DRAWN = {"radius": 1.0, "change": 6.0}  # m, and s of ROS time
FASTER = "SPEED / radius + (0.3 if self.get_clock().now().nanoseconds > 3e9 else 0.0)"
real = [pytest.mark.prefix, pytest.mark.full]


@pytest.fixture(scope="module")
def faster(tmp_path_factory: pytest.TempPathFactory) -> Report:
    """The verdict on a node that turns 0.3 rad/s faster than is wanted, after 3 s of ROS time."""
    package = tmp_path_factory.mktemp("faster") / "ana"
    shutil.copytree(SOLUTION, package)
    (node,) = package.rglob("draw_circle.py")
    text = node.read_text()
    assert text.count("SPEED / radius") == 1
    node.write_text(text.replace("SPEED / radius", FASTER))
    kept: list[Judged] = []
    return marked(package, LESSON, kept, drawn=DRAWN)


def plot_of(report: Report, field: str) -> TopicPlot:
    (found,) = [plot for run in report.runs for plot in run.plots if plot.field == field]
    return found


def page_of(report: Report, folder: Path) -> Path:
    write_site(classes.result([classes.entry(0, report)]), folder)
    (page,) = (folder / "students").glob("*.html")
    return page


class TestOfARun:
    pytestmark = real

    def test_the_values_are_those_that_the_node_sent(self, faster: Report) -> None:
        turns = plot_of(faster, "angular.z")
        assert [at for at, _ in turns.points] == [n / 2 for n in range(1, 21)]
        for at, value in turns.points:
            # at 6 s the radius is set to 1 m; the timer of that instant may be first
            wanted = {1.0} if at <= 3 else {1.3} if at < 6 else {2.3} if at > 6 else {1.3, 2.3}
            assert min(abs(value - one) for one in wanted) < 1e-6, at
        assert all(value == 2.0 for _, value in plot_of(faster, "linear.x").points)

    def test_what_the_lesson_wants_is_beside_them(self, faster: Report) -> None:
        turns = plot_of(faster, "angular.z")
        bands = {band.check: band for band in turns.bands}
        assert set(bands) == {"drive.speed", "drive.tighter"}
        speed, tighter = bands["drive.speed"], bands["drive.tighter"]
        assert (speed.first, speed.last) == (0.5, 6.0)
        assert (speed.low, speed.high) == pytest.approx((0.99, 1.01))
        assert (tighter.first, tighter.last) == (6.5, 9.0)
        assert (tighter.low, tighter.high) == pytest.approx((1.99, 2.01))
        assert turns.due == [n / 2 for n in range(1, 21)]
        wrong = {at for at, value in turns.points if not turns.is_right(at, value)}
        assert wrong == {n / 2 for n in range(7, 19)}  # 3.5 … 6, and 6.5 … 9
        assert plot_of(faster, "linear.x").wrong == 0

    def test_the_page_has_them_as_a_picture_with_words_for_it(
        self, faster: Report, tmp_path: Path
    ) -> None:
        feedback = html_page(classes.entry(0, faster), "Lesson 2", show_hidden=False).decode()
        for text in (page_of(faster, tmp_path).read_text(), feedback):
            (turns,) = re.findall(r"<svg(?:(?!</svg>).)*angular\.z.*?</svg>", text, re.DOTALL)
            assert len(re.findall(r'class="stray"', turns)) == 12
            assert len(re.findall(r'class="came"', turns)) == 8
            assert "Messages: 20; not as wanted: 12; due instants: 20." in turns
            assert len(re.findall(r'class="band"', turns)) == 2

    @pytest.mark.parametrize("width", [40, 60, 80, 120])
    @pytest.mark.parametrize("styled", [False, True])
    def test_the_terminal_has_a_sketch_of_the_failed_check(
        self, faster: Report, width: int, styled: bool
    ) -> None:
        page = render_report(faster, width=width, styled=styled)
        page = re.sub(r"\x1b\[[\d;]*m", "", page)
        sketch = page.partition("/turtle1/cmd_vel angular.z")[2].partition("FAIL")[0]
        assert sketch
        lines = sketch.splitlines()[: sketch[: sketch.index("10 s")].count("\n") + 1]
        assert all(len(line) <= width for line in lines)
        assert "x" in sketch.partition("+")[0]
        assert "/turtle1/cmd_vel linear.x" not in page  # nothing is wrong with it
        path = page.partition("FAIL drive.path")[2]
        assert re.search(r"S[*]|[*]S", path)

    def test_a_check_that_students_do_not_see_has_no_plot(self, faster: Report) -> None:
        named = {name for run in faster.runs for plot in run.plots for name in plot.checks}
        hidden = {check.id for check in faster.checks if check.visibility != "visible"}
        assert not named & hidden
        assert {"drive.publishes", "drive.period", "drive.speed", "drive.tighter"} <= named

    @pytest.mark.parametrize("scheme", ["light", "dark"])
    def test_axe_finds_no_violation(
        self, scheme: str, faster: Report, visit: Open, tmp_path: Path
    ) -> None:
        page = visit(color_scheme=scheme).open(page_of(faster, tmp_path))
        assert violations(page, axe_source()) == []


NUMBERS = strategies.floats(-1e9, 1e9)
POINTS = strategies.lists(strategies.tuples(strategies.floats(0, 1e6), NUMBERS), max_size=40)
BANDS = strategies.lists(
    strategies.builds(
        lambda first, long, low, high: Band(
            check="a", first=first, last=first + long, low=low, high=low + high
        ),
        *(strategies.floats(0, 1e6), strategies.floats(0, 1e6)),
        *(NUMBERS, strategies.floats(0, 1e9)),
    ),
    max_size=4,
)
PLOTS = strategies.builds(
    TopicPlot,
    topic=strategies.just("/t"),
    field=strategies.sampled_from(["", "x"]),
    points=POINTS,
    bands=BANDS,
    due=strategies.lists(strategies.floats(0, 1e6), max_size=9),
    end=strategies.floats(0, 1e6),
)


@given(PLOTS, strategies.integers(28, 120))
def test_a_sketch_of_any_values_stays_in_its_columns(plot: TopicPlot, columns: int) -> None:
    assert all(len(line) <= columns for line in value_sketch(plot, columns)[:-1])


@given(POINTS, POINTS, strategies.integers(16, 120))
def test_a_sketch_of_any_path_stays_in_its_columns(
    driven: list[tuple[float, float]], wanted: list[tuple[float, float]], columns: int
) -> None:
    lines = path_sketch(driven, wanted, columns)
    assert all(len(line) <= columns for line in lines)
    assert bool(lines) == bool(driven or wanted)


@given(PLOTS)
def test_a_picture_of_any_values_stays_in_its_frame(plot: TopicPlot) -> None:
    for drawn in value_plots([RunInfo(name="r", plots=[plot])]):
        places = [(dot.x, dot.y) for dot in drawn.dots]
        places += [(box.x + box.width, box.y + box.height) for box in drawn.boxes]
        assert all(math.isfinite(x) and 0 <= x <= drawn.width for x, _ in places)
        assert all(math.isfinite(y) and 0 <= y <= drawn.height for _, y in places)


def test_nothing_is_drawn_of_a_topic_without_messages_and_wanted_values() -> None:
    assert value_plots([RunInfo(name="r", plots=[TopicPlot(topic="/t")])]) == ()


def test_one_right_message_is_enough_for_a_reaction() -> None:
    band = Band(check="a", first=0, last=2, low=1, high=1, every=False)
    plot = TopicPlot(topic="/t", field="x", points=[(1, 1), (2, 5)], bands=[band])
    assert plot.wrong == 0
