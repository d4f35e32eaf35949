"""Marks ROS 2 packages: reproduces the workspace, drives the real `ros2 run`, says why."""

__version__ = "0.1.0"
