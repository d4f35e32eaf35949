"""ROS 2 distros, and the prefixes that stand for them."""
