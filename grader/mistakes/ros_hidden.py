"""The mistake of an own folder or file with the name rclpy (recognised by `verdict.own_modules`)."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import example
from grader.mistakes.kind import Family
from grader.package.edit.tree import Write

_node = Family("node", links.PACKAGE)
KINDS = (
    _node(
        "ros_hidden",
        "file",
        msg("A folder of your package has the name of a library of ROS"),
        msg(
            "The build installs {name} with your package, and Python finds it before the library of "
            "ROS with the same name. An editor that underlines an import does not know where ROS is; "
            "the import is right all the same."
        ),
        msg(
            "Delete {name}, and the workspace's folders build and install, then build again. In the "
            "package's folder, run: rm -r {name}"
        ),
        examples=(
            example(
                "own_folder_rclpy",
                Write("rclpy/__init__.py", ""),
                fails="run.starts",
                note="so that the editor finds the import",
            ),
            example(
                "own_rclpy_with_some_names",
                Write("rclpy/__init__.py", "def spin(node):\n    pass\n"),
                Write("rclpy/node.py", "class Node:\n    pass\n"),
                fails="run.starts",
            ),
        ),
    ),
)
