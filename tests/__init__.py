"""The tests. They use real colcon, rclpy, bubblewrap and terminals; nothing is skipped."""
