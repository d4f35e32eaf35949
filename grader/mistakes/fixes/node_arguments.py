"""Fixes of arguments: a comma in a number, one argument too many, names that do not exist."""

from __future__ import annotations

import ast
import re

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.node_classes import has_self
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.source.names import called_name, dotted
from grader.package.source.node import NodeSource

LOGS = {"loginfo": "info", "logdebug": "debug", "logwarn": "warning", "logerr": "error"}
COMMA = re.compile(r"(\d{1,9})[ \t]{0,9},[ \t]{0,9}(\d{1,9})")


def with_comma(source: NodeSource, call: ast.Call) -> tuple[str, str] | None:
    """Return a timer's period that is written with a comma, as it is and with a point."""
    if len(call.args) < 3 or not all(_is_number(given) for given in call.args[:2]):
        return None
    text = source.module_of(call).text
    match = COMMA.fullmatch(text.text[text.span(call.args[0])[0] : text.span(call.args[1])[1]])
    return (match[0], f"{match[1]}.{match[2]}") if match is not None else None


def _is_number(given: ast.expr) -> bool:
    return isinstance(given, ast.Constant) and type(given.value) is int


def decimal_point(case: Case) -> Files | None:
    """Write the period of the timer with a point."""
    node = case.node
    call = node.timer_call if node is not None else None
    found = with_comma(node, call) if node is not None and call is not None else None
    if node is None or call is None or found is None:
        return None
    module = node.module_of(call)
    start, end = module.text.span(call.args[0])[0], module.text.span(call.args[1])[1]
    return case.changed(module, Splice(start, end, found[1]))


def third(case: Case) -> Files | None:
    """Remove self from the end of the arguments of create_timer."""
    node = case.node
    call = node.timer_call if node is not None else None
    if node is None or call is None or len(call.args) != 3 or dotted(call.args[2]) != "self":
        return None
    module = node.module_of(call)
    callback = call.args[1]
    start, end = module.text.span(callback)[1], module.text.span(call.args[2])[1]
    owner, _, name = dotted(callback).rpartition(".")
    bound = [module.text.swap(callback, f"self.{name}")] if owner in node.class_names else []
    return case.changed(module, *bound, Splice(start, end, ""))


def without_names(case: Case) -> Files | None:
    """Pass the period and the callback to create_timer without names."""
    node = case.node
    call = node.timer_call if node is not None else None
    values = [given.value for given in call.keywords] if call is not None else []
    if node is None or call is None or call.args or len(values) != 2:
        return None
    number = isinstance(values[0], ast.Constant) and type(values[0].value) in (int, float)
    if not number or not dotted(values[1]).startswith("self."):
        return None
    module = node.module_of(call)
    splices = []
    for given in call.keywords:
        start = module.text.span(given)[0]
        splices.append(Splice(start, module.text.span(given.value)[0], ""))
    return case.changed(module, *splices)


def without_option(case: Case) -> Files | None:
    """Remove an option that the logger does not have."""
    node = case.node
    call = node.log_call if node is not None else None
    if node is None or call is None or len(call.keywords) != 1:
        return None
    if call.keywords[0].arg != case.finding.params.get("name"):
        return None
    module = node.module_of(call)
    start, end = module.text.span(call.args[0])[1], module.text.span(call.keywords[0])[1]
    return case.changed(module, Splice(start, end, ""))


def ros_2_log(case: Case) -> Files | None:
    """Log with the node's logger instead of the functions of ROS 1."""
    node, module = case.node, case.module
    if node is None or module is None:
        return None
    splices = []
    for call in node.calls_of(*LOGS):
        function = node.function_around(call)
        method = function is not None and function in node.own_methods and has_self(function)
        if not method or dotted(call.func) != f"rclpy.{called_name(call)}" or len(call.args) != 1:
            return None
        splices.append(module.text.swap(call.func, f"self.get_logger().{LOGS[called_name(call)]}"))
    return case.changed(module, *splices)


def ros_2_timer(case: Case) -> Files | None:
    """Create the node's timer instead of the one of ROS 1."""
    node, module = case.node, case.module
    calls = node.calls_of("Timer") if node is not None else []
    if node is None or module is None or len(calls) != 1 or dotted(calls[0].func) != "rospy.Timer":
        return None
    function, given = node.function_around(calls[0]), calls[0].args
    method = function is not None and function in node.own_methods and has_self(function)
    period = given[0].args if given and isinstance(given[0], ast.Call) else []
    if not method or len(given) != 2 or len(period) != 1:
        return None
    if dotted(given[0]) != "rospy.Duration()":
        return None
    return case.changed(
        module,
        module.text.swap(calls[0].func, "self.create_timer"),
        module.text.swap(given[0], module.text.code(period[0])),
    )


def only_name(case: Case) -> Files | None:
    """Pass only the node's name to super().__init__(), if the error is about a constructor."""
    said = f"{case.finding.actual} {case.finding.params}"
    node = case.node if "__init__" in said else None
    owner = re.search(r"TypeError: (\w+)\.__init__\(\)", said)
    if node is not None and owner is not None and owner[1] not in {"Node", *node.class_names}:
        return None
    call = node.super_init if node is not None else None
    if node is None or call is None or dotted(call.func) != "super().__init__":
        return None
    module = node.module_of(call)
    end = module.text.span(call)[1] - 1
    return case.changed(
        module,
        Splice(module.text.span(call.func)[1] + 1, end, repr(case.assignment.node_name)),
    )


def without_init_node(case: Case) -> Files | None:
    """Delete the line that calls init_node."""
    node, module = case.node, case.module
    calls = node.calls_of("init_node") if node is not None else []
    if module is None or len(calls) != 1 or dotted(calls[0].func) != "rclpy.init_node":
        return None
    line = calls[0].lineno
    around = module.parents.get(calls[0])
    if not isinstance(around, ast.Expr) or calls[0].end_lineno != line:
        return None
    if module.line(line) != module.text.code(calls[0]):
        return None
    return case.changed(module, module.text.without(line))
