"""The window's program under ROS's own Python; it imports the standard library and rclpy only."""
