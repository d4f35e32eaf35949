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
    "returns_if_zero",
    *("node_made_after_try", "shutdown_before_node", "destroyed_before_spin", "spin_missing"),
    *("node_without_variable", "node_line_missing", "node_name_without_quotes"),
    *("guard_without_quotes", "step_outside_callback", "step_at_margin", "self_in_main"),
    *("main_in_class", "callback_outside_class", "create_timer_without_self"),
    *("get_logger_without_self", "counter_logged_without_self", "returns_before_log"),
    *("returns_before_step", "returns_before_spin", "this_for_self", "plus_plus_before_name"),
    *("sum_not_kept", "compared_instead_of_set", "definition_misspelt", "logged_once"),
    *("counter_compared", "node_compared"),
    *("log_throttled", "log_skips_first", "import_of_cpp_client", "module_of_rclpy_misspelt"),
    *("import_in_lower_case", "import_of_misspelt_name", "super_with_self"),
    *("super_with_self_alone", "interrupt_misspelt", "counter_of_other_name"),
    *("node_for_self", "base_class_called", "callback_of_the_class", "plain_node"),
    *("lambda_without_call", "loginfo_of_ros_1", "init_node_of_ros_1", "decimal_comma"),
    *("third_argument_of_timer", "keyword_of_timer", "print_argument", "counter_is_text"),
    *("import_of_other_lesson", "import_of_ros_1", "class_with_capital", "arrow_after_call"),
    *("bracket_too_many", "colon_after_super", "one_equals_sign", "body_not_indented"),
    *("docstring_not_closed", "node_in_init", "comma_between_tuples_missing"),
    *("number_added_outside", "marker_without_slash", "node_in_init_and_empty_file"),
    *("called_by_hand_before_counter", "python_logging_not_set_up", "python_logger_of_the_node"),
    *("tabs_and_spaces", "timer_again_in_callback"),
    *("asyncio_sleep_in_callback", "thread_logs_in_loop", "daemon_thread_logs_in_loop"),
    *("python_logging_bare", "shell_line_without_prompt", "shell_line_that_is_python"),
    *("logger_print", "logger_log", "name_for_get_logger", "text_for_get_logger"),
    *("spin_of_imported_class", "clean_up_in_try", "shutdown_in_try"),
    *("counter_from_input", "input_at_import", "sum_returned", "len_of_counter"),
    *("counter_is_list", "while_ok_logs_in_callback", "while_prints_in_main"),
    *("entry_outside_list", "inner_folder_with_capitals", "resource_folder_misnamed"),
)
STEPS_ALONE = (
    "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"
    "        self.counter_ += 1\n\n"
)
OTHERWISE = {
    "increment_sign_in_text": "{self.counter_}')\n        self.counter_ += 1\n",
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
    "own_create_timer": "        self.my_create_timer()\n",
    "period_is_tuple": "self.period_ = 1.0\n",
    "period_with_comma": "period = 1.0\n",
    "helper_misspelt": "from my_robot_controller.utils import",
    "callback_called_before_counter": "self.timer_callback)\n        self.counter_ = 0\n",
    "python_logging": "self.get_logger().info('Hello time: ' + str(self.counter_))",
    "python_logger_of_the_file": "self.get_logger().info('Hello time: %d' % self.counter_)",
    "while_and_sleep_in_callback": STEPS_ALONE,
    "while_in_method_of_constructor": STEPS_ALONE,
    "while_in_constructor_beside_timer": "self.timer_callback)\n\n    def timer_callback",
    "class_from_own_file": "from my_robot_controller.hello_class import MyFirstNode\n",
    "own_file_by_its_name": "from my_robot_controller import helpers as text\n",
    "own_file_misspelt": "from my_robot_controller.helpers import text_of\n",
    "package_named_twice": "from my_robot_controller.helpers import text_of\n",
    "own_function_from_package": "from my_robot_controller.helpers import text_of\n",
    "try_without_except": "    except KeyboardInterrupt:\n        pass\n    node.destroy_node()\n",
    "adds_before_text": "self.get_logger().info(text)\n        self.counter_ = self.counter_ + 1\n",
    "timer_in_timers": "self.timers_ = self.create_timer(",
    "thread_beside_timer": "threading.Thread(target=self.wait, daemon=True)\n",
    "f_prefix_missing_in_variable": "        text = f'Hello time: {self.counter_}'\n",
    "node_made_on_import": "    rclpy.init(args=args)\n    node = MyFirstNode()\n",
    "f_in_quotes": 'info(f"Hello time: {self.counter_}")',
    "blank_at_the_end_of_a_name": "NAME = 'my_first_node'\n",
    "node_in_namespace": "super().__init__('my_first_node')\n",
    "timer_again_by_method": "        self.counter_ += 1\n\n",
    "main_called_by_class": "if __name__ == '__main__':\n    main()\n",
    "counts_after_return": "self.get_logger().info(self.make_text())\n        self.counter_ += 1\n",
    "counter_given_to_function": "str(self.counter_))\n        self.counter_ += 1\n\n",
    "counter_of_method_not_kept": "        self.counter_ = self.add_one(self.counter_)\n",
    "misspelt_attribute_hidden": "info('Hello time: ' + str(self.counter_))\n",
    "loop_logs_its_number": (
        "        self.get_logger().info('Hello time: ' + str(self.counter))\n"
        "        self.counter += 1\n\n"
    ),
    "rate_sleeps_in_main": "    try:\n        rclpy.spin(node)\n    except KeyboardInterrupt:",
    "timer_started_after_spin": "        node.start()\n        rclpy.spin(node)\n    except",
    "timer_created_after_try": (
        "        node.timer_ = node.create_timer(1.0, node.timer_callback)\n"
        "        rclpy.spin(node)\n"
    ),
    "attribute_handle": "self.handle_ = 0\n",
    "get_logger_is_a_number": "self.get_logger_ = 0\n",
    "while_in_constructor": "self.counter_ = 0\n        self.create_timer(1.0, self.timer_callback)\n\n",
    "period_set_after_timer": "self.period_ = 1.0\n        self.create_timer(self.period_,",
    "set_up_before_attribute": "self.period_ = 1.0\n        self.set_up()\n",
    "object_with_a_node_is_spun": "        rclpy.spin(node.node)\n",
    "object_with_a_node_in_executor": "        executor.add_node(app.node)\n",
    "main_under_guard": "try_shutdown()\n\n\nif __name__ == '__main__':\n    main()\n",
    "printf_in_callback": "self.get_logger().info('Hello time: %d' % self.counter_)\n",
    "start_outside_init": "    counter_ = 0\n\n    def __init__(self):\n",
    "main_at_import": "\n\nif __name__ == '__main__':\n    main()\n",
    "import_of_module_missing": "from rclpy.node import Node\nimport time\n",
}
# Only the student knows what these should be.
NOT_FIXED = (
    *("error_hidden_in_main", "rate_in_callback"),
    *(
        "to_string",
        "none_called",
    ),
    *("init_defined_twice", "callback_defined_twice", "init_twice_without_counter"),
    "object_without_node_is_spun",
    *("files_import_each_other", "helper_imports_the_node"),
    *("while_logs_in_constructor", "own_file_beside_setup"),
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
