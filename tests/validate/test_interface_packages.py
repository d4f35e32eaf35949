"""Validating an assignment whose solution has a package of interfaces beside its own."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.base.errors import AssignmentError, UsageError
from grader.base.unheard import unheard
from grader.course.find import KEYS
from grader.course.load import load_assignment
from grader.mistakes.catalogue import CATALOGUE
from grader.package.edit.tree import Edit, Move, Nest, Replace, Tree, apply_all
from grader.ros.distro import find_distro
from grader.validate.marking import submit, submit_path
from grader.validate.named import MutantsFile, read_mutants
from grader.validate.validation import ValidationOptions, solution_of, validate
from grader.verdict.checks.all import CHECKS
from grader.verdict.order import Order
from tests.marking import LIMITS
from tests.processes import ROOT

OWN_MESSAGE = KEYS / "own_message"
ORDER = Order(
    path=Path(),
    assignment=load_assignment(
        ROOT / "lab/course/own_message/assignment.yaml", known_checks=CHECKS
    ),
    distro=find_distro("jazzy"),
    sandbox="bubblewrap",
    limits=LIMITS,
)
MESSAGE = "../my_robot_interfaces/msg/Distance.msg"
MUTANTS = """\
schema: 1
mutants:
  - name: mine
    check: message.fields
    mistake: interface.field_missing
    edits:
      - {rename: %s, to: %s}
"""


@pytest.fixture(scope="module")
def solution() -> Tree:
    return solution_of(OWN_MESSAGE, ORDER.assignment)


def read(folder: Path, path: str, to: str) -> MutantsFile:
    file = folder / "mutants.yaml"
    file.write_text(MUTANTS % (path, to))
    return read_mutants(
        file, checks=["message.fields"], kinds=CATALOGUE, distro=ORDER.distro, beside=True
    )


def test_the_packages_are_submitted_side_by_side(solution: Tree) -> None:
    submitted = submit(solution, ORDER)
    assert submitted.root == "my_robot_controller"
    assert [(one.name, one.root) for one in submitted.packages] == [("my_robot_interfaces",) * 2]
    assert submitted.sha256 == submit_path(OWN_MESSAGE / "solution", ORDER).sha256


@pytest.mark.parametrize("before", [(), (Nest("src/my_robot_controller"),)])
def test_an_edit_changes_a_file_of_the_interface_package(
    before: tuple[Edit, ...], solution: Tree
) -> None:
    edit = Replace(MESSAGE, "float64 speed", "float32 speed")
    submitted = submit(apply_all((edit, *before), solution), ORDER)
    (package,) = submitted.packages
    assert "float32 speed" in (package.text("msg/Distance.msg") or "")
    assert Path(package.root).parent == Path(submitted.root or "").parent
    assert submitted.files == submit(solution, ORDER).files


def test_an_interface_package_can_be_moved_into_the_other_one(solution: Tree) -> None:
    edit = Move("../my_robot_interfaces", "my_robot_interfaces")
    submitted = submit(apply_all((edit,), solution), ORDER)
    assert [one.root for one in submitted.packages] == ["my_robot_controller/my_robot_interfaces"]


def test_edits_name_files_of_the_interface_package(tmp_path: Path) -> None:
    (mutant,) = read(tmp_path, MESSAGE, "../my_robot_interfaces/msg/distance.msg").mutants
    assert mutant.edits == (Move(MESSAGE, "../my_robot_interfaces/msg/distance.msg"),)
    assert mutant.may_be_static(ORDER.assignment)


@pytest.mark.parametrize("path", ["..", ".", "../../x", "../a/../../x", "a/../x", "/x"])
def test_edits_name_nothing_outside_of_the_packages(path: str, tmp_path: Path) -> None:
    for pair in ((path, "x"), ("x", path)):
        with pytest.raises(AssignmentError, match=r":7:\d+: not a path inside") as caught:
            read(tmp_path, *pair)
        assert str(caught.value).endswith(f": {path}")


def test_a_solution_without_its_interface_package_is_a_usage_error(tmp_path: Path) -> None:
    (tmp_path / "solution/my_robot_controller").mkdir(parents=True)
    with pytest.raises(UsageError, match="my_robot_interfaces"):
        solution_of(tmp_path, ORDER.assignment)


def test_the_named_mutants_of_messages_are_decided_by_their_files() -> None:
    options = ValidationOptions(order=ORDER, keys=OWN_MESSAGE, static=True, named=True)
    matrix = validate(options, notify=unheard)
    rows = [row for row in matrix.rows if row.mutant.families[0].startswith("message.")]
    assert len(rows) > 40
    assert [row.mutant.name for row in rows if not row.hit] == []
