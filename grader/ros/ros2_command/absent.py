"""What a full ROS 2 has and the wheels do not have: what it is, and where it is."""

from __future__ import annotations

from . import distro

COMMANDS = {
    "bag": "records and plays topics (rosbag2)",
    "component": "loads nodes into a process that is running already (a container)",
    "control": "shows and switches the controllers and the hardware of a robot (ros2_control)",
    "extension_points": "lists what plug-ins can extend",
    "extensions": "lists the plug-ins of ros2",
    "launch": "starts several nodes from a file",
    "multicast": "sends and receives a packet, to test the network between two machines",
    "security": "makes the keys with which nodes encrypt what they send (SROS 2)",
    "test": "runs tests that use launch",
    "trace": "records when callbacks run and messages are sent (ros2_tracing)",
}
DEBIAN = {"control": "ros2controlcli", "trace": "ros2trace"}
"""The packages of the commands that the image of ROS 2 does not have either."""
PACKAGES = {
    **dict.fromkeys(("demo_nodes_cpp", "demo_nodes_py"), "has example nodes (talker, listener)"),
    **dict.fromkeys(("rviz2", "rqt", "rqt_graph", "rqt_console"), "is a program with a window"),
}
TURTLESIM = "turtlesim"
IMAGES = "run `make images`, then `make lab SANDBOX=docker`, outside the lab"
BUILD = (
    "it is built when a lab is opened and a compiler is there. Outside the lab: sudo apt-get install "
    "python3-dev g++ make, then `make lab`; the image of ROS 2 has it: `make images`"
)
INSTEAD = f"the wheels do not have it, the image of ROS 2 does: {IMAGES}"
APT = (
    "the wheels do not have it, and neither does the image of ROS 2. On a machine with ROS of its own: "
    "sudo apt-get install ros-{}-{}"
)
DESKTOP = "the wheels do not have it, a desktop installation of ROS 2 does (ros-{}-desktop)"


def command(name: str) -> str:
    """Return the one line about a command of ros2 that is not here."""
    if name in DEBIAN:
        return f"ros2 {name}: {COMMANDS[name]}; {APT.format(distro.current(), DEBIAN[name])}"
    return f"ros2 {name}: {COMMANDS[name]}; {INSTEAD}"


def package(name: str) -> str | None:
    """Return the one line about a package that the tutorials use and the wheels do not have."""
    if name == TURTLESIM:
        return f"Package '{name}' is not in this lab: {BUILD}"
    if name in PACKAGES:
        return f"Package '{name}' {PACKAGES[name]}; {DESKTOP.format(distro.current())}"
    return None
