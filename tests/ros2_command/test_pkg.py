"""What `ros2 pkg` does beyond the recordings."""

from __future__ import annotations

import compileall
from pathlib import Path
from xml.etree import ElementTree

import pytest

from .surroundings import Surroundings, add_marker, files, write_script

LICENSES = {
    "Apache-2.0": 11358,
    "BSL-1.0": 1338,
    "BSD-2.0": 1489,
    "BSD-2-Clause": 1245,
    "BSD-3-Clause": 1459,
    "GPL-3.0-only": 35149,
    "LGPL-3.0-only": 7652,
    "MIT": 1023,
    "MIT-0": 858,
}


def test_list_is_sorted_and_has_each_package_once(jazzy: Surroundings) -> None:
    add_marker(jazzy.prefix, "my_robot_controller")
    add_marker(jazzy.prefix, "ament_index_python")
    add_marker(jazzy.prefix, ".hidden")
    (jazzy.prefix / "share/ament_index/resource_index/packages/folder").mkdir()
    done = jazzy.ros2("pkg", "list")
    assert (done.status, done.stderr) == (0, "")
    assert done.stdout == "ament_index_python\nmy_robot_controller\nrclpy\n"


def test_executables_of_all_packages(jazzy: Surroundings) -> None:
    write_script(jazzy.prefix / "lib" / "rclpy" / "tool", "#!/bin/sh\n")
    done = jazzy.ros2("pkg", "executables")
    assert done.status == 0
    assert done.stdout.splitlines()[-1] == "rclpy tool"
    assert len(done.stdout.splitlines()) == 6


def test_files_without_exec_bit_or_in_hidden_folders_are_not_executables(
    jazzy: Surroundings,
) -> None:
    (jazzy.executables / "hang").chmod(0o644)
    write_script(jazzy.executables / ".x" / "hidden", "#!/bin/sh\n")
    write_script(jazzy.executables / "sub" / "tool", "#!/bin/sh\n")
    done = jazzy.ros2("pkg", "executables", "my_robot_controller")
    names = [line.split()[1] for line in done.stdout.splitlines()]
    assert names == ["tool", "term", "three", "wait", "zero"]


def test_prefix_share_of_an_unknown_package(jazzy: Surroundings) -> None:
    done = jazzy.ros2("pkg", "prefix", "--share", "nope")
    assert (done.status, done.stdout, done.stderr) == (1, "", "Package not found\n")


def test_xml_prints_the_manifest(jazzy: Surroundings) -> None:
    done = jazzy.ros2("pkg", "xml", "my_robot_controller")
    assert done.status == 0
    assert ElementTree.fromstring(done.stdout).findtext("name") == "my_robot_controller"


def test_xml_prints_each_element_with_the_tag(jazzy: Surroundings) -> None:
    done = jazzy.ros2("pkg", "xml", "my_robot_controller", "--tag", "depend")
    assert (done.status, done.stdout) == (0, "rclpy\nstd_msgs\n")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["nope"], "Package not found"),
        (["my_robot_controller", "-t", "nope"], "XML tag not found"),
        (["empty"], "Package XML manifest not found"),
    ],
)
def test_xml_says_what_is_missing(jazzy: Surroundings, arguments: list[str], message: str) -> None:
    add_marker(jazzy.prefix, "empty")
    (jazzy.prefix / "share" / "empty" / "package.xml").unlink()
    done = jazzy.ros2("pkg", "xml", *arguments)
    assert (done.status, done.stdout, done.stderr) == (1, "", message + "\n")


def test_without_a_build_type_an_ament_cmake_package_is_made(jazzy: Surroundings) -> None:
    done = jazzy.ros2("pkg", "create", "my_robot_controller")
    assert done.status == 0
    assert "build type: ament_cmake\n" in done.stdout
    assert (
        """\
creating source and include folder
creating folder ./my_robot_controller/src
creating folder ./my_robot_controller/include/my_robot_controller
creating ./my_robot_controller/CMakeLists.txt

[WARNING]: Unknown license"""
        in done.stdout
    )
    folder = jazzy.root / "my_robot_controller"
    assert list(files(folder)) == [
        "CMakeLists.txt",
        "include/",
        "include/my_robot_controller/",
        "package.xml",
        "src/",
    ]
    elements = files(folder)["package.xml"]["elements"]
    assert isinstance(elements, list)
    assert [element[2] for element in elements[5:]] == [
        "ament_cmake",
        "ament_lint_auto",
        "ament_lint_common",
        "",
        "ament_cmake",
    ]


@pytest.mark.parametrize("build_type", ["ament_cmake", "cmake"])
def test_cpp_node_and_library(jazzy: Surroundings, build_type: str) -> None:
    done = jazzy.ros2(
        *("pkg", "create", "p1", "--build-type", build_type, "--license", "MIT"),
        *("--node-name", "talker", "--library-name", "my_lib"),
    )
    assert done.status == 0
    assert "node_name: talker\nlibrary_name: my_lib\n" in done.stdout
    config = ["p1Config.cmake.in", "p1ConfigVersion.cmake.in"] if build_type == "cmake" else []
    assert [name for name in files(jazzy.root / "p1") if not name.endswith("/")] == [
        "CMakeLists.txt",
        "LICENSE",
        "include/p1/my_lib.hpp",
        "include/p1/visibility_control.h",
        *config,
        "package.xml",
        "src/my_lib.cpp",
        "src/talker.cpp",
    ]
    assert "class MyLib\n" in (jazzy.root / "p1/include/p1/my_lib.hpp").read_text()
    manifest = (jazzy.root / "p1/package.xml").read_text()
    assert ("<buildtool_depend>ament_cmake_ros<" in manifest) == (build_type == "ament_cmake")


def test_a_python_library_is_a_package_inside(jazzy: Surroundings) -> None:
    done = jazzy.ros2(
        "pkg", "create", "--build-type", "ament_python", "p1", "--library-name", "lib"
    )
    assert "creating folder ./p1/p1/lib\ncreating ./p1/p1/lib/__init__.py\n" in done.stdout


def test_the_generated_python_is_valid(jazzy: Surroundings) -> None:
    jazzy.ros2("pkg", "create", "--build-type", "ament_python", "p1", "--node-name", "n")
    assert compileall.compile_dir(jazzy.root / "p1", quiet=1)


def test_node_and_library_with_the_same_name(jazzy: Surroundings) -> None:
    done = jazzy.ros2(
        *("pkg", "create", "--build-type", "ament_python", "p1"),
        *("--node-name", "same", "--library-name", "same"),
    )
    assert done.status == 0
    assert done.stderr == (
        "[WARNING] node name can not be equal to the library name\n"
        "[WARNING] renaming node to same_node\n"
    )
    assert (jazzy.root / "p1/p1/same_node.py").is_file()


def test_package_format_2(jazzy: Surroundings) -> None:
    jazzy.ros2("pkg", "create", "--package_format", "2", "p1")
    text = (jazzy.root / "p1/package.xml").read_text()
    assert "schema/package_format2.xsd" in text
    assert '<package format="2">' in text


@pytest.mark.parametrize("identifier", LICENSES)
def test_every_listed_licence_has_a_text(jazzy: Surroundings, identifier: str) -> None:
    done = jazzy.ros2("pkg", "create", "p1", "--license", identifier)
    assert "WARNING" not in done.stdout
    path: Path = jazzy.root / "p1" / "LICENSE"
    assert path.stat().st_size == LICENSES[identifier]


def test_a_question_mark_lists_the_licences(jazzy: Surroundings) -> None:
    done = jazzy.ros2("pkg", "create", "p1", "--license", "?")
    assert (done.status, done.stdout) == (0, "\n".join(["Supported licenses:", *LICENSES, ""]))
    assert not (jazzy.root / "p1").exists()


def test_a_wrong_package_format_is_refused(jazzy: Surroundings) -> None:
    done = jazzy.ros2("pkg", "create", "--package-format", "4", "p1")
    assert done.status == 2
    assert done.stderr.endswith(
        "ros2 pkg create: error: argument --package-format/--package_format: invalid choice: 4 "
        "(choose from 2, 3)\n"
    )
