"""The guide finds the student's current step from the workspace, and the next action."""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pexpect
import pytest
from rich.cells import cell_len

from grader.base.gated_console import GatedConsole
from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from grader.course.find import lessons_of
from grader.course.folder import own_course
from grader.course.load import load_assignment
from grader.report.commands import broken
from grader.report.wrap import rows
from lab.guide import predicates as steps
from lab.guide.action import Action
from lab.guide.lesson import lesson_file, read_lesson
from lab.guide.show import show_current, show_next, show_step
from lab.guide.state import StudentState
from lab.guide.task import Task
from tests import processes
from tests.lab.ten_steps import NODE
from tests.lab.workspaces import PACKAGE, SETUP, after_step, put

COURSE = processes.ROOT / "lab/course/hello_time"
LESSON = read_lesson(COURSE / "lesson.md", distro="jazzy")
INNER = f"src/{PACKAGE}/{PACKAGE}"
FILE = f"{INNER}/my_first_node.py"


def found(workspace: Path, environment: Mapping[str, str]) -> tuple[str, ...]:
    wanted = load_assignment(COURSE / "assignment.yaml")
    actions = steps.next_actions(StudentState(workspace, wanted, environment), LESSON.steps)
    return tuple(f"{a.found} {a.next}".strip() if a is not None else "" for a in actions)


def current(told: tuple[str, ...]) -> int:
    return next((n for n, text in enumerate(told, start=1) if text), len(told))


def guide(*words: str, workspace: Path, env: dict[str, str]) -> tuple[int, str, str]:
    line = [sys.executable, "-m", "lab.guide", "--workspace", str(workspace), *words]
    done = processes.run(line, env={"AMENT_PREFIX_PATH": "", "ROS_DISTRO": "", **env})
    return done.returncode, done.stdout, done.stderr


def test_every_step_of_the_lesson_can_be_detected() -> None:
    assert [step.number for step in LESSON.steps] == list(range(1, 11))
    assert all(step.done in steps.STEPS for step in LESSON.steps)


@pytest.mark.parametrize("step", range(2, 10))
def test_after_a_step_the_next_one_is_current(step: int, tmp_path: Path) -> None:
    environment = after_step(tmp_path / "ws", step, NODE)
    now = found(tmp_path / "ws", environment)
    assert current(now) == step + 1
    assert now[:step] == ("",) * step


def test_a_terminal_without_ros_is_the_first_thing_to_fix(tmp_path: Path) -> None:
    after_step(tmp_path / "ws", 9, NODE)
    assert found(tmp_path / "ws", {})[0] == "source /opt/ros/jazzy/setup.bash"
    assert found(tmp_path / "ws", {"ROS_DISTRO": "kilted"})[0].endswith("kilted/setup.bash")


def test_another_terminal_has_not_sourced_the_overlay(tmp_path: Path) -> None:
    environment = after_step(tmp_path / "ws", 9, NODE) | {"AMENT_PREFIX_PATH": "/opt/ros/jazzy"}
    now = found(tmp_path / "ws", environment)
    assert current(now) == 9
    assert now[8].endswith("source install/local_setup.bash")


@pytest.mark.parametrize(
    ("old", "new", "output"),
    [
        ("#!/usr/bin/env python3\n", "", "first line"),
        ("(Node)", "(object)", "no class that inherits from Node"),
        ("self.create_timer(1.0, self.timer_callback)", "pass", "no timer"),
        ("def main(", "def mian(", "no function main"),
        ("rclpy.spin(node)", "pass", "does not spin"),
        ("class MyFirstNode(Node):", "class MyFirstNode(Node)", "line 6"),
    ],
)
def test_an_unfinished_node_is_reported_with_what_is_missing(
    old: str, new: str, output: str, tmp_path: Path
) -> None:
    environment = after_step(tmp_path / "ws", 9, NODE.replace(old, new))
    now = found(tmp_path / "ws", environment)
    assert current(now) == 6
    assert output in now[5]


def test_another_way_to_write_the_node_counts(tmp_path: Path) -> None:
    node = NODE.replace("from rclpy.node import Node", "import rclpy.node as n")
    environment = after_step(tmp_path / "ws", 9, node.replace("(Node)", "(n.Node)"))
    assert current(found(tmp_path / "ws", environment)) == 10


@pytest.mark.parametrize(
    ("lacking", "output"),
    [("", ""), ("self.create_timer(1.0, self.timer_callback)", "no timer"), ("(Node)", "no class")],
)
def test_a_class_in_another_module_of_the_package_counts(
    lacking: str, output: str, tmp_path: Path
) -> None:
    head, end = NODE.split("def main(")
    entry = (
        f"#!/usr/bin/env python3\nimport rclpy\nfrom .hello import MyFirstNode\n\n\ndef main({end}"
    )
    environment = after_step(tmp_path / "ws", 9, entry)
    new = "pass" if output == "no timer" else ""
    put(tmp_path / "ws", f"{INNER}/hello.py", head.replace(lacking, new) if lacking else head)
    now = found(tmp_path / "ws", environment)
    assert current(now) == (6 if lacking else 10)
    assert output in now[5]


def test_files_in_a_wrong_state_are_reported(tmp_path: Path) -> None:
    """Each mistake alone, in an otherwise right workspace."""

    def after(name: str) -> tuple[Path, Mapping[str, str]]:
        return tmp_path / name, after_step(tmp_path / name, 9, NODE)

    workspace, environment = after("not executable")
    (workspace / FILE).chmod(0o644)
    assert " chmod +x " in found(workspace, environment)[4]

    workspace, environment = after("wrong target")
    wrong = "'test_node = my_robot_controller.my_node:main',"
    put(workspace, f"src/{PACKAGE}/setup.py", SETUP.replace("ENTRY", wrong))
    assert "there is no module 'my_robot_controller.my_node'" in found(workspace, environment)[6]

    workspace, environment = after("broken setup")
    put(workspace, f"src/{PACKAGE}/setup.py", "setup(")
    assert "cannot be read" in found(workspace, environment)[6]

    workspace, environment = after("a C++ package")
    (workspace / f"src/{PACKAGE}/setup.py").unlink()
    put(workspace, f"src/{PACKAGE}/CMakeLists.txt")
    assert "Delete" in found(workspace, environment)[2]

    workspace, environment = tmp_path / "built in src", {"AMENT_PREFIX_PATH": "/opt/ros/jazzy"}
    after_step(workspace, 3, NODE)
    for name in ("build", "install"):
        (workspace / "src" / name).mkdir()
    assert "you built in ~/ros2_ws/src" in found(workspace, environment)[3]


def test_a_merged_install_folder_counts(tmp_path: Path) -> None:
    environment = after_step(tmp_path / "ws", 9, NODE)
    install = tmp_path / "ws" / "install"
    for part in ("share", "lib"):
        (install / PACKAGE / part).rename(install / part)
    assert current(found(tmp_path / "ws", environment)) == 10


def test_a_folder_that_is_not_a_workspace_is_at_step_2(tmp_path: Path) -> None:
    assert current(found(tmp_path / "none", {"AMENT_PREFIX_PATH": "/opt/ros/jazzy"})) == 2


def test_the_command_shows_the_current_step_and_one_next_action(tmp_path: Path) -> None:
    env = after_step(tmp_path / "ws", 5, NODE)
    status, out, err = guide(workspace=tmp_path / "ws", env=env)
    assert (status, err) == (0, "")
    assert out.startswith("Step 6 of 10: Write the node\n")
    assert "\x1b" not in out  # plain text when piped
    assert "'super().__init__" not in out  # code that has quotes gets no others
    assert "inherits from rclpy's 'Node'" in out
    assert "\n    code ~/ros2_ws\n" in out
    assert re.findall("^Next: .*$", out, re.MULTILINE) == [
        "Next: Write the node in my_first_node.py."
    ]
    assert guide(workspace=tmp_path / "ws", env=env)[1] == out  # no state is kept


def test_one_step_the_list_and_the_whole_lesson_can_be_shown(tmp_path: Path) -> None:
    env = after_step(tmp_path / "ws", 5, NODE)
    assert guide("9", workspace=tmp_path / "ws", env=env)[1].startswith("Step 9 of 10")
    listed = guide("list", workspace=tmp_path / "ws", env=env)[1].splitlines()
    assert [line[:3] for line in listed[:10]] == ["[x]"] * 5 + ["[>]"] + ["[ ]"] * 4
    whole = guide("all", workspace=tmp_path / "ws", env=env)[1]
    assert [f"Step {n} of 10: " in whole for n in range(1, 11)] == [True] * 10


def letters(text: str) -> set[str]:
    """Return the words of a text without its marks, and without quotes."""
    return set(re.findall(r"[^\W\d_]+", re.sub(r"[*`']", "", text)))


@pytest.mark.parametrize("columns", ["", "60", "120"])
@pytest.mark.parametrize("lang", ["en", "ko"])
@pytest.mark.parametrize("lesson", lessons_of(own_course()))
def test_a_pipe_gets_plain_text_whose_words_are_whole(
    lesson: str, lang: str, columns: str, tmp_path: Path
) -> None:
    env = {"GRADER_ASSIGNMENT": lesson, "GRADER_LANG": lang, "COLUMNS": columns}
    status, out, err = guide("all", workspace=tmp_path, env=env)
    assert (status, err) == (0, "")
    read = read_lesson(lesson_file(own_course() / lesson, lang), distro="jazzy")
    text = "\n".join([read.introduction, *(step.text for step in read.steps)])
    code = "".join(re.findall(r"```\w*\n(.*?)```", text, re.DOTALL))
    prose = "".join(line for line in out.splitlines(True) if not line.startswith("    "))
    assert not re.search(r"```|`|\*\*|\|---|^#|<!--", prose, re.MULTILINE)
    assert {line for line in code.splitlines() if line} <= {
        line.removeprefix("    ") for line in out.splitlines()
    }
    width = int(columns or 80)
    assert [line for line in prose.splitlines() if cell_len(line) > width] == []
    assert letters(re.sub(r"```.*?```|<!--.*?-->", "", text, flags=re.DOTALL)) <= letters(out)


@pytest.mark.parametrize("word", ["0", "11", "lst", "-1", "²"])
def test_an_unknown_step_is_a_usage_error(word: str, tmp_path: Path) -> None:
    status, out, err = guide(word, workspace=tmp_path, env={})
    assert (status, out) == (2, "")
    assert "Traceback" not in err


def test_the_commands_are_those_of_the_labs_distro(tmp_path: Path) -> None:
    out = guide("1", workspace=tmp_path, env={"ROS_DISTRO": "kilted"})[1]
    assert "source /opt/ros/kilted/setup.bash" in out
    assert "jazzy" not in out


def test_commands_are_broken_only_where_a_shell_reads_on(tmp_path: Path) -> None:
    """A command that is wrapped elsewhere cannot be copied."""
    env = {**os.environ, "TERM": "xterm-256color", "PYTHONPATH": str(processes.ROOT)}
    env.pop("COLUMNS", None)
    screen = pexpect.spawn(
        sys.executable,
        ["-m", "lab.guide", "3", "--workspace", str(tmp_path)],
        env=env,
        dimensions=(40, 60),
        encoding="utf-8",
    )
    screen.expect(pexpect.EOF)
    text = re.sub(r"\x1b\[[\d;]*m", "", screen.before)
    assert (
        "ros2 pkg create --build-type ament_python \\\r\n"
        "    my_robot_controller --dependencies rclpy\r\n"
    ) in text
    assert "\x1b[" in screen.before


@pytest.mark.parametrize("width", [40, 60, 80])
@pytest.mark.parametrize("lang", ["en", "ko"])
def test_a_line_to_copy_is_not_wrapped_either(lang: str, width: int) -> None:
    line = "'my_first_node = my_robot_controller.my_first_node:main',"
    text = Translator(lang)(say("Add this line to console_scripts in setup.py: {line}", line=line))
    file = io.StringIO()
    console = GatedConsole(file, width=width, force_terminal=True, color_system=None)
    show_next(console, Task(1, Action(text, "setup.no_entry"), ()), Translator(lang), more=False)
    shown = file.getvalue().splitlines()
    assert any(part.endswith(line) for part in shown)
    assert " ".join(part.strip() for part in shown) == Translator(lang)(say("Next: ")) + text
    assert [part for part in shown if cell_len(part) > width and part != line] == []


def test_a_shell_reads_a_broken_command_as_one(tmp_path: Path) -> None:
    said = "touch 'a  b' && cp 'a  b' c && printf '%s|' one two three four five six 'seven  eight'"
    for width in (40, 60, 200):
        shown = broken(said, width)
        assert all(len(line) <= width for line in shown.splitlines())
        done = subprocess.run(["bash", "-c", shown], cwd=tmp_path, capture_output=True, check=True)
        assert done.stdout.decode() == "one|two|three|four|five|six|seven  eight|"


@pytest.mark.parametrize("lang", ["en", "ko"])
@pytest.mark.parametrize("name", lessons_of(own_course()))
def test_the_current_step_fits_a_terminal_of_24_lines(name: str, lang: str) -> None:
    lesson = read_lesson(
        lesson_file(own_course() / name, lang), distro="jazzy", packages=["turtlesim"]
    )
    action = Action("touch a", "a", "there is a file that has nothing to do with this " * 3)
    for position, step in enumerate(lesson.steps, start=1):
        file = io.StringIO()
        console = GatedConsole(file, width=80, height=24, force_terminal=True, color_system=None)
        show_current(console, lesson, Task(position, action, ()), Translator(lang))
        shown = file.getvalue()
        assert rows(shown, 80) <= 22, (step.number, shown)
        assert "touch a" in shown
        assert all(cell_len(line) <= 80 for line in shown.splitlines()), step.number
    first = lesson.steps[0]
    if first.number == 0:  # (it is not cut)
        file = io.StringIO()
        console = GatedConsole(file, width=80, height=24, force_terminal=True, color_system=None)
        turtle = Action(f"{TURTLE}   {LEAVE}", "a")
        show_current(console, lesson, Task(1, turtle, ()), Translator(lang))
        assert "guide 1" in " ".join(file.getvalue().split())
        assert "guide 0" not in file.getvalue()
        assert rows(file.getvalue(), 80) <= 22


CREATE = "ros2 pkg create --build-type ament_python my_robot_controller --dependencies rclpy"
LEAVE = "(leave it running, and go on in a second terminal)"
TURTLE = "ros2 run turtlesim turtlesim_node"


@pytest.mark.parametrize(
    ("line", "shown"),
    [
        (f"{TURTLE}   {LEAVE}", [f"Next: {TURTLE}", LEAVE]),
        (
            f"Delete ~/a, then in ~/ros2_ws/src: {CREATE}",
            [
                "Next: Delete ~/a, then in ~/ros2_ws/src:",
                CREATE.removesuffix(" rclpy") + " \\",
                "    rclpy",
            ],
        ),
        (
            "Outside of the lab, run: sudo chown -R $USER /home/student/of/a/long/path/ros2_ws",
            [
                "Next: Outside of the lab, run:",
                "sudo chown -R $USER /home/student/of/a/long/path/ros2_ws",
            ],
        ),
        (
            "Correct line 3: ros2 run starts the node, and it runs until you press Ctrl+C there",
            [
                "Next: Correct line 3: ros2 run starts the node, and it runs until you press",
                "Ctrl+C there",
            ],
        ),
        (f"fg   {LEAVE}", [f"Next: fg   {LEAVE}"]),
    ],
)
def test_a_command_within_a_line_stays_whole(line: str, shown: list[str]) -> None:
    file = io.StringIO()
    console = GatedConsole(file, width=80, force_terminal=True, color_system=None)
    show_next(console, Task(1, Action(line, "a"), ()), Translator("en"), more=False)
    assert file.getvalue().splitlines() == shown


@pytest.mark.parametrize("width", [60, 80, 120])
@pytest.mark.parametrize("lang", ["en", "ko"])
@pytest.mark.parametrize("lesson", lessons_of(own_course()))
def test_no_name_is_cut_at_any_width(lesson: str, lang: str, width: int) -> None:
    text = read_lesson(lesson_file(own_course() / lesson, lang), distro="jazzy")
    for step in text.steps:
        file = io.StringIO()
        console = GatedConsole(file, width=width, force_terminal=True, color_system=None)
        show_step(console, step, text, Translator(lang))
        shown = file.getvalue()
        prose = re.sub(r"```.*?```", "", step.text, flags=re.DOTALL)
        names = {name for code in re.findall(r"`([^`\n]+)`", prose) for name in code.split()}
        cut = {name for name in names if name.replace("\\|", "|") not in shown}
        assert {name for name in cut if len(name) < 0.45 * width} == set()
        assert "…" not in shown or "…" in step.text
