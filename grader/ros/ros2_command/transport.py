"""Let a node for one question speak UDP only.

By default Fast DDS uses shared memory for the messages between processes of a machine. Before it
writes to another participant's port there, it asks whether somebody still listens, and sleeps a
third of a second if somebody else has asked just before. That happens in the thread that receives
the announcements of the graph, on both sides: a third to a full second of every second call. A
participant without shared memory has no such port.
"""

from __future__ import annotations

import os
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

PROFILE = Path(__file__).with_name("localhost.xml")
PROFILES = ("FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE")  # until 2.14, since
RANGE = "ROS_AUTOMATIC_DISCOVERY_RANGE"
IMPLEMENTATION = "rmw_fastrtps_cpp"


def discovery_range() -> str:
    """Return where nodes look for each other, as ROS_AUTOMATIC_DISCOVERY_RANGE has it."""
    if os.environ.get("ROS_LOCALHOST_ONLY") == "1":
        return "LOCALHOST"
    return os.environ.get(RANGE, "SUBNET").upper()


def is_local() -> bool:
    """Whether all nodes that can be discovered are on this machine."""
    return discovery_range() == "LOCALHOST" and not os.environ.get("ROS_STATIC_PEERS")


@contextmanager
def udp_only() -> Iterator[None]:
    """Let the participant that is created meanwhile use UDP only, if that is safe to set.

    It is where all nodes are on this machine and the user has no profile of their own.
    """
    own = any(os.environ.get(name) for name in PROFILES)
    other = os.environ.get("RMW_IMPLEMENTATION", IMPLEMENTATION) not in ("", IMPLEMENTATION)
    if own or other or not is_local() or os.environ.get("ROS_LOCALHOST_ONLY"):
        yield
        return
    before = dict(os.environ)
    # rmw would replace the transports of the profile; with this range it changes nothing
    os.environ[RANGE] = "SYSTEM_DEFAULT"
    for name in PROFILES:
        os.environ[name] = str(PROFILE)
    try:
        yield
    finally:
        for name in (RANGE, *PROFILES):
            if name in before:
                os.environ[name] = before[name]
            else:
                del os.environ[name]
