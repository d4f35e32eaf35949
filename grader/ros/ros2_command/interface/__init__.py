"""Show information about ROS interfaces."""

VERBS = ("list", "package", "packages", "proto", "show")
