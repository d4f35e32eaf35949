"""Names of rospy, rclcpp and Python that are looked for in rclpy."""

from __future__ import annotations

import pytest

from tests.mistakes.test_from_source import RIGHT, line_of, raised

CAUGHT = "except KeyboardInterrupt"
STEP = "        self.counter_ += 1\n"
LOG = "self.get_logger().info"


@pytest.mark.parametrize(
    ("name", "old", "new", "code", "written"),
    [
        ("ROSInterruptException", CAUGHT, "except rclpy.ROSInterruptException",
         "rclpy.ROSInterruptException", "KeyboardInterrupt"),
        ("ROSInterruptException", CAUGHT, "except (rclpy.ROSInterruptException, KeyboardInterrupt)",
         "(rclpy.ROSInterruptException, KeyboardInterrupt)", "KeyboardInterrupt"),
        ("KeyboardInterrupt", CAUGHT, "except rclpy.KeyboardInterrupt", "rclpy.KeyboardInterrupt",
         "KeyboardInterrupt"),
        ("make_shared", "MyFirstNode()\n", "rclpy.make_shared(MyFirstNode)\n",
         "rclpy.make_shared(MyFirstNode)", "MyFirstNode()"),
        ("Duration", "create_timer(1.0", "create_timer(rclpy.Duration(2)", "rclpy.Duration(2)", "2"),
        ("sleep", STEP, f"{STEP}        rclpy.sleep(1)\n", "rclpy.sleep(1)", ""),
    ],
)  # fmt: skip
def test_what_ros_2_has_instead_is_said(
    name: str, old: str, new: str, code: str, written: str
) -> None:
    text = RIGHT.replace(old, new)
    error = f"AttributeError: module 'rclpy' has no attribute '{name}'"
    found = raised(error, text, line_of(text, code))
    assert found is not None
    assert found.kind == "node.not_in_rclpy"
    assert (found.params["name"], found.params["written"]) == (code, written)


def test_no_file_is_suspected_if_a_name_of_rclpy_is_unknown() -> None:
    text = RIGHT.replace(LOG, "rclpy.shout")
    found = raised("AttributeError: module 'rclpy' has no attribute 'shout'", text, None)
    assert found is not None
    assert (found.kind, found.variant) == ("node.attribute_unknown", "module")
