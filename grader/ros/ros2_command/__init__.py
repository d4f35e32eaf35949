"""The `ros2` command of a ROS prefix made from PyPI's ROS wheels.

PyPI has wheels of rclpy but none of ros2cli. This package implements the verbs that the course
needs, with the output of the real command to the letter: ros2cli 0.32.2 for jazzy (recorded in
``tests/recordings/ros2cli-jazzy*.json``; a new package's setup.py is that of 0.32.6) and 0.38.1 for
kilted (from its source).

It is self-contained: a prefix has a copy of it as the top-level package ``wheels_ros2``, so it
uses only the standard library and relative imports, plus rclpy in verbs that query the graph.
"""
