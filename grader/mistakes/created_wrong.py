"""The catalogue: a package that was created in a wrong place, or with a wrong build type."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import (
    CFG,
    INIT,
    INNER,
    MANIFEST,
    MARKER,
    NO_FILE,
    NODE,
    SETUP,
    UNBUILT,
    UNINSTALLED,
    example,
)
from grader.mistakes.fixes import inner_package
from grader.mistakes.kind import Kind
from grader.package.edit.tree import Copy, Delete, Move, Replace, Write

ENTRY_LINE = "            'test_node = my_robot_controller.my_first_node:main',\n"
WITHIN = f"{INNER}/{INNER}"
AGAIN = (
    Copy(SETUP, f"{WITHIN}/setup.py"),
    Copy(CFG, f"{WITHIN}/setup.cfg"),
    Copy(MANIFEST, f"{WITHIN}/package.xml"),
    Copy(MARKER, f"{WITHIN}/{MARKER}"),
    Copy(INIT, f"{WITHIN}/{INIT}"),
    Replace(SETUP, ENTRY_LINE, ""),
)
"""A second package of the same name in the inner folder, which has the entry point."""
CMAKE = (
    "cmake_minimum_required(VERSION 3.8)\n"
    "project(my_robot_controller)\n"
    "find_package(ament_cmake REQUIRED)\n"
    "ament_package()\n"
)
KINDS = (
    Kind(
        id="package.created_inside",
        stage="hand-in",
        title=msg("The package was created inside a package"),
        why=msg(
            "ros2 pkg create was run inside the package: {inner} is a second package of the same "
            "name. colcon stops at the outer package.xml and never builds the inner package."
        ),
        fix=msg(
            "Keep the outer package. In its folder: 1) move your code out of the inner one: "
            "mv {path} {wanted}; 2) add '{entry}', to console_scripts in the outer setup.py; "
            "3) delete the rest of the inner one: rm -r {extra}; 4) build again in the workspace."
        ),
        fixes={
            "has_entry": msg(
                "Keep the outer package. In its folder: 1) move your code out of the inner one: "
                "mv {path} {wanted}; 2) delete the rest of the inner one: rm -r {extra}; 3) build again in "
                "the workspace."
            ),
            "entry": msg(
                "Keep the outer package. In its folder: 1) add '{entry}', to console_scripts in "
                "the outer setup.py; 2) delete the rest of the inner one: rm -r {extra}; 3) build again in "
                "the workspace."
            ),
        },
        link=links.PACKAGE,
        fixed_by=(inner_package.taken_out,),
        examples=(
            example(
                "created_inside_itself",
                *AGAIN,
                Move(NODE, f"{WITHIN}/{NODE}"),
                fails="source.node_file",
                also={"entry_point.mapping": "setup.no_entry"},
                blocks=UNINSTALLED,
            ),
            example(
                "node_in_inner_package",
                *AGAIN,
                Move(NODE, f"{WITHIN}/{NODE}"),
                Replace(SETUP, "'console_scripts': [\n", f"'console_scripts': [\n{ENTRY_LINE}"),
                fails="source.node_file",
                blocks=("run.starts",),
            ),
        ),
    ),
    Kind(
        id="package.created_as_cmake",
        stage="manifest",
        title=msg("The package was created without --build-type ament_python"),
        why=msg(
            "Without --build-type ament_python, ros2 pkg create makes a C++ package with a "
            "CMakeLists.txt. colcon then runs CMake and never looks at setup.py or at the node. "
            "Files of a Python package, such as {missing}, are missing for the same reason."
        ),
        fix=msg(
            "Create the package again, in the folder above it: mv {package} ~/{package}_old, then "
            "ros2 pkg create --build-type ament_python {package} --dependencies rclpy. Copy "
            "{node_file}, if you have written it, into {package}/{package}, and add '{entry}', to console_scripts in the "
            "new setup.py."
        ),
        link=links.PACKAGE,
        examples=(
            example(
                "cmake_package",
                Delete(SETUP),
                Delete(CFG),
                Delete("resource"),
                Delete(INNER),
                Write("CMakeLists.txt", CMAKE),
                Replace(MANIFEST, "ament_python", "ament_cmake"),
                fails="package.manifest",
                also={
                    "package.marker": "package.marker_missing",
                    "package.setup_cfg": "package.setup_cfg_missing",
                    "source.node_file": "source.no_node_file",
                    "entry_point.mapping": "setup.missing",
                },
                blocks=(*NO_FILE, *UNBUILT),
                note="--build-type forgotten",
            ),
            example(
                "cmake_package_with_node",
                Delete(CFG),
                Delete("resource"),
                Write("CMakeLists.txt", CMAKE),
                Replace(MANIFEST, "ament_python", "ament_cmake"),
                fails="package.manifest",
                also={
                    "package.marker": "package.marker_missing",
                    "package.setup_cfg": "package.setup_cfg_missing",
                },
                blocks=UNBUILT,
                note="the node and setup.py were added by hand",
            ),
        ),
    ),
)
