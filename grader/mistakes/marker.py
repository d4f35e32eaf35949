"""The catalogue: the marker in resource/."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import MARKER, SETUP, UNBUILT, example
from grader.mistakes.fixes import layout, setup_py
from grader.mistakes.kind import Kind
from grader.package.edit.tree import Delete, Move, Replace

MARKER_MISSING = msg(
    "ROS finds a package by an empty file with the package's name in the package index. setup.py "
    "copies it there from resource/ when you build. If it is missing, the build stops with: can't "
    "copy 'resource/{package}': doesn't exist or not a regular file."
)
OTHER_MARKER = msg(
    "ROS finds a package by an empty file with the package's name in the package index. The "
    "marker's name is the name that ROS uses for the package."
)


KINDS = (
    Kind(
        id="package.marker_missing",
        stage="marker",
        title=msg("The marker file in resource/ is missing"),
        why=MARKER_MISSING,
        whys={
            "line": msg(
                "ROS finds a package by an empty file with the package's name in the package "
                "index. setup.py has no line that copies it there when you build. colcon still "
                "adds a missing one itself, but warns that it will stop doing so."
            ),
            "rename_both": msg(
                "ROS finds a package by an empty file with the package's name in the package "
                "index. setup.py copies it there from resource/ when you build, but here it copies "
                "a file with another name."
            ),
            "other": OTHER_MARKER,
            "path": msg(
                "setup.py copies the marker file from the path in this line. A path is the folder, "
                "a / and the name of the file: + joins two texts without a / between them."
            ),
        },
        fix=msg(
            "Create the empty file, then build again. In the package's folder, run: "
            "mkdir -p resource && touch resource/{package}"
        ),
        fixes={
            "line": msg(
                "Add the marker's line to data_files in setup.py: "
                "('share/ament_index/resource_index/packages', ['resource/{package}']), and create "
                "the empty file, then build again. In the package's folder, run: "
                "mkdir -p resource && touch resource/{package}"
            ),
            "file": msg(
                "resource has to be a folder with the empty file in it. In the package's folder, run: "
                "rm resource && mkdir resource && touch resource/{package}. Then build again."
            ),
            "folder": msg(
                "Delete that folder and create an empty file with the same name. In the package's "
                "folder, run: rm -r resource/{package} && touch resource/{package}"
            ),
            "rename": msg(
                "Rename resource/{close} to resource/{package}: the two names must be the "
                "same. Then build again."
            ),
            "rename_both": msg(
                "Rename resource/{close} to resource/{package}, and let line {line} of setup.py "
                "install it by that name: ['resource/{package}']. Then build again."
            ),
            "other": msg(
                "Make that line install 'resource/{package}', then build again. If the name comes "
                "from a variable, correct the value of the variable."
            ),
            "path": msg("Write ['resource/{package}'] in that line, then build again."),
            "moved": msg("Rename the folder {close} to resource, then build again."),
            "inner": msg(
                "Move it out of the inner folder. In the package's folder, run: mv {there} ."
            ),
        },
        link=links.DEVELOPING,
        seen=r"can't copy '[^'\n]{0,300}resource/(?P<package>[^'/\n]{1,120})': doesn't exist",
        fixed_by=(
            layout.marker,
            setup_py.marker,
            setup_py.marker_and_line,
        ),
        examples=(
            example(
                "marker_without_slash_by_names",
                Replace(SETUP, "\nsetup(", "RESOURCE = 'resource'\nSHARE = 'share/'\n\nsetup("),
                Replace(
                    SETUP,
                    "('share/ament_index/resource_index/packages',\n            ['resource/' + package_name]),",
                    "(SHARE + 'ament_index/resource_index/packages', [RESOURCE + package_name]),",
                ),
                fails="package.marker",
                blocks=UNBUILT,
            ),
            example("marker_missing", Delete(MARKER), fails="package.marker", blocks=UNBUILT),
            example(
                "marker_and_its_line_missing",
                Delete("resource"),
                Replace(
                    SETUP,
                    (
                        "        ('share/ament_index/resource_index/packages',\n"
                        "            ['resource/' + package_name]),\n"
                    ),
                    "",
                ),
                fails="package.marker",
                note="colcon warns and makes one itself",
            ),
            example(
                "marker_with_ending_in_both",
                Move(MARKER, MARKER + ".txt"),
                Replace(SETUP, "'resource/' + package_name", "'resource/' + package_name + '.txt'"),
                fails="package.marker",
                note="colcon warns and makes the right one itself",
            ),
            example(
                "marker_line_with_ending",
                Replace(SETUP, "'resource/' + package_name", "'resource/' + package_name + '.txt'"),
                fails="package.marker",
                blocks=UNBUILT,
            ),
            example(
                "marker_without_slash",
                Replace(SETUP, "'resource/' + package_name", "'resource' + package_name"),
                fails="package.marker",
                blocks=UNBUILT,
            ),
            example(
                "marker_of_other_folder",
                Replace(SETUP, "'resource/' + package_name", "'ressource/' + package_name"),
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
                "marker_folder_missing",
                Delete("resource"),
                fails="package.marker",
                blocks=UNBUILT,
                note="git keeps no empty folders, and some tools drop empty files",
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
        whys={
            "other": OTHER_MARKER,
            "place": msg(
                "ROS finds a package by an empty file with the package's name in the package index. "
                "The index is the folder {wanted}: a file in another folder is not in it."
            ),
        },
        fix=msg(
            "Add to data_files: ('share/ament_index/resource_index/packages', "
            "['resource/{package}']),"
        ),
        fixes={
            "argument": msg(
                "Add to setup(): data_files=[('share/ament_index/resource_index/packages', "
                "['resource/{package}'])],"
            ),
            "other": msg(
                "Make that line install 'resource/{package}', then build again. If the name comes "
                "from a variable, correct the value of the variable."
            ),
            "place": msg("Write '{wanted}' instead of '{folder}' in that line, then build again."),
        },
        link=links.DEVELOPING,
        seen=r"(?:[Pp]ackage '(?P<package>\w{1,120})' )?doesn't explicitly install a marker in the package index",
        fixed_by=(setup_py.marker_place, setup_py.marker),
        examples=(
            example(
                "marker_in_misspelt_folder",
                Replace(
                    SETUP, "share/ament_index/resource_index", "share/ament_index/ressource_index"
                ),
                fails="package.marker",
                note="colcon warns and makes one itself",
            ),
            example(
                "marker_not_installed",
                Replace(
                    SETUP,
                    (
                        "        ('share/ament_index/resource_index/packages',\n"
                        "            ['resource/' + package_name]),\n"
                    ),
                    "",
                ),
                fails="package.marker",
                note="colcon warns and makes one itself",
            ),
        ),
    ),
)
