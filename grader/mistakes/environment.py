"""A value that only the computer of the student has: a variable of the environment."""

from __future__ import annotations

import ast
import re

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.names import dotted
from grader.package.source.place import statement_at


def _variable(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line reads a variable of the environment that is not set."""
    statement = statement_at(raised.module, raised.line)
    for node in ast.walk(statement) if statement is not None else ():
        owner = dotted(node.value) if isinstance(node, ast.Subscript) else ""
        if owner in ("os.environ", "environ"):
            code = raised.module.text.code(node) if isinstance(node, ast.Subscript) else ""
            params = {"name": code, "variable": match["name"]}
            return raised.finding("environment", params=params)
    return None


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "environment",
        "start",
        msg("A variable of the environment is not set"),
        msg(
            "os.environ has the variables that are set in the terminal in which the program runs. If "
            "{variable} is set only in your own terminal, or in a file such as ~/.bashrc, the program "
            "stops on every other computer."
        ),
        msg("Write the value itself in the program, instead of {name}."),
        raised={r"^KeyError: '(?P<name>[^'\n]{1,80})'": _variable},
        examples=(
            example(
                "period_from_the_environment",
                Replace(NODE, "import rclpy\nfrom", "import os\n\nimport rclpy\nfrom"),
                Replace(
                    NODE, "create_timer(1.0,", "create_timer(float(os.environ['HELLO_PERIOD']),"
                ),
                fails="run.starts",
            ),
        ),
    ),
)
