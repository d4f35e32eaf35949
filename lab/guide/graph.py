"""What the guide asks the ROS graph: with `ros2`, which every lab has, in a terminal's environment."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable, Mapping

LONGEST = 15.0  # seconds for an answer; a busy machine needs a few
PUBLISHERS = re.compile(r"^Publisher count: (\d+)$", re.MULTILINE)


def sees(condition: str, name: str, environment: Mapping[str, str]) -> bool:
    """Whether a condition of `CONDITIONS` holds for a node's or topic's full name at this moment."""
    return CONDITIONS[condition](name, environment)


def _has_node(name: str, environment: Mapping[str, str]) -> bool:
    return name in _ros2(environment, "node", "list").splitlines()


def _has_publisher(name: str, environment: Mapping[str, str]) -> bool:
    count = PUBLISHERS.search(_ros2(environment, "topic", "info", name))
    return count is not None and count[1] != "0"


CONDITIONS: Mapping[str, Callable[[str, Mapping[str, str]], bool]] = {
    "node_on_graph": _has_node,
    "topic_published": _has_publisher,
}
"""The conditions that hold while a program runs."""


def _ros2(environment: Mapping[str, str], *words: str) -> str:
    """Return what `ros2` prints; nothing if it is not there, fails or does not answer."""
    try:
        done = subprocess.run(
            ["ros2", *words],
            env=dict(environment),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            timeout=LONGEST,
            check=False,
        )
    except (OSError, subprocess.SubprocessError):
        return ""
    return done.stdout.decode("utf-8", "replace")
