"""Mistakes in which something of Python or of another library is used in place of ROS's own."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG, NODE, example
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Module
from grader.package.source.names import dotted, last_part

ROS_NODE = ("rclpy.node", "rclpy.lifecycle", "rclpy.lifecycle.node")


def _imports(module: Module) -> Iterator[tuple[str, str, ast.stmt]]:
    """Yield the name that each import binds, the full name behind it, and the statement."""
    for node in module.nodes:
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield alias.asname or alias.name, alias.name, node
        elif isinstance(node, ast.ImportFrom) and not node.level:
            for alias in node.names:
                yield alias.asname or alias.name, f"{node.module}.{alias.name}", node


def _full_name(suspect: Suspect, call: ast.Call) -> str:
    """Return the imported name of what is called: threading.Timer; "" if it is not imported."""
    written = dotted(call.func)
    for bound, full, _ in _imports(suspect.source.module_of(call)):
        if written == bound or written.startswith(f"{bound}."):
            return full + written.removeprefix(bound)
    return ""


def _threading_timer(suspect: Suspect) -> RecognisedMistake | None:
    for call in suspect.source.calls_of("Timer"):
        if _full_name(suspect, call) == "threading.Timer":
            found = suspect.finding("threading_timer", call)
            lines = _lines_of_timer(suspect, call)
            if not lines:
                return found
            words = {**found.words, "line": ", ".join(map(str, lines))}
            return replace(found, variant="used", words=words)
    return None


def _lines_of_timer(suspect: Suspect, call: ast.Call) -> list[int]:
    """Return the lines that start a timer and set it up, in the function that creates it."""
    module, function = suspect.source.module_of(call), suspect.source.function_around(call)
    made = module.parents.get(call)
    names = set(targets_of(made)) if made is not None else set()
    uses = [n for n in ast.walk(function or module.tree) if isinstance(n, ast.Attribute)]
    lines = {use.lineno for use in uses if dotted(use.value) in names}
    chained = isinstance(made, ast.Attribute) and made.attr == "start"
    return sorted(lines - ({call.lineno} if not chained else set()))


def _python_logging(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a logger of Python's logging where the lines are logged."""
    source = suspect.source
    for call in source.calls_of("getLogger", "basicConfig", "info"):
        if _full_name(suspect, call).startswith("logging."):
            return suspect.finding("python_logging", call)
    return None


def _signal_handler(suspect: Suspect) -> RecognisedMistake | None:
    for call in suspect.source.calls_of("signal"):
        ignored = len(call.args) > 1 and last_part(dotted(call.args[1])).startswith("SIG_")
        if _full_name(suspect, call) == "signal.signal" and not ignored:
            return suspect.finding("signal_handler", call)
    return None


def _duration(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    timers = [t for t in raised.source.timers if raised.line in (None, t.call.lineno)]
    return raised.finding("period_duration", at=timers[0].call) if timers else None


def _other_node_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for a base class that is imported from elsewhere than rclpy."""
    del match
    for found in raised.source.family:
        for base in map(dotted, found.bases):
            for bound, full, node in _imports(raised.source.module_of(found)):
                if (
                    base == bound
                    and isinstance(node, ast.ImportFrom)
                    and node.module not in ROS_NODE
                ):
                    return raised.finding("other_node_class", at=node, name=base, module=full)
    return None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "threading_timer",
        "timer",
        msg("threading.Timer calls its function once"),
        msg("It is no ROS timer: it calls its function one time, and ROS time does not drive it."),
        msg(
            "Write self.create_timer({period}, self.{callback}) instead, without .start(): a ROS "
            "timer starts by itself."
        ),
        fixes={
            "used": msg(
                "Write self.create_timer({period}, self.{callback}) instead, and delete what "
                "starts or sets up the old timer (line {line}): a ROS timer starts by itself."
            )
        },
        behind={
            "run.no_lines": _threading_timer,
            "run.stops": _threading_timer,
            "run.wrong_period": _threading_timer,
        },
        examples=(
            example(
                "threading_timer",
                Replace(NODE, "import rclpy\nfrom", "import threading\n\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    (
                        "self.timer_ = threading.Timer(1.0, self.timer_callback)\n"
                        "        self.timer_.daemon = True\n"
                        "        self.timer_.start()"
                    ),
                ),
                fails="run.output",
                blocks=("run.period",),
            ),
        ),
    ),
    _node(
        "python_logging",
        "logger",
        msg("The lines go through Python's logging module"),
        msg("ROS does not know that logger: its lines have another form and do not reach /rosout."),
        msg("Write self.get_logger().info(…) in the callback, and remove the logging module."),
        links.LOGGING,
        behind={
            "run.wrong_text": _python_logging,
            "run.print_not_logger": _python_logging,
            "run.other_logger": _python_logging,
        },
        examples=(
            example(
                "python_logging",
                Replace(
                    NODE,
                    "import rclpy\nfrom",
                    "import logging\n\nimport rclpy\nfrom",
                ),
                Replace(
                    NODE,
                    "    rclpy.init",
                    "    logging.basicConfig(level=logging.INFO)\n    rclpy.init",
                ),
                Replace(
                    NODE,
                    LOG,
                    "logging.getLogger('my_first_node').info('Hello time: ' + str(self.counter_))",
                ),
                fails="run.output",
                also={"run.logger": "node.python_logging"},
            ),
            example(
                "python_logging_bare",
                Replace(NODE, "import rclpy\nfrom", "import logging\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "    rclpy.init(args=args)",
                    (
                        "    rclpy.init(args=args)\n"
                        "    logging.basicConfig(level=logging.INFO, format='%(message)s')"
                    ),
                ),
                Replace(NODE, "self.get_logger().info", "logging.info"),
                fails="run.logger",
            ),
        ),
    ),
    _node(
        "signal_handler",
        "shutdown",
        msg("The program has its own function for Ctrl+C"),
        msg(
            "signal.signal replaces what Python and rclpy do at Ctrl+C: no KeyboardInterrupt comes, "
            "and spin goes on unless your function ends it."
        ),
        msg("Remove signal.signal and its function: Ctrl+C ends rclpy.spin by itself."),
        links.EXECUTORS,
        behind={"run.ignores_interrupt": _signal_handler},
        examples=(
            example(
                "signal_handler",
                Replace(NODE, "import rclpy\nfrom", "import signal\n\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "    try:\n",
                    "    signal.signal(signal.SIGINT, lambda *_: None)\n    try:\n",
                ),
                fails="run.interrupt",
            ),
        ),
    ),
    _node(
        "period_duration",
        "timer",
        msg("create_timer gets a Duration as its period"),
        msg("In Python the period is a number of seconds; a Duration belongs to C++ and to ROS 1."),
        msg("Write create_timer({period}, self.{callback})"),
        raised={r"TypeError: float\(\) argument must be .{1,60}not 'Duration'": _duration},
        examples=(
            example(
                "period_duration",
                Replace(
                    NODE, "from rclpy.node", "from rclpy.duration import Duration\nfrom rclpy.node"
                ),
                Replace(NODE, "create_timer(1.0,", "create_timer(Duration(seconds=1.0),"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "other_node_class",
        "class",
        msg("The base class is not the Node of ROS"),
        msg("This line imports {module}, another class of that name, which is no ROS node."),
        msg("Write: from rclpy.node import Node"),
        raised={r"TypeError: .{1,80}\.__init__\(\) ": _other_node_class},
        examples=(
            example(
                "other_node_class",
                Replace(NODE, "from rclpy.node import Node", "from xml.dom import Node"),
                fails="run.starts",
            ),
        ),
    ),
)
