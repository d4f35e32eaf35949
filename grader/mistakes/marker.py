"""The catalogue: the marker in resource/."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import MARKER, SETUP, UNBUILT, example
from grader.mistakes.fixes import layout, setup_py
from grader.mistakes.kind import Kind
from grader.package.edit.tree import Delete, Move, Replace

LINE = (
    "        ('share/ament_index/resource_index/packages',\n"
    "            ['resource/' + package_name]),\n"
)
KINDS = (
    Kind(
        id="package.marker_missing",
        stage="marker",
        title=msg("The marker file in resource/ is missing"),
        why=msg(
            "ROS finds a package by an empty file with the package's name in the package index. setup.py "
            "copies it there from resource/ when you build. If data_files names a file that is missing, the "
            "build stops with: can't copy 'resource/{package}': doesn't exist or not a regular file."
        ),
        fix=msg(
            "Create the empty file, then build again. In the package's folder, run: "
            "mkdir -p resource && touch resource/{package}"
        ),
        fixes={
            "rename": msg(
                "In the package's folder, run: mkdir -p resource && mv {there} resource/{package}. If "
                "data_files in setup.py has another name for it, write resource/{package} there. Then "
                "build again."
            ),
            "replace": msg(
                "resource has to be a folder with the empty file {package} in it. In the package's folder, "
                "run: rm -r {there} && mkdir -p resource && touch resource/{package}. Then build again."
            ),
            "line": msg(
                "If the file resource/{package} is missing, create it: an empty one. Let data_files in "
                "setup.py have this line for it, then build again: "
                "('share/ament_index/resource_index/packages', ['resource/{package}']),"
            ),
        },
        link=links.DEVELOPING,
        seen=r"can't copy '[^'\n]{0,300}resource/(?P<package>[^'/\n]{1,120})': doesn't exist",
        fixed_by=(layout.marker, setup_py.marker),
        examples=(
            example("marker_missing", Delete(MARKER), fails="package.marker", blocks=UNBUILT),
            example(
                "marker_and_its_line_missing",
                Delete("resource"),
                Replace(SETUP, LINE, ""),
                fails="package.marker",
                note="colcon warns and makes one itself",
            ),
            example(
                "marker_without_slash",
                Replace(SETUP, "'resource/' + package_name", "'resource' + package_name"),
                fails="package.marker",
                blocks=UNBUILT,
            ),
            example(
                "resource_folder_misnamed",
                Move("resource", "resources"),
                fails="package.marker",
                blocks=UNBUILT,
            ),
            example(
                "marker_misnamed",
                Move(MARKER, "resource/my_robot_controler"),
                fails="package.marker",
                blocks=UNBUILT,
            ),
        ),
    ),
    Kind(
        id="package.marker_not_installed",
        stage="marker",
        title=msg("setup.py does not install the package's marker"),
        why=msg(
            "ROS finds a package by an empty file with the package's name in the package "
            "index. setup.py copies it there from resource/ when you build. colcon still adds "
            "a missing one itself, but warns that it will stop doing so."
        ),
        fix=msg(
            "Let data_files in setup.py have this line, in place of one that differs (if setup() has no "
            "data_files, write data_files=[ before and ], behind it). Then build again: "
            "('share/ament_index/resource_index/packages', ['resource/{package}']),"
        ),
        link=links.DEVELOPING,
        seen=r"(?:[Pp]ackage '(?P<package>\w{1,120})' )?doesn't explicitly install a marker in the package index",
        fixed_by=(setup_py.marker,),
        examples=(
            example(
                "marker_not_installed",
                Replace(SETUP, LINE, ""),
                fails="package.marker",
                note="colcon warns and makes one itself",
            ),
        ),
    ),
)
