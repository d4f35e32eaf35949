"""The environment that a run gets: that of `source install/local_setup.bash`, and nothing else."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from grader.course.load import load_assignment
from grader.ros.distro import find_distro
from grader.run.overlay import Fault, Overlay, read_overlay
from grader.run.workspace import build
from grader.sandbox.bubblewrap import Bubblewrap
from grader.sandbox.limits import Limits
from grader.sandbox.proof import proven_ros
from grader.verdict.take_in import take_in_for
from tests.processes import ROOT

SHARE = "install/robot/share/robot"
FILES = {
    "install/robot/share/colcon-core/packages/robot": "rclpy:messages",
    "install/messages/share/colcon-core/packages/messages": "",
    f"{SHARE}/package.dsv": "source;share/robot/hook/paths.dsv\nsource;share/robot/hook/paths.sh\n",
    f"{SHARE}/hook/paths.dsv": "prepend-non-duplicate;PYTHONPATH;lib/python3.12/site-packages\n"
    "prepend-non-duplicate;AMENT_PREFIX_PATH;\n",
    "install/messages/share/messages/package.dsv": "prepend-non-duplicate;AMENT_PREFIX_PATH;\n"
    "prepend-non-duplicate-if-exists;PATH;bin\n",
}


def of(texts: Mapping[str, str], *more: str) -> Overlay:
    return read_overlay(dict.fromkeys((*texts, *more), "f"), texts, workspace="/ws")


def test_the_package_that_needs_another_is_found_first() -> None:
    assert of(FILES).folders == {
        "AMENT_PREFIX_PATH": ["/ws/install/robot", "/ws/install/messages"],
        "PYTHONPATH": ["/ws/install/robot/lib/python3.12/site-packages"],
        "COLCON_PREFIX_PATH": ["/ws/install"],
    }
    assert of(FILES).faults == ()


def test_a_script_beside_its_data_is_not_sourced_one_alone_is_a_fault() -> None:
    alone = {**FILES, f"{SHARE}/package.dsv": "source;share/robot/hook/x.sh\n"}
    assert of(alone).faults == ()  # (it is not there)
    assert of(alone, f"{SHARE}/hook/x.sh").faults == (Fault("script", f"{SHARE}/hook/x.sh"),)


@pytest.mark.parametrize(
    "line",
    [
        "set;PYTHONSTARTUP;share/robot/x.py",
        "set-if-unset;LD_PRELOAD;lib/x.so",
        "prepend-non-duplicate;LD_PRELOAD;lib/x.so",
        "prepend-non-duplicate;PYTHONPATH;share/robot",
        "prepend-non-duplicate;PYTHONPATH;../../src/robot",
        "prepend-non-duplicate;PATH;/tmp/bin",
        "prepend-non-duplicate;AMENT_PREFIX_PATH;../messages",
        "run;rm -r ~",
        "no kind",
    ],
)
def test_a_line_that_colcon_does_not_make_is_a_fault(line: str) -> None:
    found = of({**FILES, f"{SHARE}/package.dsv": f"{line}\n"})
    assert [fault.kind for fault in found.faults] == ["variable"]
    assert line in found.faults[0].path
    assert "PYTHONSTARTUP" not in found.commands()


def test_the_folder_of_a_build_by_develop_is_taken_over() -> None:
    line = "prepend-non-duplicate;PYTHONPATH;/ws/build/robot\n"
    found = of({**FILES, f"{SHARE}/package.dsv": line}, "build/robot/robot/__init__.py")
    assert (found.folders["PYTHONPATH"], found.faults) == (["/ws/build/robot"], ())


@pytest.mark.parametrize(
    ("path", "hides"),
    [
        ("lib/python3.12/site-packages/sitecustomize.py", True),
        ("lib/python3.12/site-packages/argparse/__init__.py", True),
        ("lib/python3.12/site-packages/resource/marker", False),  # (without code it hides nothing)
        ("lib/python3.12/site-packages/robot/argparse.py", False),
        ("lib/python3.12/site-packages/test/__init__.py", False),  # find_packages() without exclude
        ("lib/robot/ros2", False),
    ],
)
def test_what_hides_a_module_is_a_fault(path: str, *, hides: bool) -> None:
    found = of(FILES, f"install/robot/{path}")
    assert found.faults == ((Fault("hides", f"install/robot/{path}"),) if hides else ())


def test_a_program_on_the_path_may_not_have_the_name_of_one_that_starts_the_node() -> None:
    bins = ("install/messages/bin", "install/messages/bin/talker")
    assert of(FILES, *bins).faults == ()
    found = of(FILES, *bins, "install/messages/bin/ros2")
    assert found.faults == (Fault("hides", "install/messages/bin/ros2"),)


def test_a_second_package_of_the_same_name_is_a_fault() -> None:
    markers = [
        f"install/{prefix}/share/ament_index/resource_index/packages/robot"
        for prefix in ("messages", "robot")
    ]
    assert of(FILES, markers[0]).faults == ()
    assert of(FILES, *markers).faults == (Fault("hides", markers[1]),)


def test_files_that_name_each_other_end() -> None:
    here = {f"{SHARE}/package.dsv": "source;share/robot/package.sh\n"}
    assert of({**FILES, **here}, f"{SHARE}/package.sh").faults != ()


LESSONS = [
    "hello_time",
    pytest.param("own_message", marks=pytest.mark.long),  # (it compiles for half a minute)
]


@pytest.mark.prefix
@pytest.mark.parametrize("lesson", LESSONS)
def test_it_is_the_environment_of_a_shell_that_sources_the_workspace(lesson: str) -> None:
    assignment = load_assignment(ROOT / "lab" / "course" / lesson / "assignment.yaml")
    submission = take_in_for(assignment, ROOT / "grader" / "keys" / lesson / "solution")
    ros = proven_ros(find_distro("jazzy"), interfaces=assignment.interfaces)
    with Bubblewrap(ros, Limits()) as sandbox:
        made = build(sandbox, submission, package=assignment.package)
        assert (made.status, made.faults) == (0, ())
        sourced = f'. "{sandbox.ros_path}/setup.bash"; . install/local_setup.bash; exec env -0'
        shown = [
            sandbox.run(["bash", "-c", script], seconds=20).output.decode()
            for script in (sourced, sandbox.in_workspace("env -0"))
        ]
    wanted, found = (dict(row.split("=", 1) for row in rows.split("\0") if row) for rows in shown)
    assert f"install/{assignment.package}" in wanted["AMENT_PREFIX_PATH"]
    differ = {k for k in wanted | found if wanted.get(k) != found.get(k)}
    assert differ <= {"_", "SHLVL", "COLCON_PREFIX_PATH"} and "COLCON_PREFIX_PATH" in found
