"""What is told while a ROS prefix is looked for and made; see `prefix`."""

from __future__ import annotations

from grader.base.i18n.message import msg

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
MAKING_AGAIN = msg("{reason}\nmaking the prefix once more")
BROKEN = msg("a program of ROS {distro} does not run:\n{said}")
UNTESTED = msg("it could not be tested whether the programs of ROS {distro} run:\n{said}")
TRY_AGAIN = msg("Run the command again. If that does not help, report this with its text.")
REPORT = msg(
    "Set GRADER_CACHE to a folder in which programs may run (its file system may forbid them), or "
    "report this with its text."
)
REMOVED = msg(
    "That prefix is removed from the cache. Run the command again: it makes a new one first."
)
INSTALL_TOOLS = msg(
    "Install what is missing (colcon: `sudo apt-get install python3-colcon-common-extensions`), or "
    "set GRADER_ROS=wheels to use PyPI's wheels."
)
MAKE_AGAIN = msg(
    "Make it again. With Docker: make images DISTRO={distro}. In a lab without Docker: leave the "
    "lab and remove ROS {distro} from the grader's cache (~/.cache/ros2_teaching_lab)."
)
