"""Which lines of a run are the count and which are judged, however the output is split."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.course.load import load_assignment
from grader.package.submission import take_in
from grader.run.observer import Event, Source, Watch
from grader.run.run import Run
from grader.verdict.checks.logger import logger
from grader.verdict.evidence import Evidence
from grader.verdict.outcome import Failed
from tests.conftest import ROOT
from tests.static_bench import BUILT, asked

SOLUTION = ROOT / "grader" / "keys" / "hello_time" / "solution" / "my_robot_controller"
COURSE = ROOT / "lab" / "course" / "hello_time" / "assignment.yaml"


def event(text: str, *, due: int, source: Source = "print", n: int | None = None) -> Event:
    return Event(text, wall=100.0 + due, virtual=due, source=source, n=n, due=due, logger="my_node")


def run_of(*events: Event, ended: bool) -> Evidence:
    run = Run(command="", watch=Watch(clock="virtual", events=list(events)), ended_by_itself=ended)
    assignment = load_assignment(COURSE)
    submission = take_in(
        Path(SOLUTION), package=assignment.package, node_file=assignment.node_file, name=None
    )
    return Evidence(assignment, submission, build=lambda: BUILT, run=lambda: run)


def test_a_traceback_in_pieces_is_not_the_count() -> None:
    pieces = ["Traceback (most recent call last):", '  File "a.py", line 1', "ValueError: no"]
    watch = Watch(clock="virtual", events=[event(text, due=at) for at, text in enumerate(pieces)])
    assert watch.counted == []


def test_wrong_lines_before_a_traceback_count() -> None:
    wrong = [event("Hello Time: 0", due=0), event("Hello Time: 1", due=1)]
    crash = [event("Traceback (most recent call last):", due=2), event("ValueError: no", due=3)]
    assert Watch(clock="virtual", events=wrong + crash).counted == wrong


def test_numbers_filled_up_to_a_width_are_one_count() -> None:
    texts = [f"Hello time: {n:2d}" for n in range(13)]
    events = [event(t, due=n, n=n if n > 9 else None) for n, t in enumerate(texts)]
    assert Watch(clock="virtual", events=events).counted == events


def test_a_record_lost_with_its_node_is_not_a_forgery() -> None:
    last = event("Hello time: 2", due=2, source="faked", n=2)
    assert asked(logger, run_of(last, ended=True)) is not None


def test_a_forged_record_of_a_running_node_is_a_forgery() -> None:
    with pytest.raises(Failed) as failed:
        asked(logger, run_of(event("Hello time: 2", due=2, source="faked", n=2), ended=False))
    assert failed.value.mistake


def test_a_forgery_long_before_the_end_is_detected() -> None:
    lines = [event(f"Hello time: {n}", due=n, source="faked", n=n) for n in (0, 5)]
    with pytest.raises(Failed):
        asked(logger, run_of(*lines, ended=True))
