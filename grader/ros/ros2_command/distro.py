"""The ROS distribution whose `ros2` command is imitated."""

import os

DEFAULT = "jazzy"


def current() -> str:
    """Return the distro's name, such as ``jazzy``.

    Taken from ``ROS_DISTRO`` (a sourced prefix sets it, REP 149), else from the file ``distro``
    that the builder of the prefix may put beside this module, else jazzy.

    Raises OSError if that file exists but cannot be read.
    """
    named = os.environ.get("ROS_DISTRO", "").strip()
    if named:
        return named
    try:
        with open(os.path.join(os.path.dirname(__file__), "distro"), encoding="utf-8") as file:  # noqa: PTH118, PTH120, PTH123
            return file.read().strip() or DEFAULT
    except FileNotFoundError:
        return DEFAULT


def is_kilted() -> bool:
    """Return whether to behave like ros2cli 0.38 (kilted) instead of 0.32 (jazzy).

    Raises OSError as `current` does.
    """
    return current() == "kilted"
