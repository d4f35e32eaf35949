"""The mistake of an except that logs only the text of an error, so that the program ends without a traceback."""

from __future__ import annotations

import ast
import re

from grader.base.i18n.message import msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.names import calls_in, last_part
from grader.package.source.node import NodeSource

ERROR_LINE = re.compile(
    r"\[(?:ERROR|FATAL)\] \[[\d.]{1,40}\] \[[^\]\n]{1,100}\]: (?P<text>[^\r\n]{1,300})"
)
LOGS = ("error", "fatal", "critical")


def _only_logged(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only except that logs what it catches, if such a line is the last that came."""
    said = ERROR_LINE.findall(suspect.transcript)
    handlers = list(_handlers(suspect.source))
    if not said or len(handlers) != 1:
        return None
    return suspect.finding("error_only_logged", suspect.place_at(handlers[0]), text=shown(said[-1]))


def _handlers(source: NodeSource) -> list[ast.ExceptHandler]:
    """Return the handlers that log the exception by its name as an error, and raise nothing."""
    found = []
    for module in source.known_modules:
        for handler in (n for n in module.nodes if isinstance(n, ast.ExceptHandler) and n.name):
            inside = [n for statement in handler.body for n in ast.walk(statement)]
            logs = [c for s in handler.body for c, name in calls_in(s) if last_part(name) in LOGS]
            named = {n.id for call in logs for n in ast.walk(call) if isinstance(n, ast.Name)}
            if handler.name in named and not any(isinstance(n, ast.Raise) for n in inside):
                found.append(handler)
    return found


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "error_only_logged",
        "start",
        msg("An except logs an error without its traceback"),
        msg(
            "This except catches the error and logs only its text: {text} The traceback, which names the "
            "line with the error, does not come."
        ),
        msg(
            "The text says what is wrong. To see where, write traceback.print_exc() as the first line of "
            "this except, and import traceback at the top of the file. Run the node again: the last line "
            "of your own files in the traceback has the error. Correct that line."
        ),
        behind=dict.fromkeys(
            ("run.exits_at_once", "run.ended_early", "run.no_lines", "run.stops"), _only_logged
        ),
        examples=(
            example(
                "error_logged_as_fatal_in_main",
                Replace(NODE, "create_timer(1.0,", "create_timer(1.0, oneshot=False, callback="),
                Replace(
                    NODE,
                    "    node = MyFirstNode()\n    try:\n        rclpy.spin(node)\n"
                    "    except KeyboardInterrupt:\n        pass\n"
                    "    finally:\n        node.destroy_node()\n        rclpy.try_shutdown()\n",
                    "    try:\n        rclpy.spin(MyFirstNode())\n"
                    "    except Exception as error:\n"
                    "        rclpy.logging.get_logger('main').fatal(f'it failed: {error}')\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
