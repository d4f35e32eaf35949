"""Mistakes in the arguments of a call, and calls of functions that only ROS 1 has."""

from __future__ import annotations

import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.constructor import lines_of
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import node_arguments
from grader.mistakes.kind import Family
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.names import dotted, last_part

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
    "Timer": "self.create_timer(…)",
    "Rate": "self.create_timer(…)",
    "Service": "self.create_service(…)",
    "get_param": "self.get_parameter(…)",
    "is_shutdown": "not rclpy.ok()",
}
"""What ROS 2 has instead of the functions and classes of rospy."""


def _many(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    for timer in raised.source.timers:
        if raised.line not in (None, *range(timer.call.lineno, (timer.call.end_lineno or 0) + 1)):
            continue
        written = node_arguments.with_comma(raised.source, timer.call)
        if written is not None:
            found = raised.finding("timer_arguments_many", at=timer.call, name=written[0])
            words = {**found.words, "written": written[1]}
            return replace(found, variant="comma", words=words)
        if len(timer.call.args) > 2:
            return raised.finding("timer_arguments_many", at=timer.call)
    return None


def _keyword(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    name, function = match["name"], last_part(match["function"])
    found = raised.finding("keyword_unknown", name=name, function=function)
    if match["function"] == "Node.__init__":
        return replace(found, variant="super")
    return replace(found, variant="timer") if function == "create_timer" else found


def _option(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    found = raised.finding("keyword_unknown", name=match["name"], function="info")
    return replace(found, variant="logger")


def _rospy(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A function of rospy is called, which nothing imports."""
    used = re.search(r"\brospy\.(?P<name>\w{1,120})", raised.module.line(raised.line))
    if match["name"] != "rospy" or used is None:
        return None
    name = used["name"]
    if name in ("spin", "init_node"):
        variant = "init_node" if name == "init_node" else "spin"
        return replace(raised.finding("ros_1", name=name), variant=variant)
    new = ROS_1.get(name, "")
    found = raised.finding("ros_1", name=name, written=new)
    return replace(found, variant="rospy" if new else "rospy_other")


def _many_given(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A call gives more arguments than the function takes."""
    name = last_part(match["function"])
    if match["function"].partition(".")[0] not in {"Node", *raised.source.known_classes}:
        return None
    if any(t.called and raised.line == t.call.lineno for t in raised.source.timers):
        return None  # (the callback is called where it is passed)
    found = raised.finding("arguments_many", name=name)
    call = raised.source.super_init
    own = match["function"] == "Node.__init__" and call is not None
    if own and call is not None and call.args and dotted(call.args[0]) == "self":
        return None  # (super() passes self on its own)
    if own and call is not None and raised.line in lines_of(call):
        return replace(found, variant="super")
    return found


def _ros_1(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"]
    if name == "init_node":
        return replace(raised.finding("ros_1", name=name), variant="init_node")
    if name not in ROS_1:
        return None
    return raised.finding("ros_1", name=name, written=ROS_1[name])


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "ros_1",
        "callback",
        msg("A function of ROS 1 is used"),
        msg(
            "{name} belongs to rospy, the Python library of ROS 1. In ROS 2 the node itself has "
            "methods for this."
        ),
        msg("Write {written} instead of rclpy.{name}."),
        fixes={
            "init_node": msg(
                "Delete the line with init_node: in ROS 2, super().__init__('{node_name}') gives "
                "the node its name."
            ),
            "rospy": msg("Write {written} instead of rospy.{name}."),
            "rospy_other": msg("Remove rospy.{name}: ROS 2 has no rospy."),
            "spin": msg("Write rclpy.spin(node) instead of rospy.spin()."),
        },
        seen=r"AttributeError: module 'rclpy' has no attribute '(?P<name>loginfo)'",
        raised={
            r"module 'rclpy' has no attribute '(?P<name>\w{1,120})'": _ros_1,
            NAME_ERROR: _rospy,
        },
        fixed_by=(
            node_arguments.ros_2_log,
            node_arguments.ros_2_timer,
            node_arguments.without_init_node,
        ),
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
        msg("create_timer gets too many arguments"),
        msg("create_timer takes the period first, then the callback. Commas separate arguments."),
        msg("Write create_timer({period}, self.{callback})"),
        fixes={
            "comma": msg(
                "Write {written} instead of {name}: a decimal number has a point in Python. With "
                "the comma it is two arguments."
            )
        },
        raised={"has no attribute 'add_entity'": _many},
        fixed_by=(node_arguments.decimal_point, node_arguments.third),
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
        "arguments_many",
        "callback",
        msg("A call has too many arguments"),
        msg("{name} takes fewer arguments than this call gives it. Python passes self on its own."),
        msg("Remove what is too much from the () of {name}."),
        links.PYTHON_ERRORS,
        fixes={"super": msg("Write super().__init__('{node_name}').")},
        raised={
            (
                r"TypeError: (?P<function>\w{1,120}\.\w{1,120})\(\) takes [1-9] positional "
                r"arguments? but \d{1,2} were given"
            ): _many_given
        },
        fixed_by=(node_arguments.only_name,),
        examples=(
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
        msg("name=value in a call works only for the names in the function's definition."),
        msg("Remove {name}=…, or look up the parameters of {function}."),
        links.PYTHON_ERRORS,
        fixes={
            "timer": msg("Write create_timer({period}, self.{callback})"),
            "logger": msg("Remove {name}=…: the logger does not have this option."),
            "super": msg("Write super().__init__('{node_name}')."),
        },
        raised={UNEXPECTED: _keyword, LOGGER_OPTION: _option},
        fixed_by=(
            node_arguments.without_names,
            node_arguments.without_option,
            node_arguments.only_name,
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
