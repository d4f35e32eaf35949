"""Does the node spin, and which node is judged? The checks on constructed runs."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Literal

import pytest

from grader.course.assignment import Assignment
from grader.run.observer import Event, Watch
from grader.run.probe_link import LogRecord, NodeSeen
from grader.run.run import Run, counting_node
from grader.verdict.checks.declare import Check
from grader.verdict.checks.graph import node_name
from grader.verdict.checks.spinning import spins
from grader.verdict.checks.timing import period
from grader.verdict.evidence import Evidence
from grader.verdict.outcome import Blocked, Failed, Inconclusive, Outcome, Passed
from tests.corpus.build import SOLUTION
from tests.static_bench import BUILT, NODE, Bench

RIGHT = (SOLUTION / NODE).read_text(encoding="utf-8")
STEADY = RIGHT.replace("self.timer_callback)", "self.timer_callback, clock=Clock())")
OWN = "/my_first_node"


def seen(
    name: str = OWN, *, answers: bool = True, services: bool = True, clock: bool = True
) -> NodeSeen:
    return NodeSeen(
        name, clock=clock, rosout=True, parameters=services, services=services, answers=answers
    )


def line(n: int, logger: str = "my_first_node") -> Event:
    record = LogRecord(20, logger, f"Hello time: {n}", "", "", 10, n)
    return Event(record.text, 1.0 + n, 1.0 + n, "logger", n, n, record=record)


def run_of(
    *nodes: NodeSeen,
    clock: Literal["virtual", "wall"] = "wall",
    still: bool | None = None,
    logger: str = "my_first_node",
) -> Run:
    events = [line(n, logger) for n in range(5)]
    if clock == "wall":
        events = [replace(event, due=None) for event in events]
    watch = Watch(clock=clock, events=events, period=1.0, while_still=still)
    return Run("ros2 run", watch, nodes, counting_node(nodes, events), started=True)


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path / "my_robot_controller")


def outcome_of(
    check: Check, bench: Bench, run: Run, source: str = RIGHT, **assignment: str
) -> Passed | Outcome:
    bench.write(NODE, source)
    asked: Assignment = bench.assignment.model_copy(update=assignment)
    submission = bench.evidence().submission
    evidence = Evidence(asked, submission, build=lambda: BUILT, run=lambda: run)
    return check.evaluate(evidence, next(use for use in asked.checks if use.kind == check.id))


def mistake_of(outcome: Passed | Outcome) -> str:
    assert isinstance(outcome, Failed), outcome
    return outcome.mistake.id


def test_a_node_that_answers_spins(bench: Bench) -> None:
    assert isinstance(outcome_of(spins, bench, run_of(seen())), Passed)


def test_a_node_that_does_not_answer_never_spins(bench: Bench) -> None:
    run = run_of(seen(answers=False), still=True)
    assert mistake_of(outcome_of(spins, bench, run)) == "run.never_spins"


def test_a_node_without_services_spins_if_its_lines_follow_clock(bench: Bench) -> None:
    run = run_of(seen(answers=False, services=False), clock="virtual")
    assert isinstance(outcome_of(spins, bench, run), Passed)


def test_a_node_that_answers_for_another_does_not_count(bench: Bench) -> None:
    run = run_of(seen("/other"), seen(answers=False))
    assert mistake_of(outcome_of(spins, bench, run)) == "run.never_spins"


def test_a_node_of_which_nothing_can_be_asked_loses_no_points(bench: Bench) -> None:
    run = run_of(seen(answers=False, services=False, clock=False))
    assert isinstance(outcome_of(spins, bench, run), Inconclusive)


def test_a_loop_beside_spin_does_not_count_as_spinning(bench: Bench) -> None:
    run = run_of(seen(), still=True)
    assert mistake_of(outcome_of(spins, bench, run)) == "run.never_spins"


def test_a_node_that_ended_before_it_answered_is_left_to_the_output_check(bench: Bench) -> None:
    run = replace(run_of(seen(answers=False)), ended_by_itself=True)
    outcome = outcome_of(spins, bench, run)
    assert isinstance(outcome, Blocked)
    assert outcome.by == "run.output"


def test_a_timer_on_another_clock_spins_but_does_not_use_ros_time(bench: Bench) -> None:
    run = run_of(seen(), still=True)
    assert isinstance(outcome_of(spins, bench, run, STEADY), Passed)
    failed = outcome_of(period, bench, run, STEADY)
    assert mistake_of(failed) == "run.other_clock"
    assert isinstance(failed, Failed)
    assert failed.where is not None
    assert "create_timer" in STEADY.splitlines()[(failed.where.line or 0) - 1]


def test_an_assignment_may_allow_a_timer_on_any_clock(bench: Bench) -> None:
    run = run_of(seen(), still=True)
    assert isinstance(outcome_of(period, bench, run, STEADY, timer="any"), Passed)


@pytest.mark.parametrize(
    "clock", ["self.get_clock()", "clock=self.get_clock()", "clock=None", "None, None"]
)
def test_the_nodes_own_clock_is_no_other_clock(clock: str, bench: Bench) -> None:
    source = RIGHT.replace("self.timer_callback)", f"self.timer_callback, {clock})")
    if clock == "self.get_clock()":  # (the third argument is the callback group)
        source = source.replace("callback, self", "callback, None, self")
    run = run_of(seen(), still=True)
    assert mistake_of(outcome_of(spins, bench, run, source)) == "run.never_spins"


def test_the_node_that_counts_is_judged_and_no_other(bench: Bench) -> None:
    nodes = (seen(), seen("/my_node"))
    run = run_of(*nodes, clock="virtual", logger="my_node")
    failed = outcome_of(node_name, bench, run)
    assert mistake_of(failed) == "run.wrong_node_name"
    assert "/my_node" in str(failed)
    assert isinstance(outcome_of(node_name, bench, run_of(*nodes, clock="virtual")), Passed)


@pytest.mark.parametrize(("passed", "variant"), [("my_first_node", "other"), ("my_node", "")])
def test_a_node_that_has_the_right_name_is_not_told_to_look_for_another(
    passed: str, variant: str, bench: Bench
) -> None:
    run = run_of(seen(), seen("/my_node"), clock="virtual", logger="my_node")
    failed = outcome_of(node_name, bench, run, RIGHT.replace("my_first_node", passed))
    assert isinstance(failed, Failed)
    assert failed.variant == variant


def test_a_node_in_a_namespace_is_found_by_its_logger() -> None:
    nodes = (seen("/other"), seen("/robot/my_first_node"))
    assert counting_node(nodes, [line(0, "robot.my_first_node")]) == "/robot/my_first_node"


def test_lines_of_no_nodes_logger_belong_to_no_node() -> None:
    assert counting_node((seen(),), [line(0, "my_logger")]) == ""
