"""The fix in the report of a mistake that the node's source shows: one certain change, or none."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.report.model import CheckResult
from tests.corpus.broken import BROKEN
from tests.corpus.build import SOLUTION, write
from tests.corpus.model import NODE
from tests.fix.corpus_fixes import TOOLS, with_tool
from tests.recorded import mark

BY_NAME = {package.name: package for package in BROKEN}
# The only fix of these is exactly the solution.
BACK_TO_SOLUTION = (
    *("node_made_after_try", "destroyed_before_spin", "spin_missing"),
    *("node_without_variable", "node_line_missing", "node_name_without_quotes"),
    *("guard_without_quotes", "step_outside_callback", "self_in_main"),
    *("main_in_class", "callback_outside_class", "create_timer_without_self"),
    *("get_logger_without_self", "counter_logged_without_self"),
    *("this_for_self", "plus_plus_before_name"),
    *("sum_not_kept", "compared_instead_of_set", "logged_once"),
    *("counter_compared", "node_compared"),
    *("log_throttled", "log_skips_first", "import_of_cpp_client", "module_of_rclpy_misspelt"),
    *("import_in_lower_case", "import_of_misspelt_name", "super_with_self"),
    *("super_with_self_alone", "interrupt_misspelt"),
    *("node_for_self", "callback_of_the_class", "plain_node"),
    *("lambda_without_call", "decimal_comma"),
    *("keyword_of_timer", "print_argument", "counter_is_text"),
    *("import_of_other_lesson", "import_of_ros_1", "arrow_after_call"),
    *("bracket_too_many", "colon_after_super", "one_equals_sign", "body_not_indented"),
    *("node_in_init", "comma_between_tuples_missing"),
    *("number_added_outside", "marker_without_slash", "node_in_init_and_empty_file"),
    "tabs_and_spaces",
    *("logger_print", "logger_log", "name_for_get_logger", "text_for_get_logger"),
    "spin_of_imported_class",
    *("str_missing", "number_as_float", "counter_reset"),
    *("entry_outside_list", "inner_folder_with_capitals", "resource_folder_misnamed"),
)
STEPS_ALONE = (
    "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"
    "        self.counter_ += 1\n\n"
)
OTHERWISE = {
    "spin_before_node": "    node = MyFirstNode()\n    rclpy.spin(node)\n",
    "shutdown_before_spin": "    node = MyFirstNode()\n    rclpy.spin(node)\n    rclpy.shutdown()\n",
    "counter_misspelt_in_step": "self.counter_ = self.counter_ + 1\n",
    "node_of_other_name": "rclpy.spin(my_node)",
    "null_for_none": "self.last_ = None\n",
    "true_in_lower_case": "self.on_ = True\n",
    "comment_with_slashes": "self.counter_ += 1  # increment\n",
    "percent_without_value": "'Hello time: %d' % self.counter_)",
    "format_forgotten": "'Hello time: {}'.format(self.counter_))",
    "logger_with_value": "'Hello time: %d' % self.counter_)",
    "counter_not_declared": "        global counter\n        self.get_logger()",
    "variable_named_str": "str_ = 'Hello time: '\n        self.get_logger().info(str_ + str(",
    "format_outside": "'Hello time: {}'.format(self.counter_))",
    "plus_outside": "'Hello time: ' + (str(self.counter_)))",
    "percent_outside": "'Hello time: %d' % self.counter_)",
    "callback_named_as_counter": "self.create_timer(1.0, self.on_timer)",
    "period_is_tuple": "self.period_ = 1.0\n",
    "period_with_comma": "period = 1.0\n",
    "helper_misspelt": "from my_robot_controller.utils import",
    "callback_called_before_counter": "self.timer_callback)\n        self.counter_ = 0\n",
    "while_and_sleep_in_callback": STEPS_ALONE,
    "class_from_own_file": "from my_robot_controller.hello_class import MyFirstNode\n",
    "own_file_by_its_name": "from my_robot_controller import helpers as text\n",
    "own_file_misspelt": "from my_robot_controller.helpers import text_of\n",
    "own_function_from_package": "from my_robot_controller.helpers import text_of\n",
    "adds_before_text": "self.get_logger().info(text)\n        self.counter_ = self.counter_ + 1\n",
    "timer_in_timers": "self.timers_ = self.create_timer(",
    "number_padded": "f'Hello time: {self.counter_}'",
    "f_prefix_missing_in_variable": "        text = f'Hello time: {self.counter_}'\n",
    "node_made_on_import": "    rclpy.init(args=args)\n    node = MyFirstNode()\n",
    "timer_created_after_try": (
        "        node.timer_ = node.create_timer(1.0, node.timer_callback)\n"
        "        rclpy.spin(node)\n"
    ),
    "attribute_handle": "self.handle_ = 0\n",
    "get_logger_is_a_number": "self.get_logger_ = 0\n",
    "period_set_after_timer": "self.period_ = 1.0\n        self.create_timer(self.period_,",
    "set_up_before_attribute": "self.period_ = 1.0\n        self.set_up()\n",
    "main_under_guard": "try_shutdown()\n\n\nif __name__ == '__main__':\n    main()\n",
    "main_at_import": "\n\nif __name__ == '__main__':\n    main()\n",
    "import_of_module_missing": "from rclpy.node import Node\nimport time\n",
}
# Only the student knows what these should be.
NOT_FIXED = (
    *("error_hidden_in_main", "rate_in_callback"),
    *("to_string",),
    *("init_defined_twice", "callback_defined_twice"),
    *("files_import_each_other", "helper_imports_the_node"),
    "own_file_beside_setup",
    *("node_of_ros_1", "loginfo_of_rospy", "helper_not_handed_in"),
)


def first_failed(root: Path) -> CheckResult:
    return next(check for check in mark(root).checks if check.status == "failed")


def fixed(name: str, folder: Path) -> str:
    """Return the node's file after the patch of the first failed check."""
    root = write(BY_NAME[name], folder)
    patch = first_failed(root).patch
    assert patch
    return (with_tool(TOOLS[0], patch.encode(), root) / NODE).read_text(encoding="utf-8")


@pytest.mark.parametrize("name", BACK_TO_SOLUTION)
def test_the_patch_restores_the_solution(name: str, tmp_path: Path) -> None:
    assert fixed(name, tmp_path) == (SOLUTION / NODE).read_text(encoding="utf-8")


@pytest.mark.parametrize("name", OTHERWISE)
def test_the_patch_changes_what_the_text_says(name: str, tmp_path: Path) -> None:
    assert OTHERWISE[name] in fixed(name, tmp_path)


@pytest.mark.parametrize("name", NOT_FIXED)
def test_what_is_not_certain_has_no_patch(name: str, tmp_path: Path) -> None:
    assert first_failed(write(BY_NAME[name], tmp_path)).patch == ""
