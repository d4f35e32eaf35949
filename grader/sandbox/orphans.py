"""Removes containers and volumes that an ended grader left behind, found by their labels.

A killed grader's containers end by themselves (see `container`); after a restart of the daemon or
of the machine some may be left.
"""

from __future__ import annotations

import contextlib
import os
import time
from pathlib import Path
from typing import TYPE_CHECKING

import docker.errors

if TYPE_CHECKING:
    from docker import DockerClient

OWNER = "ros2-teaching-lab.grader"
UNTIL = "ros2-teaching-lab.until"


def labels(lifetime: float) -> dict[str, str]:
    """Return the labels for what this process creates; `lifetime` in seconds."""
    return {OWNER: f"{_here()} {os.getpid()} {_started(os.getpid())}", UNTIL: _at(lifetime)}


def remove_orphans(client: DockerClient) -> None:
    """Remove what ended graders have left. Raises what the Docker SDK raises."""
    api = client.api
    for found in api.containers(all=True, filters={"label": OWNER}):
        if is_orphan(found["Labels"]):
            with contextlib.suppress(docker.errors.APIError):  # another grader is removing it
                api.remove_container(found["Id"], force=True, v=True)
    for volume in api.volumes(filters={"label": OWNER})["Volumes"] or ():
        if is_orphan(volume["Labels"]):
            with contextlib.suppress(docker.errors.APIError):
                api.remove_volume(volume["Name"])


def is_orphan(label: dict[str, str]) -> bool:
    """Whether its grader has ended: by its process on this machine, by its lifetime elsewhere."""
    try:
        here, pid, started = label[OWNER].split()
        until = int(label[UNTIL])
    except (KeyError, ValueError):
        return False  # not made by a grader
    if here == _here():
        return _started(int(pid)) != started
    return time.time() > until


def _at(seconds: float) -> str:
    return str(int(time.time() + seconds))


def _here() -> str:
    """Return an id of this machine's boot and of this process' PID namespace."""
    boot = Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii").strip()
    return f"{boot}/{Path('/proc/self/ns/pid').stat().st_ino}"


def _started(pid: int) -> str:
    """Return the start time of a process in clock ticks since boot, "" if it does not exist."""
    try:
        stat = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
    return stat.rpartition(")")[2].split()[19]
