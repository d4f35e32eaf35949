"""Containers and volumes that a grader left behind: found by their labels, never anybody else's.

A killed grader's containers end by themselves (see `cells`); this clears away what a daemon that
was itself restarted, or a machine that was, may have kept.
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
    """Return the labels of what this process makes; `lifetime` in seconds."""
    return {OWNER: f"{_here()} {os.getpid()} {_started(os.getpid())}", UNTIL: _at(lifetime)}


def clear_away(client: DockerClient) -> None:
    """Remove what graders left that are no more. Raises what the Docker SDK raises."""
    api = client.api
    for found in api.containers(all=True, filters={"label": OWNER}):
        if is_orphan(found["Labels"]):
            with contextlib.suppress(docker.errors.APIError):  # another one is removing it
                api.remove_container(found["Id"], force=True, v=True)
    for volume in api.volumes(filters={"label": OWNER})["Volumes"] or ():
        if is_orphan(volume["Labels"]):
            with contextlib.suppress(docker.errors.APIError):
                api.remove_volume(volume["Name"])


def is_orphan(label: dict[str, str]) -> bool:
    """Whether its grader is no more: a process of this machine that has gone, else its time."""
    try:
        here, pid, started = label[OWNER].split()
        until = int(label[UNTIL])
    except (KeyError, ValueError):
        return False  # not ours, whatever it is
    if here == _here():
        return _started(int(pid)) != started
    return time.time() > until


def _at(seconds: float) -> str:
    return str(int(time.time() + seconds))


def _here() -> str:
    """Name this machine's processes: its boot, and the PID namespace that we count in."""
    boot = Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii").strip()
    return f"{boot}/{Path('/proc/self/ns/pid').stat().st_ino}"


def _started(pid: int) -> str:
    """Return when a process was started, in the kernel's own count; "" if there is none."""
    try:
        stat = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
    return stat.rpartition(")")[2].split()[19]
