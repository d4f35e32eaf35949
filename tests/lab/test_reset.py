"""`lab reset` of each step of each lesson: what it keeps is no package for anything that looks for one."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from grader.base.errors import UsageError
from grader.ros.prefix import Ros
from grader.verdict.take_in import take_in_for
from lab.commands.reset import reset
from lab.commands.submit import write_archive
from lab.guide.opened import OpenedLab, opened_lab
from tests import processes

COURSE = processes.ROOT / "lab/course"
KEYS = processes.ROOT / "grader/keys"
LESSONS = sorted(path.parent.name for path in COURSE.glob("*/assignment.yaml"))
TERMINAL = {"AMENT_PREFIX_PATH": "/opt/ros/jazzy", "ROS_DISTRO": "jazzy"}


def opened(home: Path, lesson: str, monkeypatch: pytest.MonkeyPatch) -> OpenedLab:
    """Return a lab with the lesson's solution in it, built."""
    monkeypatch.setenv("HOME", str(home))
    monkeypatch.setenv("GRADER_ASSIGNMENT", lesson)
    workspace = home / "ros2_ws"
    shutil.copytree(KEYS / lesson / "solution", workspace / "src")
    for name in ("build", "install", "log"):
        (workspace / name).mkdir()
        (workspace / name / "COLCON_IGNORE").touch()
    (workspace / ".lab").mkdir()
    return opened_lab()


def packages(lab: OpenedLab) -> set[str]:
    """Return the folders of the packages that intake finds, relative to the workspace."""
    return {one.path for one in take_in_for(lab.assignment, lab.workspace).candidates}


def in_src(lab: OpenedLab) -> set[str]:
    return {f"src/{path.parent.name}" for path in lab.workspace.glob("src/*/package.xml")}


def texts(lab: OpenedLab) -> Iterator[str]:
    """Yield what guide and submit tell the student."""
    action = lab.task(TERMINAL).action
    if action is not None:
        yield from (action.next, action.found, *action.hints)
    try:
        write_archive(lab, "ada")
    except UsageError as error:
        yield from (error.message, error.remedy)


@pytest.mark.parametrize("lesson", LESSONS)
def test_backups_of_no_step_are_packages(
    lesson: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lab = opened(tmp_path, lesson, monkeypatch)
    before = take_in_for(lab.assignment, lab.workspace)
    write_archive(lab, "ada")
    moved = set()
    for step in lab.lesson.steps:
        reset.main([str(step.number), "--yes"], standalone_mode=False)
        assert packages(lab) == in_src(lab)
        assert ".lab" not in "".join(texts(lab))
        for backup in lab.workspace.glob(".lab/backups/*/*"):
            moved.add(step.done)
            if backup.name == "src":  # done again
                shutil.copytree(backup, lab.workspace / "src", dirs_exist_ok=True)
            else:
                backup.rename(lab.workspace / backup.name)
        assert take_in_for(lab.assignment, lab.workspace).sha256 == before.sha256
        file, packed = write_archive(lab, "ada")
        assert packed.left_out == ()
        assert take_in_for(lab.assignment, file).sha256 == before.sha256
        shutil.rmtree(lab.workspace / ".lab/backups", ignore_errors=True)
    assert moved >= {"package", "node_file", "node", "entry_point", "executable"}


def test_after_a_reset_the_package_is_created_again_although_it_was_handed_in(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lab = opened(tmp_path, "hello_time", monkeypatch)
    write_archive(lab)
    reset.main(["3", "--yes"], standalone_mode=False)
    action = lab.task(TERMINAL).action
    assert action is not None
    assert action.next.startswith("cd ~/ros2_ws/src && ros2 pkg create")
    assert action.found == ""
    assert take_in_for(lab.assignment, lab.workspace).root is None


def test_colcon_finds_no_backup(
    ros_jazzy: Ros, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lab = opened(tmp_path, "hello_time", monkeypatch)
    for step in ("7", "3"):
        reset.main([step, "--yes"], standalone_mode=False)
    assert len(list(lab.workspace.glob(".lab/backups/*/src/*/setup.py"))) == 2
    bases = f'"{lab.workspace}" "{lab.workspace}/.lab/backups"'
    script = f". {ros_jazzy.path}/setup.bash; colcon --log-base /dev/null list --base-paths {bases}"
    done = processes.run(["bash", "-c", script])
    assert (done.returncode, done.stdout) == (0, ""), done.stderr
