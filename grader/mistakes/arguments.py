"""Mistakes in the arguments of a call, and calls of functions that only ROS 1 has."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.constructor import lines_of
from grader.mistakes.ends import ends
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines, node_arguments, node_log
from grader.mistakes.kind import Family
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace, Write
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted, last_part, own_name
from grader.package.source.node import NodeSource
from grader.package.source.node_here import node_here

LOGGER_OPTION = (
    r"TypeError: parameter \"(?P<name>\w{1,120})\" is not one of the recognized logging options"
)
UNEXPECTED = (
    r"TypeError: (?P<function>[\w.]{1,200})\(\) got an unexpected keyword argument "
    r"'(?P<name>\w{1,120})'"
)
ROS_1 = {
    "loginfo": "self.get_logger().info(…)",
    "logdebug": "self.get_logger().debug(…)",
    "logwarn": "self.get_logger().warning(…)",
    "logerr": "self.get_logger().error(…)",
    "logfatal": "self.get_logger().fatal(…)",
    "Publisher": "self.create_publisher(…)",
    "Subscriber": "self.create_subscription(…)",
    "Timer": "self.create_timer(seconds, callback)",
    "Rate": "self.create_timer(…)",
    "Service": "self.create_service(…)",
    "get_param": "self.get_parameter(…)",
}
"""What ROS 2 has instead of the functions and classes of rospy."""
OF_BOTH = ("init", "node", "ok", "create_node", "spin_once", "shutdown", "Node")
"""Names that rclpy has: with these, rospy is a wrong name of rclpy."""

OF_ROS_1 = """#!/usr/bin/env python3
import rospy

counter = 0


def timer_callback(event):
    global counter
    rospy.loginfo('Hello time: ' + str(counter))
    counter += 1


def main():
    rospy.init_node('my_first_node')
    rospy.Timer(rospy.Duration(1.0), timer_callback)
    rospy.spin()
"""


def _many(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    for timer in raised.source.timers:
        if raised.line not in (None, *lines_of(timer.call)):
            continue
        written = node_arguments.with_comma(raised.source, timer.call)
        found = raised.finding("timer_arguments_many", at=timer.call)
        if written is not None:
            params = {"name": written[0]}
            words = {**found.words, **params, "written": written[1]}
            return replace(found, variant="comma", params=params, words=words)
        return found if len(timer.call.args) > 2 else None
    return None


def _own_init(source: NodeSource) -> bool:
    """Whether the node's class has no __init__, but a method that is called so without underscores."""
    names = {name.strip("_") for name in source.methods}
    return "__init__" not in source.methods and "init" in names


def _keyword(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name, function = match["name"], last_part(match["function"])
    if match["function"] == "Node.__init__" and _own_init(raised.source):
        return None  # (that method should be __init__)
    found = raised.finding("keyword_unknown", name=name, function=function)
    if match["function"] == "Node.__init__":
        return replace(found, variant="super")
    timers = [t.call for t in raised.source.timers if raised.line in lines_of(t.call)]
    given = [value for call in timers for value in (*call.args, *(k.value for k in call.keywords))]
    own = any(own_name(value) in raised.source.methods for value in given)
    return replace(found, variant="timer") if function == "create_timer" and own else found


def _option(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    found = raised.finding("keyword_unknown", name=match["name"], function="info")
    return replace(found, variant="logger")


def _rospy(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A function of rospy is called, which nothing imports."""
    used = re.search(r"\brospy\.(?P<name>\w{1,120})", raised.module.line(raised.line))
    if match["name"] != "rospy" or used is None:
        return None
    found = _of_ros_1(raised, used["name"])
    variant = found.variant or ("rospy" if used["name"] in ROS_1 else "rospy_other")
    return replace(found, variant=variant)


def _used_of_rospy(module: Module) -> list[str]:
    """Return what a file uses of rospy that rclpy does not have, in order."""
    found: list[tuple[int, str]] = []
    for node in module.nodes:
        if isinstance(node, ast.Attribute) and dotted(node.value) == "rospy":
            call = module.parents.get(node)
            spins = node.attr == "spin" and isinstance(call, ast.Call) and bool(call.args)
            found += [] if spins else [(node.lineno, node.attr)]
        elif isinstance(node, ast.ImportFrom) and node.module == "rospy":
            found += [(node.lineno, alias.name) for alias in node.names]
    return [name for _, name in sorted(found) if name not in OF_BOTH]


def _for_ros_1(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The file is written for rospy, or uses it beside rclpy."""
    del match
    used = _used_of_rospy(raised.module)
    if not used:
        return None
    name = next((each for each in used if each in ROS_1), used[0])
    found = raised.finding("for_ros_1", name=name, written=ROS_1.get(name, ""))
    if not raised.source.uses_ros:
        return found
    return replace(found, variant="part" if name in ROS_1 else "part_other")


def _many_given(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A call gives more arguments than the function takes."""
    name, call = last_part(match["function"]), raised.source.super_init
    if match["function"].partition(".")[0] not in {"Node", *raised.source.known_classes}:
        return None
    if any(t.called and raised.line == t.call.lineno for t in raised.source.timers):
        return None  # (the callback is called where it is passed)
    found = raised.finding("arguments_many", name=name)
    if match["function"] == "Node.__init__" and call is not None:
        if call.args and dotted(call.args[0]) == "self":
            return None  # (super() passes self on its own)
        return replace(found, variant="super") if raised.line in lines_of(call) else found
    if raised.inside:
        return _called_by_ros(raised, match["function"])
    return _only_self(raised, match["function"]) or found


def _called_by_ros(raised: Raised, function: str) -> RecognisedMistake | None:
    """The method is the callback of a subscription, and has no parameter for the message."""
    owner, _, method = function.rpartition(".")
    taken = _defs(raised.source, owner, method)
    ways = [end.kind for end in ends(raised.source) if end.method == method]
    if ways != ["create_subscription"] or len(taken) != 1 or len(taken[0].args.args) != 1:
        return None
    return replace(raised.finding("arguments_many", at=taken[0], name=method), variant="message")


def _defs(source: NodeSource, owner: str, method: str) -> list[Function]:
    """Return the defs of a method of a class."""
    classes = [c for module in source.modules for c in module.classes if c.name == owner]
    return [m for c in classes for m in c.body if isinstance(m, Function) and m.name == method]


def _without_self(raised: Raised, taken: Function) -> RecognisedMistake | None:
    """The method has no self: the object goes into its first parameter."""
    first = taken.args.args[0].arg
    calls = [c for c, name in raised.source.calls if last_part(name) == taken.name]
    here = [c for c in calls if raised.line in lines_of(c)]
    if len(here) != 1 or taken.decorator_list or len(here[0].args) != len(taken.args.args):
        return None
    params = {"name": f"{taken.name}({first}", "written": f"{taken.name}(self, {first}"}
    found = raised.finding("arguments_many", at=taken, params=params)
    words = {**found.words, "method": taken.name, "parameter": first}
    row = raised.source.module_of(taken).line(taken.lineno)
    words["head"] = row.replace(params["name"], params["written"], 1)
    return replace(found, variant="no_self", words=words)


def _only_self(raised: Raised, function: str) -> RecognisedMistake | None:
    """The function is a method of the student's that takes only self."""
    owner, _, method = function.rpartition(".")
    taken = _defs(raised.source, owner, method)
    if len(taken) == 1 and taken[0].args.args and taken[0].args.args[0].arg not in ("self", "this"):
        return _without_self(raised, taken[0])
    if len(taken) != 1 or len(taken[0].args.args) != 1 or taken[0].args.vararg is not None:
        return None
    wanted = owner if method == "__init__" else method
    for call, name in raised.source.calls:
        if raised.line in lines_of(call) and last_part(name) == wanted and call.args:
            text = raised.source.module_of(call).text
            code, written = text.code(call), f"{text.code(call.func)}()"
            found_call = raised.finding("arguments_many", at=call, name=code, written=written)
            return replace(found_call, variant="only_self")
    return None


def _ros_1(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    known = match["name"] in ROS_1 or match["name"] == "init_node"
    return _of_ros_1(raised, match["name"]) if known else None


def _outside(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """What belongs to the text is behind the closing bracket of the logger or of print."""
    del match
    return _text_outside(Suspect(raised.source, raised.assignment), raised.module, raised.line)


def _outside_unseen(suspect: Suspect) -> RecognisedMistake | None:
    """The same, where Python can add to what the logger returns."""
    for call in suspect.source.own_logs:
        found = _text_outside(suspect, suspect.source.module_of(call), call.lineno)
        if found is not None:
            return found
    return None


def _text_outside(suspect: Suspect, module: Module, line: int | None) -> RecognisedMistake | None:
    found = node_log.text_outside(suspect.source, module, line)
    if found is None:
        return None
    call, after = found
    written = node_log.text_inside(module, call, after) or ""
    outside = module.text.code(after)[len(module.text.code(call)) :].strip()
    params = {"name": last_part(dotted(call.func)), "outside": shown(outside)}
    mistake = suspect.finding("text_outside", after, **params)
    one_line = written and "\n" not in written
    words = {**mistake.words, "written": written}
    return replace(mistake, variant="written" if one_line else "", words=words)


def _of_ros_1(raised: Raised, name: str) -> RecognisedMistake:
    """Return what ROS 2 has instead of a name of rospy, as this line can call it."""
    node = node_here(raised.source, raised.module, raised.line) or "node"
    new = re.sub(r"\Aself\.", f"{node}.", ROS_1.get(name, ""))
    found = raised.finding("ros_1", name=name, written=new)
    variant = {"Rate": "rate", "spin": "spin", "init_node": "init_node"}.get(name, "")
    return replace(found, variant=variant, words={**found.words, "node": node})


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "for_ros_1",
        "start",
        msg("The file is written for ROS 1"),
        msg(
            "rospy is the Python library of ROS 1. ROS 2 does not have it: its library is rclpy, "
            "which has other functions and classes. Another name in the import is not enough."
        ),
        msg(
            "Write the node anew for ROS 2. Import it: import rclpy and from rclpy.node import "
            "Node. Write a class that inherits from Node. In its __init__: "
            "super().__init__('{node_name}') and self.create_timer({period}, self.{callback}). In "
            "its method {callback}: self.get_logger().info(…). In {function}: rclpy.init(), an "
            "object of your class, and rclpy.spin(node)."
        ),
        fixes={
            "part": msg(
                "Delete the import of rospy, and write {written} instead of rospy.{name}. Replace "
                "all other uses of rospy too."
            ),
            "part_other": msg("Delete the import of rospy, and all lines that use it."),
        },
        raised={r"No module named 'rospy'": _for_ros_1},
        examples=(
            example("node_of_ros_1", Write(NODE, OF_ROS_1), fails="run.starts"),
            example(
                "loginfo_of_rospy",
                Replace(NODE, "import rclpy\nfrom", "import rclpy\nimport rospy\nfrom"),
                Replace(NODE, "self.get_logger().info", "rospy.loginfo"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "ros_1",
        "callback",
        msg("A function of ROS 1 is used"),
        msg(
            "{name} belongs to rospy, the Python library of ROS 1. In ROS 2 the node itself has "
            "methods for this."
        ),
        msg("Write {written} instead of rclpy.{name}."),
        whys={
            "rate": msg(
                "Rate belongs to rospy, the Python library of ROS 1, where a loop waits with it. In "
                "ROS 2, a timer calls a function once in each period, and spin waits for the timer."
            ),
        },
        fixes={
            "rate": msg(
                "Write the lines of the loop that log and count into a function of their own, and let "
                "a timer call it: {node}.create_timer({period}, and the name of that function). Then "
                "write rclpy.spin({node}) instead of the loop, and delete this line."
            ),
            "init_node": msg(
                "Delete the line with init_node: in ROS 2, super().__init__('{node_name}') gives "
                "the node its name."
            ),
            "rospy": msg("Write {written} instead of rospy.{name}."),
            "rospy_other": msg("Remove rospy.{name}: ROS 2 has no rospy."),
            "spin": msg("Write rclpy.spin({node}) instead of rospy.spin()."),
        },
        seen=r"AttributeError: module 'rclpy' has no attribute '(?P<name>loginfo)'",
        raised={
            r"module 'rclpy' has no attribute '(?P<name>\w{1,120})'": _ros_1,
            NAME_ERROR: _rospy,
        },
        examples=(
            example(
                "loginfo_of_ros_1",
                Replace(NODE, "self.get_logger().info", "rclpy.loginfo"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "timer_of_rospy",
                Replace(NODE, "self.create_timer(1.0,", "rospy.Timer(rospy.Duration(1.0),"),
                fails="run.starts",
            ),
            example(
                "init_node_of_ros_1",
                Replace(
                    NODE,
                    "node = MyFirstNode()",
                    "node = MyFirstNode()\n    rclpy.init_node('my_first_node')",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "timer_arguments_many",
        "timer",
        msg("create_timer gets more than a period and a callback"),
        msg(
            "create_timer takes the period first, then the callback. Commas separate arguments. A "
            "third argument would be a callback group."
        ),
        msg("Write self.create_timer({period}, self.{callback})"),
        fixes={
            "comma": msg(
                "Write {written} instead of {name}: a decimal number has a point in Python. With "
                "the comma it is two arguments."
            ),
        },
        raised={
            "has no attribute 'add_entity'": _many,
            r"create_timer\(\) takes from \d to \d positional arguments but": _many,
        },
        fixed_by=(node_arguments.decimal_point,),
        examples=(
            example("decimal_comma", Replace(NODE, "(1.0,", "(1,0,"), fails="run.starts"),
            example(
                "third_argument_of_timer",
                Replace(NODE, "self.timer_callback)", "self.timer_callback, self)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "text_outside",
        "logger",
        msg("A part of the text is behind the closing bracket"),
        msg(
            "Python calls {name} first, and then uses {outside} on what {name} returns, which is "
            "no text."
        ),
        msg("Move {outside} into the brackets of {name}, directly behind the text."),
        links.PYTHON_STRINGS,
        fixes={"written": msg("Move {outside} into the brackets of {name}: {written}")},
        seen=r"AttributeError: '(?:bool|NoneType)' object has no attribute 'format'",
        raised={
            r"'(?:bool|NoneType)' object has no attribute '\w{1,120}'": _outside,
            r"unsupported operand type\(s\) for [+%]: '(?:bool|NoneType)' and": _outside,
            r"ZeroDivisionError: ": _outside,
        },
        behind={"run.wrong_text": _outside_unseen},
        fixed_by=(node_log.moved_inside,),
        examples=(
            example(
                "format_outside",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_))",
                    "'Hello time: {}').format(self.counter_)",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "plus_outside",
                Replace(NODE, "'Hello time: ' + str", "'Hello time: ') + (str"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "number_added_outside",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_))",
                    "'Hello time: ') + self.counter_",
                ),
                fails="run.output",
            ),
            example(
                "percent_outside",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_))",
                    "'Hello time: %d') % self.counter_",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "arguments_many",
        "callback",
        msg("A call has too many arguments"),
        msg("{name} takes fewer arguments than this call gives it. Python passes self on its own."),
        msg("Remove what is too much from the () of {name}."),
        links.PYTHON_ERRORS,
        whys={
            "only_self": msg(
                "The def has only self in its brackets, which Python passes on its own."
            ),
            "message": msg(
                "A subscription calls its callback with one value after self: the message. The def of {name} "
                "has no parameter for it."
            ),
            "no_self": msg(
                "The def of {method} has no self. Python passes the object as the first argument, so "
                "{parameter} gets the object, and the value of the call has no place."
            ),
        },
        fixes={
            "message": msg("Write: def {name}(self, msg):"),
            "no_self": msg("Write self before {parameter} in this line: {head}"),
            "super": msg("Write super().__init__('{node_name}')."),
            "only_self": msg("Write {written} instead of {name}."),
        },
        raised={
            (
                r"TypeError: (?P<function>\w{1,120}\.\w{1,120})\(\) takes [1-9] positional "
                r"arguments? but \d{1,2} were given"
            ): _many_given
        },
        fixed_by=(node_arguments.only_name, lines.written),
        examples=(
            example(
                "name_given_where_made",
                Replace(NODE, "node = MyFirstNode()", "node = MyFirstNode('my_first_node')"),
                fails="run.starts",
            ),
            example(
                "two_names_for_node",
                Replace(NODE, "('my_first_node')", "('my_first_node', 'robot')"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "keyword_unknown",
        "callback",
        msg("A call names a parameter that the function does not have"),
        msg("name=value in a call works only for names that the function knows."),
        msg(
            "Look up the parameters of {function}: write the right name instead of {name}, or remove {name}=…"
        ),
        links.PYTHON_ERRORS,
        fixes={
            "timer": msg("Write self.create_timer({period}, self.{callback})"),
            "logger": msg("Remove {name}=…: the logger does not have this option."),
            "super": msg("Write super().__init__('{node_name}')."),
        },
        raised={UNEXPECTED: _keyword, LOGGER_OPTION: _option},
        fixed_by=(
            node_arguments.without_names,
            node_arguments.without_option,
            node_arguments.only_name,
            lines.written,
        ),
        examples=(
            example(
                "keyword_of_node",
                Replace(NODE, "('my_first_node')", "(name='my_first_node')"),
                fails="run.starts",
            ),
            example(
                "keyword_of_timer",
                Replace(
                    NODE, "(1.0, self.timer_callback)", "(period=1.0, callback=self.timer_callback)"
                ),
                fails="run.starts",
            ),
            example(
                "print_argument",
                Replace(NODE, "str(self.counter_))", "str(self.counter_), end='')"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
