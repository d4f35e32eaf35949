"""Recognise the mistake behind an exception that a call raised, from the call and its arguments."""

from __future__ import annotations

import ast
import re

from grader.mistakes.kind import RecognisedMistake
from grader.mistakes.symptoms import Raised
from grader.package.source.names import dotted, last_part


def called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback is called instead of passed by name."""
    del match
    called = [timer for timer in raised.source.timers if timer.called]
    return raised.finding("callback_called", at=called[0].call) if called else None


def swapped(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The arguments of create_timer are in the wrong order."""
    del match
    return raised.finding("timer_arguments_swapped") if raised.source.timers else None


def no_self(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """A method has no parameter self."""
    if match["function"] == "__init__":
        init = raised.source.methods.get("__init__")
        return raised.finding("init_no_self", at=init)
    found = raised.source.callback
    return raised.finding("callback_no_self", at=found)


def parameter(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback has a parameter that no caller passes."""
    method = raised.source.methods.get(match["function"])
    if method is None or method is not raised.source.callback:
        return None
    return raised.finding("callback_parameter", at=method, name=match["name"])


def logger_arguments(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The logger gets several strings, which only print accepts."""
    del match
    calls = (call for call, _ in raised.source.calls if raised.source.is_log(call))
    logs = [call for call in calls if len(call.args) > 1]
    return raised.finding("logger_arguments", at=logs[0]) if logs else None


def spun_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The class is spun instead of the node."""
    del match
    for call, name in raised.source.calls:
        given = dotted(call.args[0]) if call.args else ""
        if last_part(name) == "spin" and _is_class(raised, given):
            return raised.finding("spin_of_class", at=call, name=given)
    return None


def uncalled_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """No node is created: the class is named but not called."""
    del match
    for node in raised.source.all_nodes:
        if isinstance(node, ast.Assign) and _is_class(raised, dotted(node.value)):
            return raised.finding("class_not_called", at=node, name=dotted(node.value))
    return None


def _is_class(raised: Raised, name: str) -> bool:
    """Return whether a name is that of a class of the files, the node's or another."""
    return name in raised.source.known_classes or last_part(name) in raised.source.class_names


def init_twice(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """Rclpy is initialised a second time."""
    del match
    inits = [call for call, name in raised.source.calls if name == "rclpy.init"]
    return raised.finding("init_twice", at=inits[1] if len(inits) > 1 else None)
