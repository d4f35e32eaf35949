"""Recognise the mistake behind an exception that a call raised, from the call and its arguments."""

from __future__ import annotations

import ast
import re

from grader.mistakes.kind import RecognisedMistake
from grader.mistakes.symptoms import Raised
from grader.package.source.node import dotted


def called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback is called instead of passed by name."""
    del match
    called = [timer for timer in raised.source.timers if timer.called]
    return raised.finding("callback_called", line=called[0].line) if called else None


def swapped(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The arguments of create_timer are in the wrong order."""
    del match
    return raised.finding("timer_arguments_swapped") if raised.source.timers else None


def no_self(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """A method has no parameter self."""
    if match["function"] == "__init__":
        init = raised.source.methods.get("__init__")
        return raised.finding("init_no_self", line=init.lineno if init else None)
    found = raised.source.callback
    return raised.finding("callback_no_self", line=found.lineno if found else None)


def parameter(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback has a parameter that no caller passes."""
    method = raised.source.methods.get(match["function"])
    if method is None or method is not raised.source.callback:
        return None
    return raised.finding("callback_parameter", line=method.lineno, name=match["name"])


def logger_arguments(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The logger gets several strings, which only print accepts."""
    del match
    logs = [call for call in raised.source.logs(raised.source.tree) if len(call.args) > 1]
    return raised.finding("logger_arguments", line=logs[0].lineno) if logs else None


def spun_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The class is spun instead of the node."""
    del match
    names = {found.name for found in raised.source.classes}
    for call, name in raised.source.calls:
        given = dotted(call.args[0]) if call.args else ""
        if name.rpartition(".")[2] == "spin" and given in names:
            return raised.finding("spin_of_class", line=call.lineno, name=given)
    return None


def uncalled_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """No node is created: the class is named but not called."""
    del match
    names = {found.name for found in raised.source.classes}
    for node in ast.walk(raised.source.tree):
        if isinstance(node, ast.Assign) and dotted(node.value) in names:
            return raised.finding("class_not_called", line=node.lineno, name=dotted(node.value))
    return None


def init_twice(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """Rclpy is initialised a second time."""
    del match
    inits = [call.lineno for call, name in raised.source.calls if name == "rclpy.init"]
    return raised.finding("init_twice", line=inits[1] if len(inits) > 1 else None)
