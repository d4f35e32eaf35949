"""What is told while a ROS prefix is looked for and made; see `prefix`."""

from __future__ import annotations

from grader.locale.message import msg

NO_ROS = msg("there is no ROS {distro} at {path}")
OTHER_DISTRO = msg(
    "Use DISTRO=jazzy or DISTRO=kilted, or a machine that has ROS {distro} at /opt/ros/{distro}."
)
OTHER_PLATFORM = msg(
    "PyPI's ROS wheels are for Linux x86_64 and Python {versions}; this is {system} and Python "
    "{python}"
)
OTHER_PYTHON = msg("Run the grader with one of those Pythons, e.g. `make setup PYTHON=python3.12`.")
MAKING = msg("making the ROS {distro} prefix from PyPI's wheels (300 MB, once)")
READY = msg("ROS {distro} is ready in {path}")
PIP_FAILED = msg("pip could not install the ROS {distro} wheels:\n{output}")
CHECK_NETWORK = msg(
    "Check the network (a proxy: HTTPS_PROXY; an own certificate: PIP_CERT), then run the command "
    "again."
)
INSTALL = msg("Install it, or unset GRADER_ROS to use PyPI's wheels.")
NO_WHEELS = msg("PyPI has no ROS wheels for {distro}")
PROGRESS = msg("  {seen} of about {total} wheels")
UNPACKING = msg("  unpacking")
