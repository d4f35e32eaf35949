"""The commands of the `lab` program in the lab, on a workspace without ROS."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pexpect
import pytest

from grader.course.load import load_assignment
from grader.verdict.take_in import take_in_for
from lab.guide.progress import keep_progress, read_progress
from tests import processes
from tests.lab.wrong_states import NODE, OWN, SETUP, WRONG, Wrong, edit, make

COURSE = processes.ROOT / "lab/course/hello_time"
ASSIGNMENT = load_assignment(COURSE / "assignment.yaml")
READY = "not built since the entry was added"


def environment(home: Path, **more: str) -> dict[str, str]:
    own = {"HOME": str(home), "PYTHONPATH": str(processes.ROOT), "GRADER_ASSIGNMENT": "hello_time"}
    ros = {"ROS_DISTRO": "jazzy", "AMENT_PREFIX_PATH": "/opt/ros/jazzy", "LANG": "C.UTF-8"}
    return {"PATH": os.environ["PATH"], "TERM": "dumb", **ros, **own, **more}


def lab(home: Path, *words: str, **more: str) -> subprocess.CompletedProcess[str]:
    line = [sys.executable, "-m", "lab.commands", *words]
    return processes.run(line, env=environment(home, **more), cwd=home)


@pytest.fixture
def home(tmp_path: Path) -> Path:
    make(tmp_path, WRONG[READY])
    return tmp_path


def in_state(tmp_path: Path, wrong: Wrong) -> Path:
    make(tmp_path, wrong)
    return tmp_path


def test_hints_go_from_the_reason_to_the_line(tmp_path: Path) -> None:
    home = in_state(tmp_path, WRONG["the executable is called testnode"])
    line = "test_node = my_robot_controller.my_first_node:main"
    said = [lab(home, "hint").stdout for _ in range(4)]
    assert "line 25" in said[0]
    assert line not in said[0]
    assert "Hint 1 of 3" in said[0]
    assert "Hint 2" not in said[0]
    assert "src/my_robot_controller/setup.py, line 25" in said[1]
    assert line not in said[1]
    assert line in said[2]
    assert said[2:] == [said[2]] * 2  # nothing more to say
    kept = read_progress(home / "ros2_ws").of("hello_time")
    assert kept.hints == {"setup.other_executable": 3}


def test_the_archive_is_named_with_the_time_of_the_students_clock(home: Path) -> None:
    made = "submit/hello_time.zip 2026-11-29T23:30:15+00:00"
    keep_progress(home / "ros2_ws", "hello_time", submitted=made)
    line = [sys.executable, "-m", "lab.commands", "status"]
    env = environment(home, TZ="KST-9")  # (a forked process has the time zone of its parent)
    said = processes.run(line, env=env, cwd=home, forked=False).stdout
    assert "Archive: ~/ros2_ws/submit/hello_time.zip, made on 2026-11-30 at 08:30\n" in said


def test_the_last_hint_is_the_line_to_write(tmp_path: Path) -> None:
    home = in_state(tmp_path, WRONG["no timer"])
    for _ in range(3):
        said = lab(home, "hint").stdout
    assert "self.create_timer(1.0, self.callback)" in said


def test_the_archive_is_what_the_grader_takes_in(home: Path) -> None:
    workspace = home / "ros2_ws"
    for name in ("build", "install", "log"):
        (workspace / name).mkdir(exist_ok=True)
        (workspace / name / "COLCON_IGNORE").touch()
    first = lab(home, "submit")
    assert first.returncode == 0, first.stderr
    file = workspace / "submit/hello_time.zip"
    assert str(file) in first.stdout
    with zipfile.ZipFile(file) as archive:
        names = archive.namelist()
        mode = archive.getinfo(f"my_robot_controller/{NODE.removeprefix(OWN + '/')}").external_attr
    assert all(name.startswith("my_robot_controller/") for name in names)
    assert mode >> 16 & 0o111 == 0o111
    taken = take_in_for(ASSIGNMENT, file)
    assert (taken.modes, taken.root) == ("recorded", "my_robot_controller")
    before = file.read_bytes()
    assert lab(home, "submit").returncode == 0
    assert file.read_bytes() == before  # and an archive in the workspace does not disturb
    assert take_in_for(ASSIGNMENT, workspace).root == OWN


def test_nothing_to_hand_in_is_said(tmp_path: Path) -> None:
    (tmp_path / "ros2_ws/src").mkdir(parents=True)
    done = lab(tmp_path, "submit")
    assert done.returncode == 2
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "ros2_ws/submit").exists()


def test_a_reset_asks_first_and_keeps_what_it_moves(home: Path) -> None:
    workspace = home / "ros2_ws"
    text = (workspace / NODE).read_text()
    asked = lab(home, "reset", "6")
    assert (asked.returncode, (workspace / NODE).read_text()) == (1, text)
    assert "--yes" in asked.stdout
    done = lab(home, "reset", "6", "--yes")
    assert done.returncode == 0, done.stderr
    assert not (workspace / NODE).exists()
    (kept,) = (workspace / ".lab/backups").glob(f"*/{NODE}")
    assert kept.read_text() == text
    assert lab(home, "reset", "99").returncode == 2


def test_a_reset_of_the_entry_point_removes_only_the_entry(home: Path) -> None:
    workspace = home / "ros2_ws"
    before = (workspace / SETUP).read_text()
    assert lab(home, "reset", "7", "--yes").returncode == 0
    after = (workspace / SETUP).read_text()
    gone = set(before.splitlines()) - set(after.splitlines())
    assert [line.strip()[:11] for line in gone] == ["'test_node "]
    (kept,) = (workspace / ".lab/backups").glob(f"*/{SETUP}")
    assert kept.read_text() == before


def test_the_archive_has_the_name_that_the_instructor_wants(home: Path) -> None:
    file = home / "assignment.yaml"
    text = (COURSE / "assignment.yaml").read_text(encoding="utf-8")
    file.write_text(f'{text}\narchive: "{{student}}_hello.zip"\n', encoding="utf-8")
    (home / "lesson.md").write_bytes((COURSE / "lesson.md").read_bytes())

    def submit(*words: str) -> subprocess.CompletedProcess[str]:
        return lab(home, "submit", *words, GRADER_ASSIGNMENT=str(file))

    done = submit()
    assert (done.returncode, done.stdout) == (2, "")
    assert "your instructor wants your name" in done.stderr
    assert "lab submit --name" in done.stderr
    done = submit("--name", "../ada")
    assert done.returncode == 2
    assert "not ../ada" in done.stderr
    assert not (home / "ros2_ws/submit").exists()
    for words in (("--name", "Ada-L."), ()):  # the second time it is known
        done = submit(*words)
        assert (done.returncode, done.stderr) == (0, "")
        assert "submit/Ada-L._hello.zip" in done.stdout
    assert [file.name for file in (home / "ros2_ws/submit").iterdir()] == ["Ada-L._hello.zip"]


@pytest.mark.parametrize(
    ("change", "env", "text"),
    [
        ("", {"AMENT_PREFIX_PATH": ""}, "ROS is not sourced"),
        ("", {"AMENT_PREFIX_PATH": "/opt/ros/jazzy:OVERLAY"}, "ROS comes before your workspace"),
        ("", {"AMENT_PREFIX_PATH": "/gone:OVERLAY:/opt/ros/jazzy"}, "a folder that is gone"),
        ("", {"ROS_DOMAIN_ID": "a"}, "ROS_DOMAIN_ID is 'a'"),
        ("", {"RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp"}, "rmw_cyclonedds_cpp"),
        ("built in src", {}, "you built in ~/ros2_ws/src"),
        ("built by copying, then changed", {}, "older copy of my_first_node.py"),
        ("the package is in src/src", {}, "a workspace in the workspace"),
    ],
)
def test_the_doctor_finds_it(change: str, env: dict[str, str], text: str, tmp_path: Path) -> None:
    home = in_state(tmp_path, WRONG[change or READY])
    overlay = str(home / "ros2_ws/install/my_robot_controller")
    given = {name: value.replace("OVERLAY", overlay) for name, value in env.items()}
    done = lab(home, "doctor", **given)
    assert done.returncode == 1
    wrong = [line for line in done.stdout.splitlines() if line.startswith("wrong")]
    assert any(text in line for line in wrong), done.stdout
    assert "→" in done.stdout


def test_the_doctor_is_content_with_a_right_terminal(home: Path) -> None:
    install = home / "ros2_ws/install/my_robot_controller"
    (install / "lib/my_robot_controller").mkdir(parents=True)
    (install / "lib/my_robot_controller/test_node").touch()
    done = lab(home, "doctor", AMENT_PREFIX_PATH=f"{install}:/opt/ros/jazzy")
    assert (done.returncode, "wrong" in done.stdout) == (0, False), done.stdout


def test_a_step_that_is_done_is_said_once(tmp_path: Path) -> None:
    workspace = make(tmp_path, WRONG["the file is empty"])
    assert "Next: 6." in lab(tmp_path, "notice").stdout
    assert lab(tmp_path, "notice").stdout == ""
    solution = processes.ROOT / "grader/keys/hello_time/solution" / NODE.removeprefix("src/")
    (workspace / NODE).write_bytes(solution.read_bytes())
    said = lab(tmp_path, "notice").stdout
    assert "Done: 6. Write the node" in said
    assert "Next: 8." in said
    assert lab(tmp_path, "notice").stdout == ""


def test_progress_of_a_newer_version_is_kept(tmp_path: Path) -> None:
    (tmp_path / ".lab").mkdir()
    newer = {"schema": 2, "badge": "gold", "lessons": {"hello_time": {"stars": 3}, "other": {}}}
    (tmp_path / ".lab/progress.json").write_text(json.dumps(newer))
    keep_progress(tmp_path, "hello_time", passed=True)
    kept = json.loads((tmp_path / ".lab/progress.json").read_text())
    assert (kept["schema"], kept["badge"]) == (2, "gold")
    assert kept["lessons"]["hello_time"]["stars"] == 3
    assert kept["lessons"]["hello_time"]["passed"]


@pytest.mark.parametrize(
    "text", ["", "{", "[]", '{"lessons": 3}', "\0", '{"lessons": {"a": {"score": "x"}}}']
)
def test_progress_that_cannot_be_read_is_set_aside(text: str, tmp_path: Path) -> None:
    (tmp_path / ".lab").mkdir()
    (tmp_path / ".lab/progress.json").write_text(text)
    assert read_progress(tmp_path).lessons == {}
    keep_progress(tmp_path, "hello_time", score=5)
    assert read_progress(tmp_path).of("hello_time").score == 5
    assert (tmp_path / ".lab/progress.json.unreadable").read_text() == text


def test_progress_survives_a_kill_at_any_moment(tmp_path: Path) -> None:
    """A writer is killed twenty times, each time a little later."""
    code = (
        "import sys; from pathlib import Path; from lab.guide.progress import keep_progress\n"
        "n = 0\n"
        "while True:\n"
        "    n += 1; keep_progress(Path(sys.argv[1]), 'hello_time', score=n); print(n, flush=True)\n"
    )
    for moment in range(20):
        writer = subprocess.Popen(
            [sys.executable, "-c", code, str(tmp_path)],
            env={**os.environ, "PYTHONPATH": str(processes.ROOT)},
            stdout=subprocess.PIPE,
            text=True,
        )
        assert writer.stdout is not None
        last = 0
        for _ in range(moment + 1):
            last = int(writer.stdout.readline())
        writer.send_signal(signal.SIGKILL)
        rest = writer.stdout.read().split()
        writer.wait()
        told = int(rest[-1]) if rest else last
        assert read_progress(tmp_path).of("hello_time").score in (told, told + 1)


class Watch:
    """`lab watch` on a pseudo-terminal."""

    def __init__(self, home: Path, **more: str) -> None:
        self.screen = pexpect.spawn(
            sys.executable,
            ["-m", "lab.commands"],
            env=environment(home, **more),
            cwd=str(home),
            encoding="utf-8",
            timeout=30,
            dimensions=(50, 100),
        )
        self.shows("q quit")

    def shows(self, text: str) -> str:
        self.screen.expect_exact(text)
        return str(self.screen.before)

    def press(self, key: str) -> None:
        self.screen.send(key)


@pytest.fixture
def watch(tmp_path: Path) -> Iterator[Watch]:
    make(tmp_path, WRONG["the file is empty"])
    found = Watch(tmp_path)
    yield found
    found.screen.close(force=True)


def test_a_saved_file_is_noticed(watch: Watch, tmp_path: Path) -> None:
    solution = processes.ROOT / "grader/keys/hello_time/solution" / NODE.removeprefix("src/")
    (tmp_path / "ros2_ws" / NODE).write_bytes(solution.read_bytes())
    watch.shows("Done: 6. Write the node")
    watch.shows("Step 8 of 10")
    edit(tmp_path / "ros2_ws", SETUP, "console_scripts", "console_script")
    watch.shows("Found: the group is called 'console_script'")
    watch.press("d")
    watch.shows("console_scripts")
    watch.press("q")
    watch.screen.expect(pexpect.EOF)


def test_a_change_before_the_watch_runs_is_noticed(tmp_path: Path) -> None:
    code = (
        "import sys; from pathlib import Path; from lab.commands.events import events\n"
        "with events(Path(sys.argv[1]), tick=3600) as stream:\n"
        "    Path(sys.argv[1], 'saved').touch()\n"
        "    print(next(iter(stream)))\n"
    )
    screen = pexpect.spawn(
        sys.executable, ["-c", code, str(tmp_path)], cwd=processes.ROOT, timeout=30
    )
    screen.expect_exact("changed")
    screen.expect(pexpect.EOF)


def test_the_keys_do_what_the_last_line_says(watch: Watch) -> None:
    watch.press("n")
    watch.shows("Step 7 of 10")
    watch.press("l")
    watch.shows("[>]  6. Write the node")
    watch.press("h")
    watch.shows("Next: Write the node in my_first_node.py.")
    watch.press("x")  # no key of ours
    watch.screen.sendintr()
    watch.screen.expect(pexpect.EOF)
    watch.screen.close()
    assert watch.screen.exitstatus == 130


def test_what_a_terminal_has_sourced_is_noticed(watch: Watch, tmp_path: Path) -> None:
    (tmp_path / "ros2_ws/.lab").mkdir()
    (tmp_path / "ros2_ws/.lab/terminal").write_text("\n")
    watch.shows("Step 1 of 10")
    (tmp_path / "ros2_ws/.lab/terminal").write_text("/opt/ros/jazzy\n")
    watch.shows("Step 6 of 10")


def test_without_a_terminal_it_prints_the_step_once(home: Path) -> None:
    done = lab(home, "watch")
    assert done.returncode == 0
    assert done.stdout.startswith("Step 8 of 10")
    assert "\x1b" not in done.stdout
    assert "q quit" not in done.stdout


def test_a_plain_screen_is_never_cleared(tmp_path: Path) -> None:
    make(tmp_path, WRONG["the file is empty"])
    for term, cleared in (("xterm-256color", True), ("dumb", False)):
        watch = Watch(tmp_path, TERM=term)
        watch.press("n")
        said = watch.shows("q quit")
        watch.screen.close(force=True)
        assert ("\x1b[2J" in said) == cleared


def test_every_text_is_there_in_korean(home: Path) -> None:
    for words in (("status",), ("doctor",), ("hint",), ("--help",), ("reset", "6")):
        said = lab(home, *words, GRADER_LANG="ko").stdout
        assert re.search("[가-힣]", said), words


def test_the_lab_goes_on_with_the_next_lesson_after_full_marks(home: Path) -> None:
    opened = {"LAB_LESSON_FILE": str(home / "ros2_ws/.lab/lesson")}
    too_early = lab(home, "next", **opened)
    assert too_early.returncode == 2
    assert "full marks" in too_early.stderr
    keep_progress(home / "ros2_ws", "hello_time", passed=True)
    done = lab(home, "next", **opened)
    assert done.returncode == 0, done.stderr
    assert "The lesson is now: A publisher: draw a circle." in done.stdout
    assert "geometry_msgs" in done.stdout  # (its first step that is left)
    assert "draw_circle" in lab(home, "file", **opened).stdout  # every command of the lab
    assert "my_first_node" in lab(home, "file").stdout  # (not of a lab for one lesson)


def test_a_lab_without_what_the_next_lesson_needs_is_not_gone_on_with(
    home: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    course = tmp_path_factory.mktemp("course")
    for name in ("hello_time", "start_stop"):
        shutil.copytree(COURSE.parent / name, course / name)
    (course / "course.yaml").write_text("schema: 1\nlessons: [hello_time, start_stop]\n")
    other = course / "start_stop" / "assignment.yaml"
    text = other.read_text(encoding="utf-8")
    other.write_text(text.replace("std_srvs/srv/SetBool", "example_interfaces/srv/SetBool"))
    own = {"GRADER_COURSE": str(course), "LAB_LESSON_FILE": str(home / "ros2_ws/.lab/lesson")}
    keep_progress(home / "ros2_ws", "hello_time", passed=True)
    stays = lab(home, "next", **own)
    assert stays.returncode == 2
    assert "this lab has no example_interfaces" in stays.stderr
    assert "make lab LESSON=start_stop" in stays.stderr
    assert "my_first_node" in lab(home, "file", **own).stdout
    other.write_text(text, encoding="utf-8")
    assert lab(home, "next", **own).returncode == 0


def test_a_lab_for_one_lesson_and_the_last_one_say_that_none_follows(home: Path) -> None:
    keep_progress(home / "ros2_ws", "hello_time", passed=True)
    alone = lab(home, "next")
    assert alone.returncode == 2
    assert "The next lesson: exit, then make lab." in alone.stderr
    keep_progress(home / "ros2_ws", "own_message", passed=True)
    file = str(home / "ros2_ws/.lab/lesson")
    last = {"LAB_LESSON_FILE": file, "GRADER_ASSIGNMENT": "own_message"}
    done = lab(home, "next", **last)
    assert done.returncode == 2
    assert "make lab" not in done.stderr
