"""Names of rospy, rclcpp and Python that are looked for in rclpy."""

from __future__ import annotations

from tests.mistakes.test_from_source import RIGHT, raised

STEP = "        self.counter_ += 1\n"
LOG = "self.get_logger().info"


def test_no_file_is_suspected_if_a_name_of_rclpy_is_unknown() -> None:
    text = RIGHT.replace(LOG, "rclpy.shout")
    found = raised("AttributeError: module 'rclpy' has no attribute 'shout'", text, None)
    assert found is not None
    assert (found.kind, found.variant) == ("node.attribute_unknown", "module")
