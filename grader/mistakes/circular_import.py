"""Two files of the package that import each other (recognised by `grader.verdict.circular`)."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import INNER, LOG, NODE, example
from grader.mistakes.kind import Family
from grader.package.edit.tree import Replace, Write

IMPORT = "from rclpy.node import Node\n"
HELPER = f"{INNER}/text_helper.py"
USES_HELPER = Replace(NODE, LOG, "self.get_logger().info(make_text(self.counter_))")
_node = Family("node", links.PYTHON_MODULES)
KINDS = (
    _node(
        "circular_import",
        "start",
        msg("Two files import each other"),
        msg(
            "Line {line} of {path} imports {there}, and this line of {there} imports {path}: a "
            "circle. Python runs a file from top to bottom when it is imported. {path} is only run "
            "up to line {line}, so {name} does not exist yet."
        ),
        msg(
            "Move {name} from {path} to {there}, and delete the import of {path} here. If {path} "
            "needs {name} too, import it there, on line {line}. Then only {path} imports {there}. If "
            "this file reads {name} with a module and a dot before it, write {name} alone."
        ),
        fixes={
            "init": msg(
                "Delete line {line} of {path}: ros2 run finds {there} without it. Then {path} imports "
                "nothing that imports it."
            ),
            "third": msg(
                "Delete this import of {path}, and {name} where {there} uses it, also as the type of an "
                "argument: only one of the two files can import the other. "
                "Give the functions of {there} what they need as arguments, or move what both "
                "files need to a third file."
            ),
        },
        examples=(
            example(
                "files_import_each_other",
                Write(
                    HELPER,
                    "from my_robot_controller.my_first_node import PREFIX\n\n\n"
                    "def make_text(number):\n    return PREFIX + str(number)\n",
                ),
                Replace(
                    NODE,
                    IMPORT,
                    f"{IMPORT}\nfrom my_robot_controller.text_helper import make_text\n\n"
                    "PREFIX = 'Hello time: '\n",
                ),
                USES_HELPER,
                fails="run.starts",
            ),
            example(
                "helper_imports_the_node",
                Write(
                    HELPER,
                    "from .my_first_node import MyFirstNode\n\n\n"
                    "def make_text(number):\n    return 'Hello time: ' + str(number)\n",
                ),
                Replace(NODE, IMPORT, f"{IMPORT}\nfrom .text_helper import make_text\n"),
                USES_HELPER,
                fails="run.starts",
            ),
        ),
    ),
)
