"""Drawn values in real runs: a table fails, replay and --like use the same values, lessons stay right."""

from __future__ import annotations

import json
import random
import shutil
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from grader.base.errors import UsageError
from grader.cli.main import main
from grader.course.assignment import Assignment
from grader.course.draw import Values, extremes
from grader.course.find import assignment_file
from grader.course.load import load_assignment
from grader.mistakes.catalogue import CATALOGUE
from grader.report.detail import Detail
from grader.report.feedback import with_feedback
from grader.report.files import read_report
from grader.report.model import CheckResult
from grader.ros.distro import find_distro
from grader.run import unforeseen
from grader.validate.marking import submit
from grader.validate.mutant import Mutant
from grader.validate.named import MUTANTS, read_mutants
from grader.validate.validation import solution_of
from grader.verdict.checks.all import CHECKS
from grader.verdict.order import values_of
from grader.verdict.take_in import take_in_for
from tests import marking
from tests.drawn import results_over, solution
from tests.processes import ROOT

LESSONS = ("draw_circle", "start_stop", "stay_inside", "own_message")
DRAWS = 20
A_TABLE = """\
#!/usr/bin/env python3
import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node


class DrawCircle(Node):
    def __init__(self):
        super().__init__('draw_circle')
        self.declare_parameter('radius', 2.0)
        self.publisher_ = self.create_publisher(Twist, '/turtle1/cmd_vel', 10)
        self.count_ = 0
        self.create_timer(0.5, self.timer_callback)

    def timer_callback(self):
        self.count_ += 1
        message = Twist()
        message.linear.x = 2.0
        message.angular.z = 1.0 if self.count_ <= 12 else 2.0
        self.publisher_.publish(message)


def main(args=None):
    rclpy.init(args=args)
    node = DrawCircle()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
"""
BY_DRAWS = ("log.", "parameter.", "service.answers", "topic.", "world.")
"""The kinds of checks whose outcome the drawn values can change."""


@cache
def lesson(name: str) -> Assignment:
    return load_assignment(assignment_file(name), known_checks=CHECKS)


def drawn(assignment: Assignment, count: int, seed: str = "") -> list[Values]:
    """Return some draws, the same in each run of the tests."""
    chance = random.Random(seed)
    names = assignment.draw.items()
    return [{name: chance.choice(draw.values) for name, draw in names} for _ in range(count)]


def some_draws(assignment: Assignment) -> list[Values]:
    """Return all extremes, and twenty draws."""
    return [*extremes(assignment.draw), *drawn(assignment, DRAWS)]


def a_few_draws(assignment: Assignment, seed: str) -> list[Values]:
    """Return the lowest values, the highest ones, and two draws: others for another seed."""
    ends = list(extremes(assignment.draw))
    return [ends[0], ends[-1], *drawn(assignment, 2, seed)]


def open_(results: dict[str, CheckResult]) -> dict[str, str]:
    return {one.id: str(one.actual) for one in results.values() if one.status != "passed"}


def with_a_table(folder: Path) -> Path:
    """Write the package of the attack: it changes its speed at the instant of the old schedule."""
    shutil.copytree(solution("draw_circle", ROOT), folder, symlinks=True)
    inner = folder / "my_robot_controller" / "my_robot_controller"
    (inner / "draw_circle.py").write_text(A_TABLE, encoding="utf-8")
    return folder


@pytest.mark.prefix
@pytest.mark.full
def test_a_table_fails_and_its_values_can_be_used_again(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(unforeseen, "installation_key", lambda: b"k" * 32)
    package = with_a_table(tmp_path / "handed_in")
    given = ["--assignment", "draw_circle", "--sandbox", "bubblewrap"]
    assert main(["grade", str(package), *given, "--out", str(tmp_path / "a")]) == 1
    (file,) = (tmp_path / "a").rglob("report.json")
    first = read_report(file)
    used = first.runs[0].drawn
    assert set(used) == {"radius", "change"}
    assert first.check("drive.tighter").status == "failed"
    assert first.check("drive.radius").status == "passed"
    wanted = 2.0 / float(used["radius"])
    assert f"{wanted:g}" in str(first.check("drive.tighter").expected)
    # replay uses the values of the evidence; the instant is where the evidence has it
    capsys.readouterr()
    assert main(["replay", str(file), "--verbose"]) == 0
    said = capsys.readouterr().out
    assert "the same verdict" in said
    assert f"radius = {used['radius']:g}" in said
    evidence = json.loads(file.with_name("evidence.json").read_bytes())
    assert evidence["recording"]["asked"]["drawn"] == used
    assert evidence["recording"]["asked"]["runs"][0]["do"][0]["at"] == used["change"]
    # another package of other contents gets the values of this report
    other = str(solution("draw_circle", ROOT))
    again = ["grade", other, *given, "--out", str(tmp_path / "b"), "--like", str(file.parent)]
    assert main(again) == 0
    (copy,) = (tmp_path / "b").rglob("report.json")
    assert read_report(copy).runs[0].drawn == used
    # what a student sees
    assert with_feedback(first, Detail.WHERE).runs[0].drawn == used
    assert with_feedback(first, Detail.POINTS).runs[0].drawn == {}
    # a report of before, or of another assignment, has no values to use
    content = json.loads(file.read_bytes())
    content["runs"][0]["drawn"] = {}
    file.write_text(json.dumps(content), encoding="utf-8")
    with pytest.raises(UsageError, match="no drawn value of 'radius'"):
        values_of(file, lesson("draw_circle"))
    with pytest.raises(UsageError, match="a report of draw_circle, not of start_stop"):
        values_of(file, lesson("start_stop"))
    content["runs"][0]["drawn"] = {"radius": 9.0, "change": 5.0}
    file.write_text(json.dumps(content), encoding="utf-8")
    with pytest.raises(UsageError, match="can no longer be drawn"):
        values_of(file, lesson("draw_circle"))


@pytest.mark.prefix
@pytest.mark.full
@pytest.mark.long
@pytest.mark.parametrize("name", LESSONS)
def test_the_solution_passes_over_all_draws(name: str) -> None:
    assignment = lesson(name)
    submission = take_in_for(assignment, solution(name, ROOT))
    for values, results in results_over(submission, assignment, some_draws(assignment)):
        assert open_(results) == {}, values


@pytest.mark.prefix
@pytest.mark.full
@pytest.mark.long
def test_a_table_passes_only_where_its_own_values_are_drawn(tmp_path: Path) -> None:
    assignment = lesson("draw_circle")
    submission = take_in_for(assignment, with_a_table(tmp_path / "handed_in"))
    own = {"radius": 1.0, "change": 6.0}
    draws = [*some_draws(assignment), own]
    found = results_over(submission, assignment, draws)
    passed = [values for values, results in found if not open_(results)]
    assert passed
    assert [values for values in passed if values != own] == []


def judged_mutants() -> Iterator[tuple[str, Mutant]]:
    """Yield the named mutants that fail at a check whose outcome drawn values can change."""
    for name in LESSONS:
        assignment = lesson(name)
        kinds = {use.id: use.kind for use in assignment.checks}
        path = solution(name, ROOT).parent / MUTANTS
        distro = find_distro("jazzy")
        beside = bool(assignment.others)
        written = read_mutants(path, checks=kinds, kinds=CATALOGUE, distro=distro, beside=beside)
        for mutant in written.mutants:
            if kinds.get(mutant.families[0], "").startswith(BY_DRAWS):
                yield name, mutant


@pytest.mark.prefix
@pytest.mark.full
@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "mutant"),
    [pytest.param(*one, id=f"{one[0]}-{one[1].name}") for one in judged_mutants()],
)
def test_a_named_mutant_fails_at_its_check_whatever_is_drawn(
    name: str, mutant: Mutant, tmp_path: Path
) -> None:
    """Four draws each: all mutants of a lesson together see its values from end to end."""
    assignment = lesson(name)
    tree = mutant.of(solution_of(solution(name, ROOT).parent, assignment))
    submission = submit(tree, marking.order(tmp_path, assignment=assignment))
    for values, results in results_over(
        submission, assignment, a_few_draws(assignment, mutant.name)
    ):
        in_order = [results[use.id] for use in assignment.checks]  # as they stand in the report
        failed = [one for one in in_order if one.status == "failed"]
        hit = [one for one in failed if mutant.is_hit_by(one.id)]
        assert hit, (values, open_(results))
        assert not mutant.mistake or failed[0].mistakes[0].id == mutant.mistake, (values, failed)
