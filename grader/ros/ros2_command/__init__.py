"""The `ros2` command of a ROS prefix that is made from PyPI's ROS wheels.

PyPI has wheels of rclpy but none of ros2cli. This package answers the verbs that the course
needs as the real command does, to the letter: ros2cli 0.32.2 for jazzy (recorded in
``tests/recordings/ros2cli-jazzy.json``) and 0.38.1 for kilted (read in its source).

It stands alone: a prefix carries a copy of it as the top-level package ``wheels_ros2``, so it
uses the standard library and relative imports only, and rclpy where a verb looks at the graph.
"""
