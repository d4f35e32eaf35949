"""Mistakes about Python itself: what async, yield, a property, a decorator or += does."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import Value, msg
from grader.mistakes import links
from grader.mistakes.example import LOG, NODE, example
from grader.mistakes.fixes.node_clock import count_of
from grader.mistakes.kind import Family
from grader.mistakes.placeholders import as_sum
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import dotted
from grader.package.source.node import NodeSource

CLOCKS = ("time", "monotonic", "perf_counter", "now", "strftime", "seconds_nanoseconds", "ctime")
"""Functions and methods that return or show a time."""


def _logged(source: NodeSource, part: ast.AST) -> list[ast.expr]:
    """Return the texts that the log calls in a part of the source get."""
    return [arg for call in source.logs(part) for arg in call.args]


def _set_in(function: Function) -> set[str]:
    """Return the names that a function assigns to."""
    return {name for node in ast.walk(function) for name in targets_of(node)}


def _built_once(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a logged attribute that __init__ sets to a text with a value in it."""
    source, callback = suspect.source, suspect.source.callback
    init = source.methods.get("__init__")
    logged = set(map(dotted, _logged(source, callback or source.module.tree)))
    changed = _set_in(callback) if callback is not None else set()
    for node in ast.walk(init) if init is not None else ():
        for name in targets_of(node):
            value = getattr(node, "value", None)
            text = isinstance(value, ast.JoinedStr | ast.BinOp | ast.Call)
            if isinstance(node, ast.Assign) and text and name in logged - changed:
                return suspect.finding("text_built_once", node, name=name)
    return None


def _grows(suspect: Suspect) -> RecognisedMistake | None:
    """Look for += on a text that is logged."""
    source, callback = suspect.source, suspect.source.callback
    if callback is None:
        return None
    logged = set(map(dotted, _logged(source, callback))) - {""}
    set_anew = [n for n in ast.walk(callback) if isinstance(n, ast.Assign | ast.AnnAssign)]
    logged -= {name for node in set_anew for name in targets_of(node)}
    for node in ast.walk(callback):
        if isinstance(node, ast.AugAssign) and dotted(node.target) in logged:
            text = ast.unparse(node.value)
            if isinstance(node.value, ast.JoinedStr) or text.startswith(("str(", "'", '"')):
                name = dotted(node.target)
                return suspect.finding("text_grows", node, name=name, value=text)
    return None


def _time(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a clock whose time the callback logs, also by way of a variable."""
    source, callback = suspect.source, suspect.source.callback
    logs = source.logs(callback) if callback is not None else []
    if callback is None or not logs:
        return None
    shown_parts = {n for text in _logged(source, callback) for n in ast.walk(text)}
    names = {dotted(n) for n in shown_parts} - {"", "self"}
    for node in ast.walk(callback):
        if isinstance(node, ast.Assign) and names & set(targets_of(node)):
            shown_parts |= set(ast.walk(node.value))
    call = next((c for c in source.calls_of(*CLOCKS) if c in shown_parts), None)
    if call is None:
        return None
    found = suspect.finding("time_for_count", call, name=ast.unparse(call.func)[:60])
    counter, counts = count_of(source)
    words: dict[str, Value] = {
        **found.words,
        "counter": counter,
        "written": f"{ast.unparse(logs[0].func)}({as_sum(suspect.output, counter)})",
        "line": logs[0].lineno,
    }
    kind = "ros" if "get_clock" in str(words["name"]) else ""
    variant = "_".join(filter(None, (kind, "counts" if counts else "")))
    return replace(found, variant=variant, words=words)


ROS_TIME = msg(
    "The number says how often the callback was called: {start} first, then {step} more each time. "
    "{name} is the time that a clock shows, and no count. Here ROS time began at 0; on your "
    "terminal the number is that of the seconds since 1970."
)
LOG_COUNT = msg(
    "{counter} counts already. Write {written} in the place of the call that logs (line {line}). "
    "Delete what reads the clock."
)
_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "text_built_once",
        "text",
        msg("The text is made once, in __init__"),
        msg("A text does not change when the counter changes later."),
        msg("Make the text in the callback, just before it is logged."),
        behind={"run.constant_counter": _built_once},
        examples=(
            example(
                "text_built_once",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = 0\n        self.text_ = 'Hello time: ' + str(self.counter_)",
                ),
                Replace(NODE, LOG, "self.get_logger().info(self.text_)"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "text_grows",
        "text",
        msg("The text grows each time"),
        msg("+= changes {name} for good: the next callback begins with the longer text."),
        msg("Delete this line, so that {name} keeps its text, and log {name} + {value}."),
        behind={"run.wrong_text": _grows},
        examples=(
            example(
                "text_grows",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = 0\n        self.text_ = 'Hello time: '",
                ),
                Replace(
                    NODE,
                    LOG,
                    "self.text_ += str(self.counter_)\n        self.get_logger().info(self.text_)",
                ),
                fails="run.output",
                blocks=("run.period",),
            ),
        ),
    ),
    _node(
        "time_for_count",
        "text",
        msg("The line shows a time instead of a count"),
        msg(
            "The number says how often the callback was called: {start} first, then {step} more "
            "each time. {name} is the time that a clock shows, and no count."
        ),
        msg(
            "Write {counter} = {start} in __init__. In the callback, write {written} in the place "
            "of the call that logs (line {line}), and {counter} += {step} below it. Delete what "
            "reads the clock."
        ),
        whys={"ros": ROS_TIME, "ros_counts": ROS_TIME},
        fixes={"counts": LOG_COUNT, "ros_counts": LOG_COUNT},
        behind={
            "run.constant_counter": _time,
            "run.wrong_start": _time,
            "run.wrong_step": _time,
            "run.wrong_text": _time,
        },
        examples=(
            example(
                "time_in_a_variable",
                Replace(NODE, "import rclpy\nfrom", "import time\n\nimport rclpy\nfrom"),
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(
                    NODE,
                    f"        {LOG}\n        self.counter_ += 1\n",
                    "        now = time.strftime('%H:%M:%S')\n"
                    "        self.get_logger().info('Hello time: ' + now)\n",
                ),
                fails="run.output",
                note="there is no counter",
            ),
            example(
                "time_of_day",
                Replace(NODE, "import rclpy\nfrom", "import time\n\nimport rclpy\nfrom"),
                Replace(NODE, "str(self.counter_)", "time.strftime('%H:%M:%S')"),
                fails="run.output",
            ),
            example(
                "seconds_of_the_clock",
                Replace(
                    NODE,
                    "str(self.counter_)",
                    "str(self.get_clock().now().seconds_nanoseconds()[0] + 7)",
                ),
                fails="run.output",
            ),
        ),
    ),
)
