"""A function that is to be called at the end of the program is called where it is passed on."""

from __future__ import annotations

import ast
import re

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.place import statement_at

# of atexit.register and of signal.signal (CPython 3.10 to 3.13)
REFUSED = (
    r"TypeError: (?:the first argument must be callable|signal handler must be signal\.SIG_IGN)"
)
TAKERS = ("register", "signal")
AT_THE_END = {"rclpy.shutdown()": "rclpy.try_shutdown"}


def _called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for the one call among the arguments of a call."""
    del match
    module = raised.module
    statement = statement_at(module, raised.line)
    for call, name in calls_in(statement) if isinstance(statement, ast.Expr) else ():
        inner = [a for a in call.args if isinstance(a, ast.Call) and dotted(a.func)]
        if len(inner) == 1 and last_part(name) in TAKERS:
            code = module.text.code(inner[0])
            written = AT_THE_END.get(code, module.text.code(inner[0].func))
            params = {"name": code, "written": written, "function": name}
            return raised.finding("called_at_once", at=inner[0], params=params)
    return None


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "called_at_once",
        "shutdown",
        msg("A function is called here, and is to be called later"),
        msg(
            "With the brackets, {name} runs at once, and {function} gets its result. {function} needs "
            "the function itself, and Python calls it later."
        ),
        msg("Write {written} instead of {name}."),
        raised={REFUSED: _called},
        fixed_by=(lines.written,),
        examples=(
            example(
                "shutdown_called_for_atexit",
                Replace(NODE, "import rclpy\n", "import atexit\n\nimport rclpy\n"),
                Replace(
                    NODE,
                    "    node = MyFirstNode()\n",
                    "    node = MyFirstNode()\n    atexit.register(rclpy.shutdown())\n",
                ),
                fails="run.starts",
            ),
            example(
                "handler_called_for_signal",
                Replace(NODE, "import rclpy\n", "import signal\n\nimport rclpy\n"),
                Replace(
                    NODE,
                    "def main(",
                    "def stop(*_):\n    print('stopped')\n\n\ndef main(",
                ),
                Replace(
                    NODE,
                    "    node = MyFirstNode()\n",
                    "    signal.signal(signal.SIGTERM, stop())\n    node = MyFirstNode()\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
