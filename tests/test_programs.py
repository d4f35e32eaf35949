"""Which nodes of a run are a program's own, and the run as that program showed it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from grader.run.observations import Observations
from grader.run.observer import Watch
from grader.run.probe_link import NodeSeen
from grader.run.programs import names_of, of_program
from grader.run.run import Program, Run
from tests import two_nodes


@pytest.mark.parametrize(
    ("there", "own"),
    [
        (["/talker", "/listener"], [("/talker",), ("/listener",)]),
        (["/talker", "/hearer"], [("/talker",), ("/hearer",)]),
        (["/listener", "/speaker"], [("/speaker",), ("/listener",)]),
        (["/listner", "/talkers"], [("/talkers",), ("/listner",)]),
        (["/talker", "/listener", "/extra"], [("/talker",), ("/listener",)]),
        (["/talker"], [("/talker",), ()]),
        ([], [(), ()]),
    ],
)
def test_a_node_belongs_to_the_program_whose_name_it_has(
    there: list[str], own: list[tuple[str, ...]], tmp_path: Path
) -> None:
    assignment = two_nodes.assignment(tmp_path)
    assert names_of(assignment, assignment.plan("chat"), there) == own


def test_a_program_that_runs_alone_has_all_nodes(tmp_path: Path) -> None:
    assignment = two_nodes.assignment(tmp_path)
    assert names_of(assignment, assignment.plan("alone"), ["/a", "/b"]) == [("/a", "/b")]


def chat(*nodes: NodeSeen, first_ended: bool = False) -> Run:
    listener = Program("listener", "ros2 run my_talking listener", transcript="I heard\n", status=0)
    return Run(
        command="ros2 run my_talking talker",
        name="chat",
        nodes=nodes,
        watch=Watch(settled=True),
        started=True,
        ended_by_itself=first_ended,
        status=1,
        transcript="Traceback\n",
        seen=Observations(0.25),
        others=[listener],
    )


def test_an_answer_of_another_node_does_not_start_a_program(tmp_path: Path) -> None:
    assignment = two_nodes.assignment(tmp_path)
    plan = assignment.plan("chat")
    talker = NodeSeen("/talker", clock=True, rosout=True, parameters=True)
    listener = replace(talker, name="/listener", answers=True)
    run = chat(talker, listener, first_ended=True)
    first, second = (of_program(run, assignment, plan, start) for start in (0, 1))
    assert (first.started, first.watch.settled, first.nodes) == (False, False, (talker,))
    assert (second.started, second.watch.settled, second.nodes) == (True, True, (listener,))
    assert (second.command, second.transcript) == ("ros2 run my_talking listener", "I heard\n")
    assert [other.node for other in second.others] == ["talker"]
