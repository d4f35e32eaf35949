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
    "spin_missing",
    "node_name_without_quotes",
    "step_outside_callback",
    *("main_in_class", "callback_outside_class", "create_timer_without_self"),
    "counter_logged_without_self",
    *("this_for_self", "plus_plus_before_name"),
    "sum_not_kept",
    "import_of_misspelt_name",
    "interrupt_misspelt",
    "import_of_cpp_client",
    *("bracket_too_many", "colon_after_super", "one_equals_sign", "body_not_indented"),
    *("node_in_init", "comma_between_tuples_missing"),
    "marker_without_slash",
    "tabs_and_spaces",
    "logger_print",
    "str_missing",
    *("entry_outside_list", "inner_folder_with_capitals", "resource_folder_misnamed"),
)
STEPS_ALONE = (
    "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"
    "        self.counter_ += 1\n\n"
)
OTHERWISE = {
    "counter_misspelt_in_step": "self.counter_ = self.counter_ + 1\n",
    "node_of_other_name": "rclpy.spin(my_node)",
    "null_for_none": "self.last_ = None\n",
    "true_in_lower_case": "self.on_ = True\n",
    "comment_with_slashes": "self.counter_ += 1  # increment\n",
    "counter_not_declared": "        global counter\n        self.get_logger()",
    "period_with_comma": "self.create_timer(1.0, self.timer_callback)",
    "class_from_own_file": "from my_robot_controller.hello_class import MyFirstNode\n",
    "own_function_from_package": "from my_robot_controller.helpers import text_of\n",
    "main_under_guard": "try_shutdown()\n\n\nif __name__ == '__main__':\n    main()\n",
    "main_at_import": "\n\nif __name__ == '__main__':\n    main()\n",
    "import_of_module_missing": "from rclpy.node import Node\nimport time\n",
}
# Only the student knows what these should be.
NOT_FIXED = (
    *("error_hidden_in_main", "rate_in_callback"),
    *("to_string",),
    *("files_import_each_other", "helper_imports_the_node"),
    *("node_of_ros_1", "helper_not_handed_in"),
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
