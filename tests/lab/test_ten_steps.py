"""The whole exercise, typed in the lab."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from grader.ros.prefix import Ros
from tests import processes
from tests.lab import ten_steps
from tests.lab.kinds import Kind, long_in_a_container
from tests.lab.screen import Lab
from tests.lab.workspaces import open_to_all


@long_in_a_container
@pytest.mark.full
def test_the_ten_steps_work_literally_and_a_second_lab_keeps_them(
    kind: Kind, tmp_path: Path
) -> None:
    workspace = tmp_path / "ros2_ws"
    with Lab(kind, workspace) as lab:
        ten_steps.follow(lab)
        output = lab.type("check")
        assert lab.status() == 0, output
        assert "100 / 100" in output
        (workspace / "src" / "my_robot_controller" / "setup.cfg").unlink()
        shown = lab.type("fix --no-run")
        assert lab.status() == 0, shown
        assert "+++ b/setup.cfg" in shown
        lab.type("fix --apply --no-run")
        assert lab.status() == 0
        assert (workspace / "src" / "my_robot_controller" / "setup.cfg").is_file()
        assert "lab.no_executable" in lab.type("echo No executable found | explain -")
        assert lab.leave() == 0
    student = os.geteuid() or 1000  # root's lab runs as the machine's first ordinary user
    assert ten_steps.owners(workspace) == {student}
    with Lab(kind, workspace) as lab:
        ten_steps.run_and_stop(lab, ten_steps.commands("jazzy")[9])
        assert lab.leave() == 0


@pytest.mark.long
def test_an_ordinary_user_can_do_the_steps_and_owns_the_files(ros_jazzy: Ros) -> None:
    with open_to_all() as folder:
        workspace = folder / "ros2_ws"
        with Lab(Kind("bubblewrap"), workspace, user=True) as lab:
            ten_steps.follow(lab)
            assert lab.leave() == 0
        assert ten_steps.owners(workspace) == {
            processes.USER if os.geteuid() == 0 else os.geteuid()
        }


@pytest.mark.long
def test_another_distro_has_another_lab_with_its_own_commands(
    ros_kilted: Ros, tmp_path: Path
) -> None:
    with Lab(Kind("bubblewrap"), tmp_path / "ros2_ws", distro="kilted") as lab:
        ten_steps.follow(lab, "kilted")
