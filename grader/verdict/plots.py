"""The values of topics over ROS time, with what the checks want of them, for the report's plots."""

from __future__ import annotations

import math
from collections.abc import Iterator

from grader.course.assignment import Assignment, CheckUse
from grader.course.scenario import RunPlan
from grader.course.values import Form, value_at
from grader.report.model import Band, TopicPlot
from grader.run.observations import Observations
from grader.run.run import Run
from grader.verdict.checks.topic import Period, Reacts

JUDGED = ("topic.publishes", "topic.period", "topic.values", "topic.reacts")
MOST_PLOTS, MOST_POINTS, MOST_DUE, MOST_BANDS = 8, 200, 300, 12


def topic_plots(run: Run, assignment: Assignment) -> list[TopicPlot]:
    """Return a plot for each field that the visible checks of a run judge, by topic.

    A topic without such a field has one plot with the instants of its messages.
    """
    plan, seen = assignment.plan(run.name), run.seen
    if seen is None:
        return []
    by_topic: dict[str, list[CheckUse]] = {}
    for use in assignment.checks:
        here = use.kind in JUDGED and assignment.plan(use.run).name == run.name
        if here and use.visibility == "visible":
            by_topic.setdefault(str(use.with_["topic"]), []).append(use)
    plots = [
        _plot(topic, field, uses, plan, seen)
        for topic, uses in by_topic.items()
        for field in list(dict.fromkeys(path for use in uses for path, _ in _forms(use))) or [""]
    ]
    return plots[:MOST_PLOTS]


def _plot(
    topic: str, field: str, uses: list[CheckUse], plan: RunPlan, seen: Observations
) -> TopicPlot:
    points = []
    for message in seen.of_topic(topic):
        value = value_at(message.values, field) if field else 0.0
        if _is_finite(value):
            points.append((round(message.at, 6), float(value)))
    step = max(1, -(-len(points) // MOST_POINTS))
    bands = [band for use in uses for band in _bands(use, field, plan, seen)]
    concerned = [
        use.id for use in uses if not _forms(use) or any(f == field for f, _ in _forms(use))
    ]
    return TopicPlot(
        topic=topic,
        field=field,
        checks=concerned,
        points=points[::step],
        due=_due(uses, plan, seen)[:MOST_DUE],
        bands=bands[:MOST_BANDS],
        end=seen.instants[-1] if seen.instants else 0.0,
    )


def _forms(use: CheckUse) -> list[tuple[str, Form]]:
    """Return the fields of which a check wants a number or a range of numbers."""
    found = [(path, Form.model_validate(form)) for path, form in use.with_.get("each", {}).items()]
    return [(path, form) for path, form in found if _range(form) is not None]


def _range(form: Form) -> tuple[float, float] | None:
    if form.about is not None and form.within is not None:
        return form.about - form.within, form.about + form.within
    if form.between is not None:
        return form.between
    return (form.equal, form.equal) if _is_finite(form.equal) else None


def _bands(use: CheckUse, field: str, plan: RunPlan, seen: Observations) -> Iterator[Band]:
    window = _window(use, plan, seen)
    for path, form in _forms(use):
        limits = _range(form)
        if path == field and limits is not None and window is not None:
            yield Band(
                check=use.id,
                first=window[0],
                last=window[1],
                low=limits[0],
                high=limits[1],
                every=use.kind == "topic.values",
            )


def _window(use: CheckUse, plan: RunPlan, seen: Observations) -> tuple[float, float] | None:
    """Return the instants that a check judges; None if the run did not reach its stimulus."""
    done = seen.stimulus(use.after) if use.after else None
    if use.after and done is None:
        return None
    begin = done.at if done is not None else 0.0
    if use.kind == "topic.reacts":
        return begin, begin + Reacts.model_validate(use.with_).within
    if use.during is not None:
        return begin + use.during[0], begin + use.during[1]
    return begin, max(begin, plan.clock.period * plan.clock.ticks)


def _due(uses: list[CheckUse], plan: RunPlan, seen: Observations) -> list[float]:
    """Return the instants at which the first check of a period wants a message."""
    for use in uses:
        window = _window(use, plan, seen) if use.kind == "topic.period" else None
        if window is not None:
            period = Period.model_validate(use.with_).period
            first, last = (round(at / period, 6) for at in window)
            count = range(max(1, math.ceil(first)), math.floor(last) + 1)
            return [round(number * period, 6) for number in count[:MOST_DUE]]
    return []


def _is_finite(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
