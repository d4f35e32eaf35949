"""ROS 2 distros, their installations (prefixes) and their Docker images."""
