"""The lab for students: a ROS 2 terminal with their workspace, and a guide through the lesson."""
