"""The kinds of check for counted lines and names, on constructed runs of a scenario."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest

from grader.course.assignment import CheckUse
from grader.course.load import load_assignment
from grader.package.submission import take_in
from grader.run.observations import Observations
from grader.run.observer import Event, Watch
from grader.run.probe_link import LogRecord, NodeSeen
from grader.run.run import Run
from grader.verdict.checks.all import CHECKS
from grader.verdict.checks.instants import stops_before, usual_gap, wrong_gaps
from grader.verdict.evidence import Evidence
from grader.verdict.outcome import Failed, Outcome, Passed
from tests.scenario_kinds import FORMS, write_course, write_package
from tests.static_bench import BUILT

TEXT = "beat {n}"
NODE = NodeSeen("/doubler", clock=True, rosout=True, parameters=True, answers=True)


def beats(instants: Sequence[float], *, level: int = 20) -> list[Event]:
    """Return records of the node's logger that count."""
    records = [LogRecord(level, "doubler", f"beat {n}", "", "", 0, n) for n in range(len(instants))]
    return [
        Event(one.text, at, at, "logger", None, record=one) for one, at in zip(records, instants)
    ]


def outcome(folder: Path, kind: str, events: list[Event], **given: object) -> Passed | Outcome:
    """Return what a kind of check finds in a run of five seconds."""
    assignment = load_assignment(write_course(folder), known_checks=CHECKS)
    seen = Observations(0.1, instants=[round(0.1 * k, 6) for k in range(1, 51)])
    watch = Watch(clock="virtual", events=events, settled=True)
    run = Run("ros2 run", watch, (NODE,), started=True, name="answers", seen=seen)
    package = write_package(FORMS[0], folder)
    evidence = Evidence(
        assignment,
        take_in(package, package="doubling", node_file="doubler.py"),
        build=lambda: BUILT,
        run=lambda: run,
        run_of=lambda _: run,
    )
    use = CheckUse.model_validate({"id": "a", "points": 1, "check": kind, "with": given})
    return CHECKS[kind].evaluate(evidence, use)


EVERY = [round(0.2 * k, 6) for k in range(1, 26)]


@pytest.mark.parametrize(
    ("kind", "instants", "given", "mistake", "words"),
    [
        ("log.period", EVERY, {"period": 0.2}, "", "25"),
        ("log.period", EVERY[:9], {"period": 0.2}, "log.wrong_period", "came at 1.8 s"),
        ("log.period", EVERY[::2], {"period": 0.2}, "log.wrong_period", "0.4 s between"),
        ("log.period", [1.0], {"period": 0.2}, "log.missing", "1 such line"),
        ("log.logger", EVERY, {}, "", "25 records of [doubler], INFO"),
        ("log.logger", EVERY, {"level": "warn"}, "log.wrong_level", "INFO"),
        ("log.logger", [], {}, "log.missing", "0 such lines"),
        ("log.counts", EVERY, {"at_least": 25}, "", "25"),
        ("log.counts", EVERY, {"at_least": 26}, "log.missing", "25"),
        ("log.counts", EVERY, {"start": 1}, "log.wrong_count", "beat 0"),
    ],
)
def test_counted_lines_are_judged_by_their_text_period_and_logger(
    kind: str,
    instants: list[float],
    given: dict[str, object],
    mistake: str,
    words: str,
    tmp_path: Path,
) -> None:
    found = outcome(tmp_path, kind, beats(instants), text=TEXT, **given)
    if not mistake:
        assert isinstance(found, Passed), found
        assert words in found.actual
        return
    assert isinstance(found, Failed), found
    assert found.mistake.id == mistake
    assert words in found.actual


@pytest.mark.parametrize(
    ("name", "mistake"),
    [("doubler", ""), ("/doubler", ""), ("other", "graph.node_missing")],
)
def test_a_name_is_that_of_the_main_node_or_of_another(
    name: str, mistake: str, tmp_path: Path
) -> None:
    found = outcome(tmp_path, "graph.node_name", [], name=name)
    assert (found.mistake.id if isinstance(found, Failed) else "") == mistake


def test_a_period_that_the_clock_does_not_divide_has_slack() -> None:
    instants = [0.3, 0.5, 0.8, 1.0]
    assert wrong_gaps(instants, 0.25, 0.1) == []
    assert wrong_gaps(instants, 0.2, 0.1) == pytest.approx([0.3])
    assert not stops_before(1.3, instants, 0.25, 0.1)
    assert stops_before(1.4, instants, 0.25, 0.1)
    assert usual_gap([0.2, 0.4, 0.6, 0.9], 0.1) == pytest.approx(0.2)
