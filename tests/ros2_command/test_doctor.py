"""`ros2 doctor`, and the commands of the lab's shell that stand for programs it does not have."""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path

import pexpect
import pytest
from rich.cells import cell_len

from .surroundings import Surroundings, write_script

SHELL = Path(__file__).parents[2] / "lab" / "shell"


def test_all_is_well(jazzy: Surroundings) -> None:
    (jazzy.prefix / "setup.bash").touch()
    done = jazzy.ros2("doctor", "--report")
    assert (done.status, done.stderr) == (0, "")
    for fact in ("distro: jazzy", "middleware: rmw_fastrtps_cpp", "domain id: 0", "overlays: 1"):
        assert f"  {fact}\n" in done.stdout
    assert done.stdout.endswith("\nAll 6 checks passed\n")
    assert jazzy.ros2("doctor").stdout == "\nAll 6 checks passed\n"


@pytest.mark.parametrize("environment", [{}, {"ROS_DOMAIN_ID": "abc"}])
@pytest.mark.parametrize("options", [[], ["--report"], ["-iw"], ["--no"]])
def test_wtf_is_doctor(
    jazzy: Surroundings, environment: dict[str, str], options: list[str]
) -> None:
    """The real one has a class of its own for it, with this text."""
    doctor = jazzy.ros2("doctor", *options, environment=environment)
    assert jazzy.ros2("wtf", *options, environment=environment) == doctor
    assert "\nUse `wtf` as alias to `doctor`\n" in jazzy.ros2("wtf", "-h").stdout


@pytest.mark.parametrize(
    ("name", "value", "problem", "advice"),
    [
        ("AMENT_PREFIX_PATH", "", "No ROS environment is sourced", "source /opt/ros/jazzy/setup"),
        ("AMENT_PREFIX_PATH", "/gone", "names /gone, which does not exist", "Build the workspace"),
        ("RMW_IMPLEMENTATION", "rmw_cyclonedds_cpp", "only rmw_fastrtps_cpp is here", "unset"),
        ("ROS_DOMAIN_ID", "abc", "ROS_DOMAIN_ID is abc", "export ROS_DOMAIN_ID=0"),
        ("ROS_DOMAIN_ID", "150", "a number from 0 to 101", "export ROS_DOMAIN_ID=0"),
        ("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF", "nodes do not find each other", "=LOCALHOST"),
        ("ROS_AUTOMATIC_DISCOVERY_RANGE", "HERE", "DISCOVERY_RANGE is HERE", "=LOCALHOST"),
    ],
)
def test_a_problem_comes_with_its_remedy(
    jazzy: Surroundings, name: str, value: str, problem: str, advice: str
) -> None:
    done = jazzy.ros2("doctor", environment={name: value})
    assert (done.status, done.stdout) == (1, "\n1 problem found\n")
    assert problem in done.stderr.splitlines()[0]
    assert advice in done.stderr.splitlines()[1]


def test_an_underlay_before_the_overlay_is_found(jazzy: Surroundings) -> None:
    (jazzy.prefix / "setup.bash").touch()
    wrong = f"{jazzy.prefix}:{jazzy.overlay}"
    done = jazzy.ros2("doctor", environment={"AMENT_PREFIX_PATH": wrong})
    assert done.status == 1
    assert f"{jazzy.overlay} comes after ROS itself" in done.stderr


def test_a_setup_file_newer_than_the_build_is_found(jazzy: Surroundings) -> None:
    source = jazzy.root / "ws" / "src" / "my_robot_controller"
    built = jazzy.overlay / "share" / "colcon-core" / "packages" / "my_robot_controller"
    for file in (source / "setup.py", built):
        file.parent.mkdir(parents=True)
        file.touch()
    os.utime(source / "setup.py", (1_000, 1_000))
    assert jazzy.ros2("doctor").status == 0
    os.utime(built, (500, 500))
    done = jazzy.ros2("doctor")
    assert done.status == 1
    assert "src/my_robot_controller/setup.py was changed after the last build" in done.stderr
    assert "colcon build --packages-select my_robot_controller" in done.stderr


@pytest.mark.parametrize("language", ["en", "ko"])
@pytest.mark.parametrize(
    ("name", "instead"),
    [
        ("rviz2", "lab window"),
        ("rqt", "lab window"),
        ("rqt_graph", "lab window"),
        ("apt", "root"),
        ("apt-get", "root"),
    ],
)
def test_what_the_lab_does_not_have_is_said_in_one_line(
    tmp_path: Path, jazzy: Surroundings, language: str, name: str, instead: str
) -> None:
    shell = _shell(tmp_path / "lab")
    environment = {"PATH": str(shell / "bin"), "GRADER_LANG": language}
    done = jazzy.command("/bin/sh", str(shell / "bin" / name), "x", environment=environment)
    assert (done.status, done.stdout) == (127, "")
    assert done.stderr.startswith(name)
    assert instead in done.stderr
    assert done.stderr.count("\n") == 1
    real = write_script(tmp_path / "real" / name, "#!/bin/sh\necho real $#\n")
    environment["PATH"] = f"{shell / 'bin'}:{real.parent}"
    done = jazzy.command("/bin/sh", str(shell / "bin" / name), "a b", environment=environment)
    assert (done.status, done.stdout) == (0, "real 1\n")


@pytest.mark.parametrize("columns", [40, 80])
@pytest.mark.parametrize("language", ["en", "ko"])
@pytest.mark.parametrize("name", ["rqt", "code"])
def test_the_words_of_the_shell_are_whole_on_a_terminal(
    tmp_path: Path, jazzy: Surroundings, name: str, language: str, columns: int
) -> None:
    shell = _shell(tmp_path / "lab")
    command = ["/bin/sh", str(shell / "bin" / name)]
    environment = {
        "PATH": f"{shell / 'bin'}:/usr/bin:/bin",
        "GRADER_LANG": language,
        "LAB_WORKSPACE": "/home/ann/a_folder_that_is_longer_than/a_line/of_forty_columns",
    }
    done = jazzy.command(*command, environment=environment)
    screen: pexpect.spawn[str] = pexpect.spawn(
        command[0],
        command[1:],
        env={**jazzy.environment, **environment},
        dimensions=(24, columns),
        encoding="utf-8",
    )
    screen.expect(pexpect.EOF)
    lines = (screen.before or "").splitlines()
    assert " ".join(lines).split() == (done.stdout + done.stderr).split()
    too_long = [line for line in lines if cell_len(line) > columns]
    assert too_long == [line for line in too_long if line.startswith("    /home/ann/")]


@pytest.mark.parametrize("language", ["en", "ko"])
def test_what_the_shell_does_not_break_fits_a_terminal(language: str) -> None:
    text = (SHELL / "words" / f"{language}.sh").read_text(encoding="utf-8")
    indented = re.findall(r"(?:\\n|')(    .*?)(?:\\n|'$)", text, re.MULTILINE)
    assert len(indented) > 5
    assert [line for line in indented if cell_len(line) > 80] == []


def _shell(folder: Path) -> Path:
    """Copy the lab's shell files to a folder, and correct the path at which the lab has them."""
    shutil.copytree(SHELL, folder, ignore=shutil.ignore_patterns("__pycache__"))
    for file in folder.rglob("*"):
        if file.is_file():
            text = file.read_text().replace("/opt/ros2_teaching_lab/lab/shell", str(folder))
            file.write_text(text)
    return folder
