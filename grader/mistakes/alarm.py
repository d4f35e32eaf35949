"""The mistake of an alarm of the operating system in the place of a timer."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.imported import full_name
from grader.package.source.names import own_name

ALARMS = ("signal.setitimer", "signal.alarm")


def _alarm(suspect: Suspect) -> RecognisedMistake | None:
    """Look for an alarm whose handler is a method that logs."""
    source = suspect.source
    calls = [(c, full_name(source.module_of(c), c.func)) for c, _ in source.calls]
    alarms = [call for call, name in calls if name in ALARMS]
    for call, name in calls:
        handler = call.args[1] if name == "signal.signal" and len(call.args) == 2 else None
        method = source.methods.get(own_name(handler)) if handler is not None else None
        if method is None or not source.logs(method) or not alarms or source.timers:
            continue
        given = [argument.arg for argument in method.args.args[1:]]
        rows = sorted({c.lineno for c in (*alarms, call)})
        found = suspect.finding("alarm_for_timer", alarms[0], name=ast.unparse(alarms[0].func))
        words = {
            **found.words,
            "method": method.name,
            "lines": ", ".join(map(str, rows)),
            "written": ", ".join(given),
        }
        return replace(found, words=words, variant="parameters" if given else "")
    return None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "alarm_for_timer",
        "timer",
        msg("An alarm of the operating system is used instead of a timer"),
        msg(
            "Python calls the handler of a signal only between two steps of Python code. rclpy.spin waits "
            "outside of Python for what ROS brings, and an alarm does not wake it. Only a timer of the node "
            "does."
        ),
        msg(
            "Delete the lines that use the alarm ({lines}). Write self.create_timer({period}, self.{method}) "
            "in __init__."
        ),
        fixes={
            "parameters": msg(
                "Delete the lines that use the alarm ({lines}). Write self.create_timer({period}, "
                "self.{method}) in __init__, and delete the parameters {written} of {method}: a timer gives "
                "none."
            )
        },
        behind=dict.fromkeys(
            ("run.stops", "run.no_lines", "run.wrong_period", "run.never_spins"), _alarm
        ),
        examples=(
            example(
                "alarm_instead_of_a_timer",
                Replace(NODE, "import rclpy\nfrom", "import signal\n\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "        signal.signal(signal.SIGALRM, self.timer_callback)\n"
                    "        signal.setitimer(signal.ITIMER_REAL, 1.0, 1.0)\n",
                ),
                Replace(
                    NODE, "def timer_callback(self)", "def timer_callback(self, number, frame)"
                ),
                fails="run.output",
                blocks=("run.period",),
            ),
        ),
    ),
)
