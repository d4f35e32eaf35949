"""The pictures of a report on a terminal: each is of its own run, and shown once."""

from __future__ import annotations

import pytest

from grader.report.model import Mistake, RunInfo, TopicPlot
from grader.report.terminal import render_report
from tests.report import samples

PATH = {"turtle1": [(1.0, 1.0), (2.0, 2.0), (3.0, 1.0)]}
PLOT = TopicPlot(
    topic="/turtle1/cmd_vel",
    field="linear.x",
    checks=["drive.speed", "drive.again"],
    points=[(0.5, 1.0), (1.0, 3.0)],
    end=1.0,
)


def test_a_picture_has_the_name_of_its_run_and_is_shown_once() -> None:
    wall = [Mistake(id="world.hits_wall")]
    checks = (
        samples.check("drive.speed", "failed", run="circles"),
        samples.check("drive.again", "failed", run="circles"),
        samples.check("drive.stays", "failed", run="drives", mistakes=wall),
        samples.check("drive.slow", "failed", run="drives", mistakes=wall),
    )
    runs = [
        RunInfo(name="circles", path=PATH, plots=[PLOT]),
        RunInfo(name="drives", path=PATH),
    ]
    report = samples.report().model_copy(update={"checks": list(checks), "runs": runs})
    page = render_report(report, quotes={})
    assert page.count("/turtle1/cmd_vel linear.x, in the run circles") == 1
    assert page.count("turtle1, in the run drives") == 1
    assert "turtle1, in the run circles" not in page


@pytest.mark.parametrize("field", ["", "linear.x"])
def test_the_key_of_a_picture_names_only_what_is_in_it(field: str) -> None:
    """A picture without a period has no due instants."""
    key = "below, | is a due instant"
    for due in ([], [0.5, 1.0]):
        plot = PLOT.model_copy(update={"field": field, "due": due})
        checks = [samples.check("drive.speed", "failed", run="circles")]
        runs = [RunInfo(name="circles", plots=[plot])]
        report = samples.report().model_copy(update={"checks": checks, "runs": runs})
        assert (key in render_report(report, quotes={})) is bool(due)
