"""Recognise the mistake behind an exception, from the error, its line and the source."""

from __future__ import annotations

import ast
import builtins
import re
import sys
from collections.abc import Callable
from dataclasses import replace

from grader.base.nearest import nearest
from grader.mistakes import from_call
from grader.mistakes.kind import RecognisedMistake
from grader.mistakes.placeholders import CLASS
from grader.mistakes.symptoms import Raised
from grader.package.source.names import dotted, last_part
from grader.package.source.node import LOG_METHODS

MODULES = ("rclpy", "rclpy.node", "std_msgs", "geometry_msgs", "sensor_msgs", "numpy")
NODE_METHODS = (
    *("create_timer", "get_logger", "get_clock", "get_name", "create_publisher", "destroy_node"),
    *("create_subscription", "create_service", "create_client", "declare_parameter"),
    *("get_parameter", "destroy_timer", "create_rate", "get_namespace"),
)
RCLPY = ("init", "spin", "spin_once", "shutdown", "try_shutdown", "ok", "create_node", "logging")
IMPORTS = {"Node": "from rclpy.node import Node", "rclpy": "import rclpy"}


Recognise = Callable[[Raised, re.Match[str]], RecognisedMistake | None]


def recognise(raised: Raised) -> RecognisedMistake | None:
    """Return the mistake behind an exception, or None if it is unknown."""
    for pattern, function in RECOGNISERS:
        match = re.search(pattern, raised.error)
        found = function(raised, match) if match else None
        if found is not None:
            return found
    return None


def _always(slug: str) -> Recognise:
    def found(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
        return raised.finding(slug, params=match.groupdict(""))

    return found


def _private(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    call = raised.source.super_init
    if match["type"] not in raised.source.known_classes:
        return None
    if call is None:
        return raised.finding("super_missing")
    return raised.finding("super_late", at=call)


def _no_name(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    del match
    methods = raised.source.methods
    near = nearest("__init__", methods, cutoff=0.7)
    if "__init__" not in methods and near:
        return raised.finding("init_underscores", at=methods[near], name=near)
    return raised.finding("super_without_name")


def _not_a_node(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    del match
    found = raised.source.node_class
    return raised.finding("not_a_node", at=found, name=found.name if found else CLASS)


def _not_initialized(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    del match
    inits = [c for c, n in raised.source.calls if last_part(n) == "init"]
    return raised.finding("init_late" if inits else "init_missing")


def _no_module(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    name = match["name"]
    close = nearest(name, (*MODULES, *sys.stdlib_module_names), cutoff=0.75)
    return raised.finding("import_misspelt", name=name, close=close)


def _no_name_in_module(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    name, module = match["name"], match["module"]
    known = (*RCLPY, "Node") if module.startswith("rclpy") else ("String", "Twist")
    close = nearest(name, known, cutoff=0.75)
    return raised.finding("import_name", name=name, close=close, module=module)


def _undefined(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    name, source, module = match["name"], raised.source, raised.module
    if name == "self":
        return raised.finding("timer_at_class_level")
    if name in IMPORTS and name not in module.imports:
        return raised.finding("import_missing", name=name, statement=IMPORTS[name])
    if name in source.methods:
        return raised.finding("callback_without_self_dot", name=name)
    close = nearest(name, {*module.names, *dir(builtins), *IMPORTS}, cutoff=0.7)
    return raised.finding("name_unknown", name=name, close=close)


def _no_main(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    function = raised.assignment.function
    if match["function"] != function:
        return None
    functions = raised.source.entry.functions
    close = nearest(function, functions)
    if close:
        return raised.finding("main_misspelt", at=functions[close], name=close, close=function)
    return raised.finding("main_missing")


def _main_wants(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if match["function"] != raised.assignment.function:
        return None
    return raised.finding("main_wants_args", at=raised.source.main)


def _attribute(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    kind, name, source = match["type"], match["name"], raised.source
    if kind not in source.known_classes:
        return None
    line = raised.module.line(raised.line)
    if line and f"self.{name}" not in line:
        return None  # the attribute is not accessed through self
    for timer in source.timers:
        if timer.method == name:
            return _callback(raised, name)
    close = nearest(name, source.attributes, cutoff=0.75)
    if not close:
        near = nearest(name, {*NODE_METHODS, *source.methods}, cutoff=0.75)
        if near:
            return raised.finding("method_misspelt", name=name, close=near)
    return raised.finding("attribute_not_set", name=name, close=close)


def _callback(raised: Raised, name: str) -> RecognisedMistake:
    source = raised.source
    init = source.methods.get("__init__")
    for node in ast.walk(init) if init else ():
        if isinstance(node, ast.FunctionDef) and node.name == name:
            return raised.finding("callback_in_init", at=node, name=name)
    close = nearest(name, [m for m in source.methods if m != "__init__"])
    found = raised.finding("callback_misspelt", name=name, close=close)
    return replace(found, words={**found.words, "callback": close or name})


def _other_attribute(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    name = match["name"]
    known = RCLPY if match["type"] == "rclpy" else (*NODE_METHODS, *LOG_METHODS)
    close = nearest(name, known, cutoff=0.7)
    slug = "method_misspelt" if close else "attribute_unknown"
    return raised.finding(slug, name=name, close=close)


def _concatenated(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    del match
    name = str(raised.words["counter"])
    for node in raised.module.nodes:
        if isinstance(node, ast.BinOp) and raised.line in range(
            node.lineno, (node.end_lineno or node.lineno) + 1
        ):
            name = dotted(node.right) or dotted(node.left) or name
    return raised.finding("str_plus_int", name=name)


def _step_is_text(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    for node in raised.source.all_nodes:
        if isinstance(node, ast.AugAssign) and isinstance(node.value, ast.Constant):
            step, name = node.value.value, dotted(node.target)
            if isinstance(step, str) and name:
                return raised.finding("step_is_text", at=node, name=name, step=step)
    return None


ATTRIBUTE = r"AttributeError: '(?P<type>\w{1,120})' object has no attribute "
RECOGNISERS: tuple[tuple[str, Recognise], ...] = (
    (r"\w", from_call.spun_class),
    (r"InvalidNodeNameException", _always("name_invalid")),
    (ATTRIBUTE + r"'_\w{1,120}'", _private),
    (r"Node\.__init__\(\) missing 1 required positional argument: 'node_name'", _no_name),
    (r"object\.__init__\(\) takes exactly one argument", _not_a_node),
    (r"NotInitializedException", _not_initialized),
    (r"cannot import name 'Node' from 'rclpy'", _always("import_node")),
    (r"No module named '(?P<name>[\w.]{1,200})'", _no_module),
    (r"cannot import name '(?P<name>\w{1,120})' from '(?P<module>[\w.]{1,200})'",
     _no_name_in_module),
    (r"NameError: (?:free variable|name) '(?P<name>\w{1,120})'", _undefined),
    (r"AttributeError: module '[\w.]{1,200}' has no attribute '(?P<function>\w{1,120})'", _no_main),
    (r"(?<![\w.])(?P<function>\w{1,120})\(\) missing \d{1,3} required positional", _main_wants),
    (r"context manager protocol|AttributeError: __enter__", _always("context_manager")),
    (r"'(?:function|method)' object has no attribute '(?:info|debug|warn|warning|error|fatal)'",
     _always("logger_not_called")),
    (ATTRIBUTE + r"'(?P<name>\w{1,120})'", _attribute),
    (r"AttributeError: (?:module |type object )?'(?P<type>[\w.]{1,200})'(?: object)? has no "
     r"attribute '(?P<name>\w{1,120})'", _other_attribute),
    (r"'NoneType' object is not callable|'arg_name'|is not a callable object", from_call.called),
    (r"float\(\) argument must be|must be real number|not '?(?:method|function)'?", from_call.swapped),
    (r"could not convert string to float: (?P<text>'[^'\n]{0,60}')", _always("period_text")),
    (r"create_timer\(\) missing", _always("timer_argument_missing")),
    (r"(?:(?P<function>\w{1,120})\(\) )?takes 0 positional arguments but 1 was given"
     r"|invalid method signature", from_call.no_self),
    (r"argument: 'self'|'property' object is not iterable", from_call.uncalled_class),
    (r"Context\.init\(\) must only be called once", from_call.init_twice),
    (r"descriptor '__init__' requires a 'super' object", _always("super_not_called")),
    (r"'(?P<type>int|float|str)' object is not callable", _always("not_callable")),
    (r"unsupported operand type\(s\) for \+=: '(?:int|float)' and 'str'", _step_is_text),
    (r"\.(?P<function>\w{1,120})\(\) missing \d{1,3} required positional arguments?: "
     r"'(?P<name>\w{1,120})'", from_call.parameter),
    (r"can only concatenate str|unsupported operand type\(s\) for \+: '(?:int|float)' and 'str'",
     _concatenated),
    (r"UnboundLocalError: .{0,60}'(?P<name>\w{1,120})'", _always("counter_local")),
    (r"takes (?:from \d{1,3} to )?\d{1,3} positional arguments? but \d{1,3} were given",
     from_call.logger_arguments),
    (r"TypeError: (?P<function>[\w.]{1,200})\(\) missing \d{1,3} required positional arguments?: "
     r"'(?P<name>\w{1,120})'", _always("argument_missing")),
)  # fmt: skip
