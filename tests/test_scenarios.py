"""Assignments of schema 2, marked for real: each kind of check on right and on broken packages."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.base.unheard import unheard
from grader.course.draw import Values
from grader.course.load import load_assignment
from grader.package.submission import take_in
from grader.report.model import Report
from grader.ros.distro import find_distro
from grader.verdict.checks.all import CHECKS
from grader.verdict.evidence_file import Judged
from grader.verdict.mark import grade, replay
from grader.verdict.order import Order, load_visible
from grader.verdict.recording import Recording
from tests.marking import LIMITS
from tests.processes import ROOT
from tests.scenario_kinds import FORMS, Form, write_course, write_files, write_package

pytestmark = [pytest.mark.prefix, pytest.mark.full]
SOLUTION = ROOT / "grader" / "keys" / "draw_circle" / "solution"
IN_CI = ("right", "values", "no_action")  # the others: the long run
UNCERTAIN = ("inconclusive", "error")


def marked(
    path: Path,
    file: Path,
    kept: list[Judged],
    *,
    distro: str = "jazzy",
    drawn: Values | None = None,
) -> Report:
    """Return the report of a package, with these drawn values."""
    assignment = load_assignment(file, known_checks=CHECKS)
    order = Order(
        path=path,
        assignment=assignment,
        distro=find_distro(distro),
        sandbox="bubblewrap",
        limits=LIMITS.override(assignment.limits),
        drawn=drawn or {},
    )
    return grade(order, unheard, keep=kept.append)


def judged(assignment: str, node: str, folder: Path) -> Report:
    """Return the report of the package `doubling` with this node, of an assignment's text."""
    file = folder / "lesson" / "assignment.yaml"
    file.parent.mkdir()
    file.write_text(assignment, encoding="utf-8")
    write_files(folder / "doubling", node)
    return marked(folder / "doubling", file, [])


@pytest.mark.parametrize(
    "form",
    [
        pytest.param(form, id=form.name, marks=[] if form.name in IN_CI else pytest.mark.long)
        for form in FORMS
    ],
)
def test_each_kind_of_check_tells_right_from_wrong(form: Form, tmp_path: Path) -> None:
    file, kept = write_course(tmp_path), list[Judged]()
    report = marked(write_package(form, tmp_path), file, kept)
    assert {c.id: c.actual for c in report.checks if c.status in UNCERTAIN} == {}
    failed = {c.id: c.mistakes[0].id for c in report.checks if c.status == "failed"}
    assert failed == form.fails
    assert {c.id for c in report.checks if c.status == "skipped"} == set(form.skipped)
    again = replay(
        Recording.from_bytes(kept[0].recording.to_bytes()),
        take_in(
            write_package(form, tmp_path / "again"), package="doubling", node_file="doubler.py"
        ),
        load_assignment(file, known_checks=CHECKS),
    )
    judged = [(c.id, c.status, c.score, c.actual, c.mistakes) for c in report.checks]
    assert [(c.id, c.status, c.score, c.actual, c.mistakes) for c in again.checks] == judged
    assert again.runs == report.runs


def test_every_kind_with_parameters_is_tried_here() -> None:
    kinds = {kind for kind, check in CHECKS.items() if check.parameters is not None}
    lessons = ("draw_circle", "stay_inside", "start_stop", "own_message")
    used = {use.kind for name in lessons for use in load_visible(name).checks}
    files = ("scenario_kinds.py", "test_two_packages.py")
    text = "".join((ROOT / "tests" / name).read_text(encoding="utf-8") for name in files)
    assert {kind for kind in kinds if f"check: {kind}," not in text} - used == set()


@pytest.mark.parametrize("distro", ["jazzy", pytest.param("kilted", marks=pytest.mark.long)])
@pytest.mark.parametrize("lesson", ["stay_inside", "start_stop", "own_message"])
def test_the_solutions_have_full_marks(lesson: str, distro: str) -> None:
    file = ROOT / "lab" / "course" / lesson / "assignment.yaml"
    solution = ROOT / "grader" / "keys" / lesson / "solution"
    report = marked(solution, file, [], distro=distro)
    assert {c.id: c.actual for c in report.checks if c.status != "passed"} == {}
    assert report.score == report.max_score == 100


@pytest.mark.parametrize("distro", ["jazzy", pytest.param("kilted", marks=pytest.mark.long)])
def test_the_solution_of_draw_circle_has_full_marks(distro: str) -> None:
    file = ROOT / "lab" / "course" / "draw_circle" / "assignment.yaml"
    report = marked(SOLUTION, file, [], distro=distro)
    assert {c.id: c.actual for c in report.checks if c.status != "passed"} == {}
    assert report.score == report.max_score == 100
    run = report.runs[0]
    assert (run.world, run.instants, run.topics[0].count) == ("turtlesim", 20, 20)
    x, y = run.path["turtle1"][-1]
    assert 3.0 < x < 8.0
    assert 5.0 < y < 10.0
