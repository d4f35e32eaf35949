"""The student's side: a ROS 2 terminal with a workspace, and a guide through the exercise."""
