"""Lesson 1 begins with a turtle, where the lab has one: an optional step that holds up nobody."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from grader.base.errors import UsageError
from grader.base.i18n.translator import Translator
from grader.base.unheard import unheard
from grader.course.folder import own_course
from grader.course.load import load_assignment
from grader.ros import interfaces
from grader.ros.prefix import Ros
from lab.guide.lesson import Lesson, lesson_file, read_lesson
from lab.guide.opened import OpenedLab
from lab.guide.task import Task
from lab.ros_packages import has_package
from tests.domains import new_domain
from tests.lab.kinds import Kind
from tests.lab.screen import Lab
from tests.lab.ten_steps import NODE
from tests.lab.workspaces import after_step, put

COURSE = own_course()
RUN = "ros2 run turtlesim turtlesim_node"
TERMINAL = {"ROS_DISTRO": "jazzy", "AMENT_PREFIX_PATH": "/opt/ros/jazzy"}


def lesson(name: str, lang: str, packages: list[str]) -> Lesson:
    return read_lesson(lesson_file(COURSE / name, lang), distro="jazzy", packages=packages)


def task(workspace: Path, environment: dict[str, str], lang: str = "en") -> Task:
    """Return what the guide says in a lab with turtlesim; the graph is not asked."""
    opened = OpenedLab(
        workspace,
        workspace.parent,
        "jazzy",
        load_assignment(COURSE / "hello_time" / "assignment.yaml"),
        lesson("hello_time", lang, ["turtlesim"]),
        Translator(lang),
    )
    return opened.task(environment)


def ran(workspace: Path, command: str, status: int = 0) -> None:
    """Keep a run as the prompt of a terminal does."""
    put(workspace, ".lab/ran", f"1000000\t9000000\t{status}\t{command}\n")


@pytest.mark.parametrize("lang", ["en", "ko"])
@pytest.mark.parametrize("name", ["hello_time", "draw_circle"])
def test_without_turtlesim_no_text_names_it_as_a_command(name: str, lang: str) -> None:
    said = [step.text for step in lesson(name, lang, []).steps]
    with_it = [step.text for step in lesson(name, lang, ["turtlesim"]).steps]
    assert "turtlesim_node" in "".join(with_it)
    assert "lab window" in "".join(with_it)
    for text in said:
        assert not re.search("turtlesim|lab window|teleop|<!--", text)
    assert [text for text in said if text not in with_it] in ([], said[-1:])


def test_the_first_step_has_no_number_among_the_ten() -> None:
    here = lesson("hello_time", "en", ["turtlesim"])
    assert [step.number for step in here.steps] == list(range(11))
    assert here.count == lesson("hello_time", "en", []).count == 10
    assert [step.number for step in here.steps if step.optional] == [0]


@pytest.mark.parametrize(
    ("mark", "meant"), [("optionl", "'optional'"), ("needs: turtelsim", "'needs: turtlesim'")]
)
def test_an_unknown_mark_of_a_step_is_told(mark: str, meant: str, tmp_path: Path) -> None:
    file = tmp_path / "lesson.md"
    file.write_text(f"# A lesson\n\n## 1. Go\n<!-- done: package; {mark} -->\n\nGo.\n")
    with pytest.raises(UsageError, match=f"step 1 of the lesson.*{meant}"):
        read_lesson(file, distro="jazzy")


@pytest.mark.parametrize("status", [0, 130])
def test_a_turtle_that_ran_is_remembered(status: int, tmp_path: Path) -> None:
    workspace = tmp_path / "ros2_ws"
    (workspace / "src").mkdir(parents=True)
    first = task(workspace, TERMINAL)
    assert first.position == 1
    assert first.action is not None and first.action.next.startswith(RUN)
    ran(workspace, RUN, status)
    assert task(workspace, TERMINAL).actions[0] is None
    ran(workspace, "ros2 run my_robot_controller test_node")
    after = task(workspace, TERMINAL)
    assert after.actions[0] is None
    assert after.position == 4  # (a new lab has done steps 1 and 2)


def test_a_turtle_that_crashed_did_not_run(tmp_path: Path) -> None:
    workspace = tmp_path / "ros2_ws"
    (workspace / "src").mkdir(parents=True)
    ran(workspace, RUN, 1)
    found = task(workspace, TERMINAL)
    assert found.position == 1
    assert found.action is not None and "exit status 1" in found.action.found


@pytest.mark.parametrize("step", range(3, 10))
def test_who_leaves_the_turtle_out_is_not_held_up(step: int, tmp_path: Path) -> None:
    environment = after_step(tmp_path / "ros2_ws", step, NODE)
    found = task(tmp_path / "ros2_ws", environment)
    assert found.position == step + 2
    assert found.actions[0] is not None


def test_who_begins_with_a_mistake_is_told_of_the_mistake(tmp_path: Path) -> None:
    put(tmp_path / "ros2_ws", "src/my_robot_controller/CMakeLists.txt")
    found = task(tmp_path / "ros2_ws", TERMINAL)
    assert found.action is not None and found.action.id == "package.created_as_cmake"


def test_a_terminal_without_ros_is_told_to_source_it(tmp_path: Path) -> None:
    (tmp_path / "ros2_ws" / "src").mkdir(parents=True)
    found = task(tmp_path / "ros2_ws", {"ROS_DISTRO": "jazzy"})
    assert found.action is not None and found.action.next.startswith("source /opt/ros/jazzy")


def test_a_lab_has_turtlesim_if_its_ros_has_it(tmp_path: Path) -> None:
    assert not has_package("turtlesim", {"AMENT_PREFIX_PATH": str(tmp_path)})
    put(tmp_path, "share/turtlesim/package.xml")
    assert has_package("turtlesim", {"AMENT_PREFIX_PATH": f"/nonexistent:{tmp_path}"})


@pytest.mark.prefix
def test_without_a_compiler_a_lab_opens_without_turtlesim(
    ros_jazzy: Ros, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    wheels = ros_jazzy.path.with_name(ros_jazzy.path.name.partition("-interfaces-")[0])
    monkeypatch.setenv("GRADER_CACHE", str(tmp_path))
    place = tmp_path / "prefixes" / wheels.name
    place.parent.mkdir()
    place.symlink_to(wheels)
    bare = type(ros_jazzy)(**{**vars(ros_jazzy), "path": place})
    monkeypatch.setattr(interfaces, "missing_for_building", lambda: ["g++"])
    assert interfaces.with_turtlesim(bare, notify=unheard) == bare
    assert not has_package("turtlesim", {"AMENT_PREFIX_PATH": str(bare.path)})


@pytest.mark.long
def test_the_commands_of_the_first_step_work_as_written(kind: Kind, tmp_path: Path) -> None:
    (step,) = [one for one in lesson("hello_time", "en", ["turtlesim"]).steps if one.optional]
    text = step.text.replace("\\\n", "")  # (a shell reads on behind the backslash)
    lines = re.findall(r"^ros2 .*$", text, re.MULTILINE)
    first_line, keys, *others = [line.partition("  #")[0].rstrip() for line in lines]
    assert first_line == RUN
    env = {"ROS_DOMAIN_ID": new_domain()}
    workspace = tmp_path / "ros2_ws"
    with Lab(kind, workspace, env=env) as first, Lab(kind, workspace, env=env) as second:
        assert "Next: 0. Look at a robot" in first.welcome + second.welcome
        first.screen.sendline(RUN)
        first.screen.expect_exact("Spawning turtle [turtle1]")
        said = {line: second.type(line) for line in others}
        assert second.status() == 0
        assert "/turtlesim" in said["ros2 node list"]
        assert "name='turtle2'" in said[others[-1]]
        second.screen.sendline(keys)
        second.screen.expect_exact("'q' quits.")
        second.screen.send("q")
        second.wait_for_prompt()
        assert second.status() == 0
        assert "Step 3 of 10" in second.type("guide")  # it has seen the turtle
        assert "Done: 0. Look at a robot" in first.interrupt()
        assert (first.leave(), second.leave()) == (0, 0)
