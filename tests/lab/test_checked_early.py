"""A check before the lesson's end finds steps that are still to do: the guide keeps their order."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from grader.base.i18n.translator import Translator
from grader.course.find import lessons_of
from grader.course.folder import own_course
from grader.course.load import load_assignment
from lab.commands.check import _first_failure
from lab.commands.doctor import findings
from lab.commands.hint import next_hint
from lab.guide.action import Action
from lab.guide.lesson import lesson_file, read_lesson
from lab.guide.opened import OpenedLab
from lab.guide.progress import FailedCheck, LessonProgress, archive_of
from lab.guide.state import StudentState
from lab.guide.sure import sure_mistake
from lab.guide.task import Task, all_done, find_task
from tests.lab.beginner import DRAW
from tests.lab.ten_steps import NODE
from tests.lab.workspaces import MARKER, PACKAGE, after_step, put
from tests.report import samples

OWN = f"src/{PACKAGE}"
NO_ENTRY = FailedCheck(
    id="entry_point.mapping",
    found="entry_point.mapping: console_scripts has no entry (setup.py:26)",
    kind="entry_point.mapping",
    mistake="setup.no_entry",
    file="setup.py",
    line=26,
    hints=["why", "what", "line"],
)
DEPENDS = FailedCheck(
    id="package.depends",
    found="package.depends: draw_circle.py, line 4, imports geometry_msgs",
    kind="package.depends",
    mistake="package.depend_missing",
    file="package.xml",
    hints=["why", "what"],
)
AS_CMAKE = FailedCheck(
    id="package.manifest",
    found="package.manifest: <build_type>ament_cmake</build_type>",
    kind="package.manifest",
    mistake="package.created_as_cmake",
    file="package.xml",
    hints=["why"],
)


def lab_in(workspace: Path, lesson: str = "hello_time") -> OpenedLab:
    folder = own_course() / lesson
    return OpenedLab(
        workspace,
        workspace.parent,
        "jazzy",
        load_assignment(folder / "assignment.yaml"),
        read_lesson(lesson_file(folder, "en"), distro="jazzy"),
        Translator("en"),
    )


def tasks(
    workspace: Path,
    environment: dict[str, str],
    failed: FailedCheck | None,
    lesson: str = "hello_time",
) -> tuple[Task, Task]:
    """Return what is to do before a check, and after one that found this."""
    lab = lab_in(workspace, lesson)
    state = StudentState(workspace, lab.assignment, environment, home=workspace.parent)
    read = LessonProgress(sha256=state.submission.sha256, failed=failed, all_passed=failed is None)
    return tuple(find_task(state, lab.lesson.steps, kept) for kept in (LessonProgress(), read))  # type: ignore[return-value]


def _cmake(workspace: Path) -> None:
    put(workspace, f"{OWN}/CMakeLists.txt")
    (workspace / OWN / "setup.py").unlink()


def _in_src(workspace: Path) -> None:
    (workspace / MARKER).unlink()
    put(workspace, "src/build/.built_by", "colcon")
    put(workspace, f"src/{MARKER}")


@pytest.mark.parametrize(
    ("step", "change", "failed", "says"),
    [
        (4, lambda _: None, NO_ENTRY, "touch"),
        (5, lambda _: None, NO_ENTRY, "Write the node"),
        (5, lambda w: (w / OWN / PACKAGE / "my_first_node.py").chmod(0o644), NO_ENTRY, "chmod +x"),
        (4, lambda w: put(w, f"{OWN}/my_first_node.py", NODE), NO_ENTRY, "mv "),
        (4, lambda w: (w / OWN).rename(w / PACKAGE), NO_ENTRY, "mv "),
        (4, _in_src, NO_ENTRY, "rm -r build install"),
        (3, _cmake, AS_CMAKE, "Delete ~/ros2_ws/src/my_robot_controller"),
    ],
)
def test_a_check_changes_nothing_of_what_is_next(
    step: int, change: Callable[[Path], object], failed: FailedCheck, says: str, tmp_path: Path
) -> None:
    workspace = tmp_path / "ros2_ws"
    environment = after_step(workspace, step, NODE)
    change(workspace)
    before, after = tasks(workspace, environment, failed)
    assert before.action is not None and after.action is not None
    assert says in before.action.next, before
    assert after.action.next == before.action.next
    assert after.position == before.position


def test_the_line_for_package_xml_is_still_said_after_a_check(tmp_path: Path) -> None:
    workspace = tmp_path / "ros2_ws"
    before, after = tasks(workspace, after_step(workspace, 8, NODE), DEPENDS, "draw_circle")
    assert before.action is not None and after.action is not None
    assert after.action.next == before.action.next
    assert "<depend>geometry_msgs</depend>" in after.action.next
    assert after.action.hints == tuple(DEPENDS.hints)


def test_a_copied_node_that_kept_its_name_is_named(tmp_path: Path) -> None:
    workspace = tmp_path / "ros2_ws"
    environment = after_step(workspace, 8, NODE)
    inner = f"{OWN}/{PACKAGE}/draw_circle.py"
    copied = DRAW.replace("'draw_circle'", "'my_first_node'")
    lesson = lab_in(workspace, "draw_circle").assignment
    for text, found in ((DRAW, None), (copied, "the node is called 'my_first_node'")):
        put(workspace, inner, text, mode=0o755)
        seen = sure_mistake(StudentState(workspace, lesson, environment))
        assert (seen is None) == (found is None)
        assert seen is None or seen.found.startswith(str(found))


@pytest.mark.parametrize("lesson", lessons_of(own_course()))
def test_a_solution_has_no_sure_mistake(lesson: str, tmp_path: Path) -> None:
    workspace = tmp_path / "ros2_ws"
    solution = own_course().parents[1] / "grader/keys" / lesson / "solution"
    shutil.copytree(solution, workspace / "src")
    assigned = lab_in(workspace, lesson).assignment
    assert sure_mistake(StudentState(workspace, assigned, {})) is None


def test_a_misspelt_dependency_is_named(tmp_path: Path) -> None:
    workspace = tmp_path / "ros2_ws"
    environment = after_step(workspace, 8, NODE)
    manifest = workspace / OWN / "package.xml"
    was = manifest.read_text()
    own = "<depend>rclpy</depend>"
    manifest.write_text(was.replace(own, f"{own}\n  <depend>geometry_msg</depend>"))
    before, _ = tasks(workspace, environment, DEPENDS, "draw_circle")
    assert before.action is not None
    assert before.action.found == "package.xml names 'geometry_msg', not 'geometry_msgs'"


def test_what_was_found_stands_beside_what_was_expected(tmp_path: Path) -> None:
    radius = samples.check("drive.radius", "failed")
    radius = radius.model_copy(update={"expected": "double", "actual": "integer", "where": None})
    kept = _first_failure(samples.report(radius), lab_in(tmp_path, "draw_circle"))
    assert kept is not None and kept.found == "drive.radius: integer; expected: double"


def test_the_hints_of_the_check_are_those_of_its_step(tmp_path: Path) -> None:
    workspace = tmp_path / "ros2_ws"
    _, after = tasks(workspace, after_step(workspace, 6, NODE), NO_ENTRY)
    assert after.action is not None and after.action.id == "setup.no_entry"
    assert after.action.hints == tuple(NO_ENTRY.hints)


@pytest.mark.parametrize(
    ("call", "unset"),
    [
        ("self.create_timer(1.0, self.timer_callback)", "_default_callback_group"),
        ("self.get_logger().info('a')", "_logger"),
        ("self.declare_parameter('a', 1)", "_parameter_overrides"),
    ],
)
def test_the_error_of_a_missing_constructor_is_the_one_that_rclpy_gives(
    call: str, unset: str, tmp_path: Path
) -> None:
    node = f"""#!/usr/bin/env python3
import rclpy
from rclpy.node import Node


class MyFirstNode(Node):
    def __init__(self):
        {call}

    def timer_callback(self):
        pass


def main(args=None):
    rclpy.init(args=args)
    rclpy.spin(MyFirstNode())
"""
    workspace = tmp_path / "ros2_ws"
    environment = after_step(workspace, 8, node)
    found = sure_mistake(StudentState(workspace, lab_in(workspace).assignment, environment))
    assert found is not None and f"has no attribute '{unset}'" in found.found


def test_the_doctor_asks_for_no_executable_before_there_is_an_entry(tmp_path: Path) -> None:
    workspace = tmp_path / "ros2_ws"
    environment = after_step(workspace, 6, NODE)
    said = [found.text for found in findings(lab_in(workspace), environment, workspace)]
    assert "the build is up to date" in said
    assert not any("executable" in text for text in said)


def test_the_doctor_names_a_foreign_file_and_a_stopped_node(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("owners.not_yours", "runs.stopped"):
        named = Action(f"do {name}", name, found=name)
        monkeypatch.setattr(f"lab.guide.{name}", lambda _, named=named: named)
    workspace = tmp_path / "ros2_ws"
    environment = after_step(workspace, 9, NODE)
    found = {f.text: f.remedy for f in findings(lab_in(workspace), environment, workspace)}
    assert found["owners.not_yours"] == "do owners.not_yours"
    assert found["runs.stopped"] == "do runs.stopped"


def test_who_has_made_the_archive_is_not_told_to_make_it(tmp_path: Path) -> None:
    workspace = tmp_path / "ros2_ws"
    after_step(workspace, 9, NODE)
    lab = lab_in(workspace)
    done = Task(10, None, (), passed=True)
    assert next_hint(lab, done) == []  # (what is next is said before the hints)
    assert all_done(done)[1].startswith("lab submit makes the archive")
    made = replace(done, archive="submit/hello_time.zip", following="The next lesson: that.")
    assert all_done(made)[1] == (
        "The archive to hand in: ~/ros2_ws/submit/hello_time.zip. The next lesson: that."
    )


def test_an_archive_counts_until_a_file_is_saved() -> None:
    kept = LessonProgress(submitted="submit/hello time.zip 2026-11-29T15:00:00+00:00")
    made = 1795964400.0
    assert archive_of(kept, made - 60) == "submit/hello time.zip"
    assert archive_of(kept, made + 0.5) == "submit/hello time.zip"
    assert archive_of(kept, made + 2) == ""
    assert archive_of(LessonProgress(), 0.0) == ""
