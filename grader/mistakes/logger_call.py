"""Mistakes in the call of the logger: another method than info, or a text for get_logger."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.example import DEAD, LOG, NODE, example
from grader.mistakes.fixes import lines, node_log_call, node_words
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.mistakes.worked_out import INSTEAD
from grader.package.edit.tree import Replace
from grader.package.source.names import called_name, dotted, last_part
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


def _level_in_words(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """log() gets the name of a level as a text, before or behind the text to log."""
    del match
    call = node_log_call.call_of(raised.module, raised.line, "log")
    called = call.func if call is not None else None
    if call is None or not isinstance(called, ast.Attribute) or len(call.args) != 2:
        return None
    levels = [a for a in call.args if isinstance(a, ast.Constant) and _level(a)]
    code = raised.module.text.code(call)
    if len(levels) != 1 or call.keywords or "\n" in code:
        return None
    message = next(a for a in call.args if a is not levels[0])
    text = raised.module.text
    written = f"{text.code(called.value)}.{_level(levels[0])}({text.code(message)})"
    found = raised.finding("log_severity", at=call, name=code, written=written)
    return replace(found, words={**found.words, "value": repr(levels[0].value)}, variant="text")


def _level(value: ast.Constant) -> str:
    """Return the method of the logger for the name of a level; "" if it is none."""
    name = value.value.lower() if isinstance(value.value, str) else ""
    return name if name in LOG_METHODS else ""


def _text_given(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """get_logger gets the text, or the name of a logger."""
    del match
    call = node_log_call.call_of(raised.module, raised.line, "get_logger")
    if call is None:
        return None
    found = raised.finding("get_logger_arguments", at=call)
    text = node_log_call.is_statement(raised.module, call)
    return replace(found, variant="" if text else "name")


def _swapped(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """log() gets the severity first, as the logging of Python has it."""
    del match
    call = node_log_call.call_of(raised.module, raised.line, "log")
    if call is None or len(call.args) != 2 or call.keywords:
        return None
    if not _is_severity(call.args[0]):
        return None  # (the severity is in its place, and is none)
    text = raised.module.text
    severity, message = (text.code(argument) for argument in call.args)
    written = f"{text.code(call.func)}({message}, {severity})"
    return raised.finding("log_order", at=call, name=text.code(call), written=written)


def _is_severity(value: ast.expr) -> bool:
    """Whether a value is a severity for certain, or nearly: LoggingSeverity.INFO, 20."""
    number = isinstance(value, ast.Constant) and type(value.value) is int
    level = last_part(dotted(value)).lower() if isinstance(value, ast.Attribute) else ""
    return number or level in LOG_METHODS


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
    if not found:
        found = [c for c in calls if _is_logger(raised, c.func)]
    code = raised.module.text.code(found[0].func) if len(found) == 1 else ""
    if not code or "\n" in code:
        return None
    return raised.finding("logger_called", at=found[0].func, name=code, written=f"{code}.info")


def _result_called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """What is called on the line is the result of a call of info(), not the method."""
    del match
    statement = statement_at(raised.module, raised.line)
    for call in ast.walk(statement) if statement is not None else ():
        if not isinstance(call, ast.Call) or not dotted(call.func):
            continue
        values = node_words.values_of(raised.source, call.func)
        value = values[0] if len(values) == 1 else None
        if not isinstance(value, ast.Call) or called_name(value) not in LOG_METHODS:
            continue
        text = raised.source.module_of(value).text
        code = text.code(value)
        if "\n" in code or "get_logger" not in code:
            continue
        found = raised.finding("logger_called", at=value, name=code, written=text.code(value.func))
        return replace(found, variant="result")
    return None


def _is_logger(raised: Raised, value: ast.expr) -> bool:
    """Whether a name has only a logger as its value."""
    values = node_words.values_of(raised.source, value) if dotted(value) else []
    return bool(values) and all(
        isinstance(v, ast.Call) and called_name(v) == "get_logger" for v in values
    )


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
            example(
                "logger_information",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = 0\n        self.log_ = self.get_logger()",
                ),
                Replace(NODE, "self.get_logger().info(", "self.log_.information("),
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
        whys={
            "text": msg(
                "The method log takes a text and a severity. {value} in quotes is a text, and no severity."
            )
        },
        fixes={"text": INSTEAD},
        seen=r"TypeError: RcutilsLogger\.log\(\) missing 1 required positional argument: 'severity'",
        raised={
            r"(?<!\w)log\(\) missing 1 required positional argument: 'severity'": _no_severity,
            r"is not a valid LoggingSeverity": _level_in_words,
        },
        fixed_by=(lines.written, node_log_call.info),
        examples=(
            example(
                "level_in_quotes",
                Replace(NODE, LOG, f"self.get_logger().log({TEXT}, 'INFO')"),
                fails="run.output",
                blocks=DEAD,
            ),
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
        "log_order",
        "logger",
        msg("log() gets the severity before the text"),
        msg("The method log of a ROS logger takes the text first, and then the severity."),
        msg("Write {written} instead of {name}. Shorter is .info() with the text alone."),
        raised={r"is not a valid LoggingSeverity": _swapped},
        fixed_by=(lines.written,),
        examples=(
            example(
                "severity_before_the_text",
                Replace(
                    NODE,
                    "import rclpy\nfrom",
                    "import rclpy\nfrom rclpy.logging import LoggingSeverity\nfrom",
                ),
                Replace(NODE, LOG, f"self.get_logger().log(LoggingSeverity.INFO, {TEXT})"),
                fails="run.output",
                blocks=DEAD,
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
            r"'(?:bool|NoneType)' object is not callable": _result_called,
        },
        whys={
            "result": msg(
                "{name} logs a line and gives back no function. The name of a method without () is the "
                "method itself, which can be called later."
            )
        },
        fixes={"result": msg("Write {written} instead of {name}.")},
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
