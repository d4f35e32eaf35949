"""Guide, hint, status and check name one thing: the one that is there now, and none that has passed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from grader.base.i18n.particles import with_particles
from grader.course.load import load_assignment
from grader.course.values import pattern_in_words
from grader.ros.prefix import Ros
from lab.guide.lesson import read_lesson
from lab.guide.predicates import next_actions
from lab.guide.state import StudentState
from lab.guide.sure import sure_mistake
from tests import processes
from tests.corpus.build import write
from tests.corpus.right import RIGHT
from tests.lab.kinds import Kind
from tests.lab.screen import Lab
from tests.lab.test_lab_commands import environment, lab
from tests.lab.workspaces import ENTRY, EXECUTABLE, PACKAGE, SOLUTION, open_to_all
from tests.lab.wrong_states import INNER, NODE, OWN, edit, in_node, in_setup, make
from tests.lab.wrong_states import Wrong as State

LESSON = read_lesson(processes.ROOT / "lab/course/hello_time/lesson.md", distro="jazzy")
RUN = "ros2 run my_robot_controller test_node"
UNQUOTED = ENTRY.replace("'", "")
SUPER = "super().__init__('my_first_node')"


def home_in(folder: Path, change: Callable[[Path], object]) -> Path:
    """Make a home with a workspace that is built and changed."""
    make(folder, State(change, 0, ()))
    built = folder / "ros2_ws" / EXECUTABLE
    built.parent.mkdir(parents=True)
    built.touch()
    return folder


def guide(home: Path, **more: str) -> str:
    """Return what the guide prints below the step's text, and its heading."""
    overlay = f"{home}/ros2_ws/install/{PACKAGE}:/opt/ros/jazzy"
    env = environment(home, **{"AMENT_PREFIX_PATH": overlay, **more})
    done = processes.run([sys.executable, "-m", "lab.guide"], env=env, cwd=home)
    assert done.returncode == 0, done.stderr
    heading, *lines = done.stdout.splitlines()
    told = [line for line in lines if line.startswith(("Found: ", "Next: "))]
    return "\n".join([heading, *told])


def ran(home: Path, status: int, *, seconds: float = 2.0, line: str = RUN) -> None:
    """Write what the prompt keeps of a run that has just ended."""
    now = int(time.time() * 1e6)
    kept = home / "ros2_ws/.lab/ran"
    kept.parent.mkdir(exist_ok=True)
    kept.write_text(f"{now - int(seconds * 1e6)}\t{now}\t{status}\t{line}\n", encoding="utf-8")


def saved_before(home: Path, seconds: float) -> None:
    """Make every file of the workspace that much older."""
    then = time.time() - seconds
    for path in (home / "ros2_ws").rglob("*"):
        os.utime(path, (then, then))


@pytest.mark.full
def test_what_a_check_found_is_shown_until_it_is_corrected(ros_jazzy: Ros, tmp_path: Path) -> None:
    home = home_in(tmp_path, in_node("self.counter_ += 1", "self.count_ += 1"))
    workspace = home / "ros2_ws"
    checked = lab(home, "check", "--sandbox", "bubblewrap", "--explain")
    assert checked.returncode == 1, checked.stderr
    said = guide(home)
    place = f"{PACKAGE}/my_first_node.py"
    assert "Step 6 of 10" in said
    assert f"Correct {place}, line 19" in said
    assert f"{place}:19" in checked.stdout
    hints = [lab(home, "hint").stdout for _ in range(3)]
    assert all(said.splitlines()[1].removeprefix("Found: ") in hint for hint in hints)
    assert (
        f"{place}, line 19:\n    -        self.count_ += 1\n    +        self.counter_ += 1\n"
        in hints[2]
    )
    assert "Last check: 87 of 100 points.\n" in lab(home, "status").stdout
    edit(workspace, NODE, "self.count_ += 1", "self.counter_ += 1")
    shown = guide(home) + lab(home, "status").stdout + lab(home, "hint").stdout
    assert "count_'" not in shown
    assert "line 19" not in shown
    assert "Last check: 87 of 100 points, before your last change." in shown
    assert f"{RUN}" in shown
    assert lab(home, "check", "--sandbox", "bubblewrap").returncode == 0
    assert "Found" not in guide(home)
    edit(workspace, NODE, "Hello time", "Hello")
    assert "your files have changed since the last check" in guide(home)


def test_a_mistake_in_setup_py_is_named_and_no_other_one(tmp_path: Path) -> None:
    home = home_in(tmp_path, in_setup(ENTRY, UNQUOTED))
    said = guide(home)
    assert "Step 7 of 10" in said
    assert "Correct setup.py, line 25" in said
    assert "==" not in said
    hints = [lab(home, "hint").stdout for _ in range(3)]
    assert not any("comma" in hint or "==" in hint for hint in hints)
    assert f"Write: '{UNQUOTED.rstrip(',')}'" in hints[1]
    assert f"setup.py, line 25:\n    -            {UNQUOTED}" in hints[2]


@pytest.mark.parametrize(
    ("old", "new", "texts"),
    [
        (SUPER, "pass", ("super().__init__() is not called", "line 14")),
        (SUPER, "super().__init__()", ("line 12",)),
        ("self.timer_callback)", "self.timer_calback)", ("timer_calback", "line 14")),
        ("self.timer_callback)", "self.timer_callback())", ("line 14", "not callable")),
        ("import rclpy\n", "import rclpyy as rclpy\n", ("rclpyy",)),
        (
            "'my_first_node'",
            "'first_node'",
            ("called 'first_node', not 'my_first_node'", "line 12"),
        ),
        ("self.counter_ += 1", "self.counter_ + 1", ("line 19",)),
    ],
)
def test_a_node_that_cannot_work_is_not_done(
    old: str, new: str, texts: tuple[str, ...], tmp_path: Path
) -> None:
    said = guide(home_in(tmp_path, in_node(old, new)))
    assert "Step 6 of 10" in said
    assert all(text in said for text in texts), said


@pytest.mark.full
def test_a_right_node_is_done_however_it_is_written(tmp_path: Path) -> None:
    assignment = load_assignment(processes.ROOT / "lab/course/hello_time/assignment.yaml")
    for package in RIGHT:
        workspace = tmp_path / package.name
        (workspace / "src").mkdir(parents=True)
        found = next(write(package, tmp_path / f"{package.name}_given").rglob("package.xml"))
        found.parent.rename(workspace / "src" / PACKAGE)
        assert sure_mistake(StudentState(workspace, assignment, {})) is None, package.name


def test_a_node_has_run_if_it_did_so_after_the_last_save(tmp_path: Path) -> None:
    home = home_in(tmp_path, lambda workspace: None)
    assert "Step 10" in guide(home)  # outside of a lab nobody knows
    (home / "ros2_ws/.lab").mkdir(exist_ok=True)
    (home / "ros2_ws/.lab/ran").touch()
    assert f"Next: {RUN}" in (said := guide(home))
    assert "Step 9" in said
    saved_before(home, 60)
    ran(home, 1)
    assert "ended with an error (exit status 1)" in (said := guide(home))
    assert "explain -" in said
    assert "Step 9" in said
    ran(home, 130)
    assert "Step 10" in (said := guide(home))
    assert "Next: check" in said
    edit(home / "ros2_ws", NODE, "import rclpy\n", "import rclpy\n\n")
    assert "your files have changed since you ran the node" in guide(home)
    assert "exit status" not in guide(home)


def test_a_node_that_runs_in_another_terminal_is_seen(tmp_path: Path) -> None:
    home = home_in(tmp_path, lambda workspace: None)
    ran(home, 1)  # (an older run, before the last save)
    saved_before(home, -60)
    assignment = load_assignment(processes.ROOT / "lab/course/hello_time/assignment.yaml")
    asked: list[tuple[str, str]] = []

    def saw(condition: str, name: str) -> bool:
        asked.append((condition, name))
        return True

    ros = {"ROS_DISTRO": "jazzy", "AMENT_PREFIX_PATH": "/opt/ros/jazzy"}  # (nothing is sourced)
    state = StudentState(home / "ros2_ws", assignment, ros, saw=saw, had_seen=saw)
    *_, run, watch = next_actions(state, LESSON.steps)
    assert run is None
    assert watch is not None and watch.next.startswith("check ")
    assert "/my_first_node is running" in watch.found
    assert set(asked) == {("node_on_graph", "/my_first_node")}


def test_a_node_that_ctrl_z_has_stopped_is_named(tmp_path: Path) -> None:
    home = home_in(tmp_path, lambda workspace: None)
    program = home / "ros2_ws" / EXECUTABLE
    program.write_text("import time\nprint(1, flush=True)\ntime.sleep(600)\n", encoding="utf-8")
    with subprocess.Popen([sys.executable, program], stdout=subprocess.PIPE) as node:
        try:
            assert node.stdout is not None
            node.stdout.readline()
            assert "Ctrl+Z" not in guide(home)
            node.send_signal(signal.SIGSTOP)
            os.waitid(os.P_PID, node.pid, os.WSTOPPED)
            assert "stopped with Ctrl+Z" in (said := guide(home))
            assert "Next: fg" in said
        finally:
            node.kill()


@pytest.mark.parametrize("folder", ["src", OWN])
def test_a_build_in_a_wrong_folder_is_named_beside_a_good_one(folder: str, tmp_path: Path) -> None:
    home = home_in(tmp_path, lambda workspace: None)
    for name in ("build", "install"):
        (home / "ros2_ws" / folder / name).mkdir()
    said = guide(home)
    assert f"you built in ~/ros2_ws/{folder}" in said
    assert f"Next: cd ~/ros2_ws/{folder} && rm -r build install" in said


@pytest.mark.full
def test_the_lab_knows_how_a_run_ended(ros_jazzy: Ros) -> None:
    del ros_jazzy
    with open_to_all() as folder, Lab(Kind("bubblewrap"), workspace := folder / "ws") as opened:
        opened.type("cd ~/ros2_ws/src && ros2 pkg create --build-type ament_python " + PACKAGE)
        for file in (*SOLUTION.glob("*.*"), *(SOLUTION / PACKAGE).glob("*.py")):
            text = file.read_text(encoding="utf-8").replace("self.counter_ += 1", "[][1]")
            (workspace / OWN / file.relative_to(SOLUTION)).write_text(text, encoding="utf-8")
        (workspace / NODE).chmod(0o755)
        opened.type("cd ~/ros2_ws && colcon build --symlink-install; . install/local_setup.bash")
        assert "IndexError" in opened.type(RUN)
        assert "\t1\tros2 run" in (workspace / ".lab/ran").read_text()
        opened.type(f"{RUN} 2>&1 | cat")
        assert "\t1\tros2 run" in (workspace / ".lab/ran").read_text()
        assert f"{INNER}/my_first_node.py" in opened.type("code ~/ros2_ws")
        assert "You are in the lab." in opened.type("cd; make lab")


@pytest.mark.full
def test_files_of_another_user_are_named(tmp_path: Path) -> None:
    if os.getuid() != 0:
        pytest.skip("only root can give files away")
    with open_to_all() as folder:
        home = home_in(folder, lambda workspace: None)
        line = processes.as_user([sys.executable, "-m", "lab.guide"])
        done = processes.run(line, env=environment(home), cwd=processes.ROOT)
        assert "belongs to another user" in done.stdout, done.stderr
        assert "sudo chown -R" in done.stdout


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("setup.py을(를) 고치십시오", "setup.py를 고치십시오"),
        ("package.xml이(가) 없습니다", "package.xml이 없습니다"),
        ("'main'와(과) '노드'은(는)", "'main'과 '노드'는"),
        ("서울(으)로, 이름(으)로", "서울로, 이름으로"),
        ("3을(를) (이것)", "3을 (이것)"),
    ],
)
def test_a_korean_text_has_one_form_of_a_particle(text: str, said: str) -> None:
    assert with_particles(text) == said


@pytest.mark.parametrize(
    ("pattern", "said"),
    [
        ("^Turning$", "'Turning'"),
        ("Turn", "…Turn…"),
        (r"^x: -?\d+\.\d+$", "'x: <number>'"),
        ("^Got .*$", "'Got …'"),
        (r"^speed 2\.0+$", "a text such as 'speed 2.0'"),
        ("^Alarm (on|off)$", "a text such as 'Alarm on'"),
        (r"^[A-Z]{2}-?\d$", "a text such as 'AA1'"),
        (r"^[^a-z]\S+ \w*$", "a text such as '1a a'"),
    ],
)
def test_a_pattern_is_read_as_text(pattern: str, said: str) -> None:
    assert pattern_in_words(pattern) == said
