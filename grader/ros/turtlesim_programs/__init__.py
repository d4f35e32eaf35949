"""The programs of ROS's package turtlesim, for the wheels prefix, which has no wheel of it.

They are copied into the prefix as `wheels_turtlesim`, with the marking's world turtlesim
(grader/run/in_probe/turtlesim.py) as its module `world`, and run under the prefix's Python: they
import ROS and nothing of the grader. What they do is what the real ones do, without a window.
Their texts are English, as those of ROS are.
"""
