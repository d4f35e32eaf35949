"""What a student has made wrong is named by the guide, and right work is never asked for twice."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.course.load import load_assignment
from lab.guide.hints import hints_of
from lab.guide.lesson import read_lesson
from lab.guide.predicates import current, next_actions
from lab.guide.state import StudentState
from tests import processes
from tests.lab.wrong_states import WRONG, Wrong, make

COURSE = processes.ROOT / "lab/course/hello_time"
LESSON = read_lesson(COURSE / "lesson.md", distro="jazzy")
ROS = {"ROS_DISTRO": "jazzy", "AMENT_PREFIX_PATH": "/opt/ros/jazzy"}


@pytest.mark.parametrize("wrong", WRONG.values(), ids=WRONG)
@pytest.mark.parametrize("lang", ["en", "ko"])
def test_a_wrong_state_is_named(wrong: Wrong, lang: str, tmp_path: Path) -> None:
    workspace = make(tmp_path, wrong)
    assignment = load_assignment(COURSE / "assignment.yaml")
    state = StudentState(workspace, assignment, ROS, home=tmp_path, lang=lang)
    actions = next_actions(state, LESSON.steps)
    assert current(actions, LESSON.steps) == wrong.step
    action = actions[wrong.step - 1]
    assert action is not None
    if lang == "en":
        said = f"{action.found}\n{action.next}"
        for text in wrong.says:
            assert text in said
        for text in wrong.never:
            assert text not in said
    step = LESSON.steps[wrong.step - 1]
    hints = hints_of(action, step, Path("~/ros2_ws/src/my_robot_controller"))
    assert len(hints) == len(set(hints)) == 3
    assert all(hints)


def test_after_full_marks_the_last_step_is_done(tmp_path: Path) -> None:
    workspace = make(tmp_path, WRONG["not built since the entry was added"])
    for path in ("lib/my_robot_controller/test_node",):
        (workspace / "install/my_robot_controller" / path).parent.mkdir(parents=True)
        (workspace / "install/my_robot_controller" / path).touch()
    overlay = f"{workspace}/install/my_robot_controller:/opt/ros/jazzy"
    environment = {**ROS, "AMENT_PREFIX_PATH": overlay}
    assignment = load_assignment(COURSE / "assignment.yaml")
    for passed, last in ((False, True), (True, False)):
        state = StudentState(workspace, assignment, environment, home=tmp_path, passed=passed)
        actions = next_actions(state, LESSON.steps)
        assert current(actions, LESSON.steps) == 10
        assert (actions[9] is not None) == last
