"""Example values for the placeholders of the catalogue, for texts about no particular package."""

from __future__ import annotations

from collections.abc import Mapping

from grader.base.i18n.message import Value
from grader.course.assignment import Assignment
from grader.mistakes.placeholders import CALLBACK, EXAMPLE, placeholder_values

NAMES: Mapping[str, Value] = {
    **EXAMPLE,
    "before": "talker = my_package.talker:main",
    "close": "create_timer",
    "executable": "my_node",
    "file": "my_node.py",
    "debian": "turtlesim",
    "folder": "my_package/my_node",
    "key": "script_dir",
    "line": "Count: 0",
    "name": "MyNode",
    "node": "node",
    "node_name": "my_node",
    "package": "my_package",
    "path": "my_package/my_node.py",
    "period": "1.0",
    "topic": "/chatter",
    "service": "/reset",
    "short": "String",
    "type": "double",
    "make": "create_service",
    "module": "xml.dom.Node",
    "turtle": "turtle1",
    "radius": "2",
    "callback": CALLBACK,
    "start": 0,
    "statement": "from rclpy.node import Node",
    "step": 1,
    "tag": "name",
    "there": "my_package/my_nod.py",
    "value": 0,
    "wanted": "my_node = my_package.my_node:main",
    "written": 1000,
}
COUNTER: Mapping[str, Value] = {"name": "self.counter"}
BARE_COUNTER: Mapping[str, Value] = {"name": "counter"}
OF_KIND: Mapping[str, Mapping[str, Value]] = {
    "package.setup_cfg_wrong": {"wanted": "$base/lib/my_package"},
    "topic.wrong_name": {"name": "/chater"},
    "topic.wrong_end": {"call": "create_subscription"},
    "interface.cmake_error": {"line": "9"},
    "topic.wrong_type": {"wanted": "std_msgs/msg/String"},
    "topic.wrong_period": {"wanted": "0.5"},
    "topic.wrong_value": {"wanted": "2", "field": "linear.x"},
    "world.wrong_request": {"field": "off"},
    "action.wrong_feedback": {"field": "remaining"},
    "action.wrong_result": {"field": "delta"},
    "action.wrong_status": {"wanted": "succeeded"},
    "interface.file_missing": {"path": "msg/Distance.msg", "package": "my_interfaces"},
    "interface.not_generated": {"path": "msg/Distance.msg", "package": "my_interfaces"},
    "interface.inside": {"package": "my_interfaces"},
    "interface.not_cmake": {"package": "my_interfaces"},
    "interface.missing": {"name": "my_interfaces"},
    "beside.missing": {"package": "my_listener"},
    "beside.not_python": {"package": "my_listener"},
    "interface.field_name": {"name": "totalDistance"},
    "interface.field_missing": {"type": "float64", "field": "distance"},
    "interface.field_type": {"type": "float64", "field": "distance"},
    "topic.wrong_qos": {"wanted": "best_effort"},
    "parameter.not_declared": {"name": "radius", "close": "Radius"},
    "parameter.wrong_type": {"name": "radius"},
    "parameter.wrong_value": {"name": "radius", "wanted": "2"},
    "parameter.refused": {"name": "radius"},
    "service.wrong_name": {"name": "/rest"},
    "service.wrong_type": {"short": "Trigger"},
    "service.missing": {"short": "Trigger"},
    "service.no_client": {"short": "Trigger"},
    "node.other_message": {"name": "Twist", "wanted": "Vector3"},
    "node.end_arguments": {"name": "create_publisher"},
    "node.message_class": {"name": "Twist"},
    "node.callback_without_message": {"name": "on_message"},
    "source.misplaced_node_file": {"wanted": "my_package/my_node.py"},
    "run.wrong_node_name": {"wanted": "my_node"},
    "lab.not_installed": {"package": "turtlesim"},
    "node.main_misspelt": {"name": "mian"},
    "node.waits_first": {"name": "input()"},
    "node.init_underscores": {"name": "_init_"},
    "node.method_misspelt": {"name": "creat_timer"},
    "node.method_twice": {"name": "__init__", "line": "12"},
    "node.variable_for_self": {"name": "node"},
    "node.callback_of_class": {"name": "MyNode.callback", "method": "callback"},
    "node.plain_node": {"name": "Node", "made": "MyNode"},
    "node.lambda_not_called": {"name": "self.callback"},
    "node.base_called": {"base": "Node"},
    "node.ros_1": {"name": "loginfo", "written": "self.get_logger().info(…)"},
    "node.keyword_unknown": {"name": "period", "function": "create_timer"},
    "node.name_hides_function": {"name": "str"},
    "node.start_is_text": COUNTER,
    "node.argument_missing": {"name": "args", "function": "main"},
    "node.callback_never_ends": {"name": "while True"},
    "node.exits": {"name": "sys.exit()"},
    "node.attribute_not_set": BARE_COUNTER,
    "node.counter_local": BARE_COUNTER,
    "node.str_plus_int": COUNTER,
    "node.step_is_text": COUNTER,
    "node.plus_reversed": COUNTER,
    "node.counter_not_increased": COUNTER,
    "node.counter_reset": COUNTER,
    "node.adds_before_log": COUNTER,
    "node.starts_elsewhere": COUNTER,
    "node.adds_twice": COUNTER,
    "node.other_step": COUNTER,
    "node.counter_multiplied": COUNTER,
    "node.node_not_kept": {"name": "node", "made": "MyNode"},
    "node.used_before_set": {"name": "node"},
    "node.counter_global": {"name": "counter", "word": "global"},
    "node.cleanup_early": {"name": "rclpy.shutdown()"},
    "node.quotes_missing": {"name": "my_node"},
    "node.self_missing": {"name": "create_timer"},
    "node.rate_sleep": {"name": "rate.sleep"},
    "node.log_option": {"name": "once"},
    "node.sum_not_kept": COUNTER,
    "node.other_language": {"name": "null"},
    "node.value_forgotten": {"name": "%d", "written": "self.counter"},
    "node.callback_outside": {"name": "callback"},
    "node.base_not_class": {"name": "node", "written": "Node"},
    "node.spin_of_other": {"name": "'my_node'", "written": "node"},
    "node.callback_text": {"name": "'self.callback'", "written": "self.callback"},
    "node.text_operator": {"name": "&", "written": "+"},
    "node.name_taken": {"name": "timers"},
    "node.comma_for_dot": {"name": "self,counter", "written": "self.counter"},
    "node.counter_not_number": {"name": "None", "written": "0", "attribute": "self.counter"},
    "node.arguments_many": {"name": "__init__"},
    "node.period_negative": {"name": "-1.0", "written": "1.0"},
    "node.callback_decorated": {"name": "staticmethod"},
    "node.counter_in_text": COUNTER,
    "node.loop_in_callback": {"name": "for"},
    "node.log_if": {"name": "self.counter < 5"},
    "node.count_if": {"name": "self.counter", "text": "self.counter > 0"},
    "node.ends_in_callback": {"name": "rclpy.shutdown()"},
    "node.level_set": {"name": "set_level", "level": "WARN"},
    "node.inner_not_called": {"name": "say_hello"},
    "node.placeholder": {"name": "callback"},
}
"""What differs in the texts of one mistake."""


def example_values(kind: str) -> Mapping[str, Value]:
    """Return a value for every placeholder of a mistake."""
    return {**NAMES, **OF_KIND.get(kind, {})}


def lesson_values(kind: str, assignment: Assignment) -> Mapping[str, Value]:
    """Return the values that a lesson gives to the placeholders of a mistake."""
    path = f"{assignment.package}/{assignment.node_file}"
    wanted = {
        "package.setup_cfg_wrong": f"$base/lib/{assignment.package}",
        "source.misplaced_node_file": path,
        "run.wrong_node_name": assignment.node_name,
    }
    entry = f"{assignment.executable} = {assignment.target}"
    own = {"file": assignment.node_file, "path": path, "wanted": wanted.get(kind, entry)}
    return {**placeholder_values(assignment), **own}
