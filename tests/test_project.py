"""The project itself is an ament_python package: colcon builds it and its command works."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import grader
from grader import bootstrap
from tests import processes


@pytest.fixture(scope="module")
def overlay(jazzy_prefix: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A workspace with this project in src, built by colcon under the environment's Python."""
    workspace = tmp_path_factory.mktemp("ros2_ws")
    project = workspace / "src" / "ros2_teaching_lab"
    tracked = subprocess.run(
        ["git", "ls-files", "-z"], cwd=processes.ROOT, capture_output=True, text=True, check=True
    )
    for name in filter(None, tracked.stdout.split("\0")):
        if (processes.ROOT / name).is_file():
            (project / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(processes.ROOT / name, project / name)
    output = bash(jazzy_prefix, workspace, f"'{sys.executable}' -m colcon build 2>&1")
    assert "Summary: 1 package finished" in output, output
    return workspace


def bash(prefix: Path, workspace: Path, script: str) -> str:
    done = subprocess.run(
        ["bash", "-c", f'. "{prefix}/setup.bash"; cd "{workspace}"; {script}'],
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stdout + done.stderr


@pytest.mark.full
def test_the_command_runs_under_the_python_of_colcon(overlay: Path, jazzy_prefix: Path) -> None:
    script = overlay / "install/ros2_teaching_lab/lib/ros2_teaching_lab/grader"
    assert script.read_text().splitlines()[0] == f"#!{sys.executable}"
    output = bash(
        jazzy_prefix, overlay, ". install/local_setup.bash; ros2 run ros2_teaching_lab grader -V"
    )
    assert grader.__version__ in output


@pytest.mark.full
def test_run_time_data_files_are_installed(overlay: Path, jazzy_prefix: Path) -> None:
    """The installed copy, not this checkout, marks the solution, including its data files."""
    share = overlay / "install/ros2_teaching_lab/share/ros2_teaching_lab"
    assert (share / "course/hello_time/assignment.yaml").is_file()
    solution = processes.ROOT / "grader/keys/hello_time/solution/my_robot_controller"
    output = bash(
        jazzy_prefix,
        overlay,
        f". install/local_setup.bash; ros2 run ros2_teaching_lab grader grade '{solution}' "
        "--out out; echo status $?",
    )
    assert "status 0" in output, output
    assert "100 / 100" in output


def test_a_student_does_not_get_the_keys() -> None:
    names = [p.relative_to(processes.ROOT / "lab") for p in (processes.ROOT / "lab").rglob("*")]
    assert not [name for name in names if "solution" in name.parts or "hidden.yaml" in name.parts]


def test_the_readme_names_only_targets_that_exist() -> None:
    makefile = (processes.ROOT / "Makefile").read_text()
    targets = set(re.findall(r"^([a-z-]+):", makefile, re.MULTILINE))
    named = set(re.findall(r"`?make ([a-z-]+)", (processes.ROOT / "README.md").read_text()))
    assert named - {"turns"} <= targets


def test_the_readme_links_to_files_that_exist() -> None:
    links = re.findall(r"\]\(([^)#]+)\)", (processes.ROOT / "README.md").read_text())
    assert links
    for link in links:
        assert (processes.ROOT / link).exists(), link


def test_the_versions_agree() -> None:
    manifest = (processes.ROOT / "package.xml").read_text()
    setup = (processes.ROOT / "setup.py").read_text()
    assert f"<version>{grader.__version__}</version>" in manifest
    assert f'version="{grader.__version__}"' in setup


def test_the_lock_files_list_everything_that_is_needed() -> None:
    """The environment is made without dependencies that they do not list (bootstrap.py)."""
    done = processes.run([sys.executable, "-m", "pip", "check"])
    assert done.returncode == 0, done.stdout
    for lock in ("grader/requirements.txt", "tests/requirements.txt"):
        listed = bootstrap.requirements(str(processes.ROOT / lock))
        names = [package.partition("==")[0] for package in listed]
        assert {"pip", "click", "rich"} <= set(names)
        for first, *hashes in (package.splitlines() for package in listed):
            assert "==" in first
            assert hashes
            assert all(line.strip().startswith("--hash=sha256:") for line in hashes), first


def test_grader_never_imports_lab() -> None:
    for source in (processes.ROOT / "grader").rglob("*.py"):
        assert not re.search(r"^\s*(from|import) lab\b", source.read_text(), re.MULTILINE), source


@pytest.mark.parametrize(
    ("recipe", "module"),
    [("wheels.Dockerfile", "grader.ros.wheels_tree"), ("Dockerfile", "grader.ros.prefix_code")],
)
def test_the_images_recipes_copy_all_modules_that_make_a_prefix(
    recipe: str, module: str, tmp_path: Path
) -> None:
    text = (processes.ROOT / "docker" / recipe).read_text().replace("\\\n", " ")
    for line in re.findall(r"^COPY (grader/.*)$", text, re.MULTILINE):
        *sources, folder = line.split()
        into = tmp_path / folder
        for source in (processes.ROOT / name for name in sources):
            if source.is_dir():
                shutil.copytree(source, into)
            else:
                into.mkdir(parents=True, exist_ok=True)
                shutil.copy(source, into)
    command = [sys.executable, "-c", f"import {module}; print({module}.__file__)"]
    done = processes.run(command, cwd=tmp_path, env={"PYTHONPATH": str(tmp_path)})
    assert done.returncode == 0, done.stderr
    assert str(tmp_path) in done.stdout


def test_all_printing_goes_through_the_gate() -> None:
    """See grader.base.gate; styled output uses a console that is a gate as well."""
    ways = (
        r"^from rich.*\bConsole\b",  # (an indented one is for types)
        r"(?<!class )\bConsole\(",
        r"sys\.__std",
        r"os\.write\([12]",
        r"\.stdout\.buffer",
    )
    own = {
        "grader/base/gated_console.py",
        "lab/supervisor.py",  # it speaks to a program
        "grader/ros/ros2_command/run.py",  # its line is the real command's
    }
    found = {
        path.relative_to(processes.ROOT).as_posix()
        for folder in ("grader", "lab")
        for path in (processes.ROOT / folder).rglob("*.py")
        if any(re.search(way, path.read_text(encoding="utf-8"), re.MULTILINE) for way in ways)
    }
    assert found <= own
