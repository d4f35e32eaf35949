"""Mistakes in the call of the logger: another method than info, or a text for get_logger."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.example import DEAD, LOG, NODE, example
from grader.mistakes.fixes import lines, node_log_call
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.names import called_name, dotted
from grader.package.source.node import LOG_METHODS
from grader.package.source.place import statement_at

OTHERS = ("get_child", "set_level", "get_effective_level", "is_enabled_for")
"""Methods of the logger that log nothing; one of them may be meant."""
TEXT = "'Hello time: ' + str(self.counter_)"


def _method(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The logger has no method of this name; one that is misspelt is another mistake."""
    call = node_log_call.call_of(raised.module, raised.line, match["name"])
    if call is None or nearest(match["name"], (*LOG_METHODS, *OTHERS), cutoff=0.7):
        return None
    return raised.finding("logger_method", at=call, name=match["name"])


def _no_severity(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """log() of the logger gets the text alone."""
    del match
    call = node_log_call.call_of(raised.module, raised.line, "log")
    return raised.finding("log_severity", at=call, name="log") if call is not None else None


def _text_given(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """get_logger gets the text, or the name of a logger."""
    del match
    call = node_log_call.call_of(raised.module, raised.line, "get_logger")
    if call is None:
        return None
    found = raised.finding("get_logger_arguments", at=call)
    text = node_log_call.is_statement(raised.module, call)
    return replace(found, variant="" if text else "name")


def _called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The logger itself is called on the line, as in self.get_logger()(…)."""
    del match
    statement = statement_at(raised.module, raised.line)
    calls = [n for n in ast.walk(statement) if isinstance(n, ast.Call)] if statement else []
    found = [
        call
        for call in calls
        if isinstance(call.func, ast.Call) and called_name(call.func) == "get_logger"
    ]
    found = found or [call for call in calls if dotted(call.func) in raised.source.loggers]
    code = raised.module.text.code(found[0].func) if len(found) == 1 else ""
    if not code or "\n" in code:
        return None
    return raised.finding("logger_called", at=found[0].func, name=code, written=f"{code}.info")


_node = Family("node", links.LOGGING)
KINDS = (
    _node(
        "logger_method",
        "logger",
        msg("The logger has no method of this name"),
        msg("The logger has a method for each level: debug, info, warning, error and fatal."),
        msg("Write .info(…) instead of .{name}(…)."),
        seen=r"AttributeError: 'RcutilsLogger' object has no attribute "
        r"'(?P<name>print|write|information|message|msg|log_info)'",
        raised={r"'RcutilsLogger' object has no attribute '(?P<name>\w{1,120})'": _method},
        fixed_by=(node_log_call.info,),
        examples=(
            example(
                "logger_print",
                Replace(NODE, "get_logger().info(", "get_logger().print("),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "log_severity",
        "logger",
        msg("log() gets no severity"),
        msg(
            "The method log of the logger needs a severity as well. The method info logs a "
            "normal line, and needs only the text."
        ),
        msg("Write .info(…) instead of .{name}(…)."),
        seen=r"TypeError: RcutilsLogger\.log\(\) missing 1 required positional argument: 'severity'",
        raised={
            r"(?<!\w)log\(\) missing 1 required positional argument: 'severity'": _no_severity,
        },
        fixed_by=(node_log_call.info,),
        examples=(
            example(
                "logger_log",
                Replace(NODE, "get_logger().info(", "get_logger().log("),
                fails="run.output",
                blocks=DEAD,
                note="as Python's logging has it, without the level",
            ),
        ),
    ),
    _node(
        "get_logger_arguments",
        "logger",
        msg("get_logger() gets an argument"),
        msg(
            "get_logger() only returns the node's logger, and takes nothing. The logger's method "
            "info logs the text that it gets."
        ),
        msg(
            "Leave the () of get_logger empty, and give the text to info: self.get_logger().info(…)"
        ),
        whys={"name": msg("get_logger() returns the node's own logger, and takes nothing.")},
        fixes={"name": msg("Leave the () of get_logger empty.")},
        seen=r"TypeError: (?:Node\.)?get_logger\(\) takes 1 positional argument but \d{1,3} were given",
        raised={
            r"(?<!\w)get_logger\(\) takes 1 positional argument but \d{1,3} were given": _text_given
        },
        fixed_by=(node_log_call.given_to_info,),
        examples=(
            example(
                "text_for_get_logger",
                Replace(NODE, LOG, f"self.get_logger({TEXT})"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "name_for_get_logger",
                Replace(NODE, "self.get_logger()", "self.get_logger('my_first_node')"),
                fails="run.output",
                blocks=DEAD,
                note="as rclpy.logging.get_logger takes it",
            ),
        ),
    ),
    _node(
        "logger_called",
        "logger",
        msg("What is called is no method of the logger"),
        msg("A logger is an object. One of its methods, such as info, logs the text that it gets."),
        msg("Write {written}(…) instead of {name}(…)."),
        raised={
            r"'RcutilsLogger' object is not callable": _called,
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "logger_called",
                Replace(NODE, "get_logger().info(", "get_logger()("),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
