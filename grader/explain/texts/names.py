"""Patterns of names that several messages have."""

from __future__ import annotations

CONDA = r"(?i:/(?:ana|mini)?conda3?/|/mini(?:forge|mamba)3?/|/mambaforge/|micromamba/|^\(base\) )"
VENV = r"/\.?v?env\w{0,20}/(?:bin|lib)/|/pyenv/|/\.virtualenvs/|^\([\w.-]{0,30}env\w{0,20}\) "
OWN_PYTHON = r"/opt/ros/(?P<distro>[a-z]{1,20})/(?:local/)?lib/python(?P<own>3\.\d{1,2})/(?:dist|site)-packages"
ROS_INTERFACES = (
    r"(?:std|geometry|sensor|nav|trajectory|visualization|diagnostic|shape|stereo|action|lifecycle"
    r"|turtlesim|tf2|nav2|control|moveit|vision|rosgraph|statistics|composition|unique_identifier)"
    r"_(?:msgs|srvs|interfaces)|turtlesim|rcl_interfaces|builtin_interfaces|example_interfaces"
)
OWN_INTERFACES = r"\w{1,100}_(?:interfaces?|msgs?|srvs?|actions?)"
IMPORT = r"(?:from|import) (?P<imported>\w{1,100})\.(?:msg|srv|action)\b[^\n]{0,200}\n(?:[ ~^]{1,200}\n)?"
OF_ROS = (  # packages of ROS that tutorials run, and that a small installation lacks
    r"turtlesim|turtle_tf2_\w{1,20}|demo_nodes_(?:cpp|py)|examples_rclpy_\w{1,40}|image_tools"
    r"|rviz2|rqt(?:_\w{1,40})?|tf2_(?:tools|ros)|joint_state_publisher(?:_gui)?"
    r"|robot_state_publisher|xacro|teleop_twist_(?:keyboard|joy)|joy|gazebo_ros|ros_gz_\w{1,20}"
    r"|nav2_\w{1,40}|slam_toolbox|usb_cam|cv_bridge"
)
WORD = r"[\w./-]{1,120}"
