"""Wait until everything of the ROS graph that can be known is known, and no longer.

The real command asks its daemon, which already knows the graph. The wheels have no daemon, so every
call discovers the graph itself. A fixed wait is either too short on a busy machine (half a second
found the only other node in two thirds of the calls) or too long on a quiet one. So the number of
participants is taken from the system: each DDS participant binds two UDP ports of its domain, and
`/proc/net/udp` lists the bound ports of this network namespace (RTPS 2.5, 9.6.2.3: 7400 + 250 ·
domain + 10 + 2 · participant, and the next one). The wait ends when a node of each of them is
known, none of their endpoints is missing, and nothing has changed for `SETTLED` (longer on a busy
machine, where the parts of one announcement come further apart).

Fast DDS numbers the endpoints of a participant from 1 on, so a number that is missing below the
highest one is an endpoint that was not announced yet, or one that was removed: hence the limit.

As long as somebody is missing, `knock` makes them announce themselves again.

All participants answer at once, and each sends a packet for each of its endpoints. A hundred of
them are more than a socket holds by default (208 KiB on Linux, kernel's overhead included), and
Fast DDS takes up to a second until it asks for those that were dropped: hence `BUFFER`.

Participants of other machines have no port here. They can exist unless discovery is limited to this
machine (ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST, the lab's default); for them there is ros2cli's
half second.
"""

from __future__ import annotations

import os
import socket
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from .knock import knock
from .transport import discovery_range, is_local

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

PATIENCE = 3.5  # seconds; Fast DDS repeats a lost message of discovery after 3 s
SETTLED = 0.06  # seconds without a change; the parts of one announcement come within 20 ms
REMOTE = 0.5  # seconds for nodes on other machines, ros2cli's default
GAP_PATIENCE = 1.0  # seconds for an endpoint whose number is missing
POLL = 0.01  # seconds
BUFFER = 4 << 20  # bytes for each UDP socket; the kernel gives what `net.core.rmem_max` allows
KNOCK_AGAIN = 0.1  # seconds; the endpoints of who answers come within 80 ms
PORTS = Path("/proc/net/udp")
LOAD = Path("/proc/loadavg")
DESCRIPTORS = Path("/proc/self/fd")
FIRST_PORT, PORTS_OF_DOMAIN, FIRST_OFFSET = 7400, 250, 10
UNKNOWN_NODE = "_NODE_NAME_UNKNOWN_"  # rmw's name for an endpoint whose node is not known yet
PARTICIPANT = 12  # leading bytes of a GID; the rest is the endpoint
NUMBER = slice(12, 15)  # bytes of a GID with the endpoint's number in its participant, big-endian


class View(NamedTuple):
    """What a node knows of the graph: GIDs of endpoints, and the participants with known nodes."""

    endpoints: frozenset[bytes]
    participants: frozenset[bytes]


def discover(node: Any) -> None:
    """Wait until the node knows the graph, at most `PATIENCE` seconds; see the module's text."""
    if discovery_range() == "OFF":
        return
    enlarge_buffers()
    start = time.monotonic()
    least = start + (0 if is_local() else REMOTE)
    domain = node.context.get_domain_id()
    knocked = start - KNOCK_AGAIN
    last, since = view(node), start
    while (now := time.monotonic()) < start + PATIENCE:
        ports = participants_here(domain)
        if _is_everyone(last, ports):
            waits_for_gap = now < start + GAP_PATIENCE and has_gap(last.endpoints)
            if now >= least and not waits_for_gap and now - since >= SETTLED * _crowding():
                return
        elif ports is not None and now - knocked >= KNOCK_AGAIN:
            knock_at_others(ports)
            knocked = now
        time.sleep(POLL)
        new = view(node)
        if new != last:
            last, since = new, time.monotonic()


def view(node: Any) -> View:
    """Return what a node knows of the graph at this moment, services included."""
    infos = list(_endpoints(node))
    return View(
        frozenset(bytes(info.endpoint_gid) for info in infos),
        frozenset(
            bytes(info.endpoint_gid)[:PARTICIPANT]
            for info in infos
            if info.node_name != UNKNOWN_NODE
        ),
    )


def has_gap(endpoints: Iterable[bytes]) -> bool:
    """Whether a participant lacks an endpoint with a lower number than another one of it."""
    numbers: dict[bytes, set[int]] = {}
    for gid in endpoints:
        numbers.setdefault(gid[:PARTICIPANT], set()).add(int.from_bytes(gid[NUMBER], "big"))
    return any(max(known) > len(known) for known in numbers.values())


def _crowding() -> float:
    """Return how many threads want to run for each core at this moment, at least 1."""
    try:
        runnable = int(LOAD.read_text(encoding="ascii").split()[3].partition("/")[0])
    except (OSError, ValueError, IndexError):
        return 1.0
    return max(1.0, runnable / (os.cpu_count() or 1))


def _endpoints(node: Any) -> Iterator[Any]:
    for name, _ in node.get_topic_names_and_types(no_demangle=True):
        yield from node.get_publishers_info_by_topic(name, no_mangle=True)
        yield from node.get_subscriptions_info_by_topic(name, no_mangle=True)


def _is_everyone(seen: View, ports: dict[int, str] | None) -> bool:
    if ports is None:  # not Linux, or /proc is hidden: whoever is there has been waited for
        return len(seen.participants) > 1
    return len(seen.participants) >= len(ports)


def participants_here(domain: int, table: Path = PORTS) -> dict[int, str] | None:
    """Return the ports at which participants of a domain are in this network namespace.

    Own ones are included. Each has the inode of its socket. None if the system does not tell.
    """
    try:
        lines = table.read_text(encoding="ascii").splitlines()[1:]
    except OSError:
        return None
    rows = [line.split() for line in lines]
    bound = {int(row[1].partition(":")[2], 16): row[9] for row in rows if len(row) > 9}
    first = FIRST_PORT + PORTS_OF_DOMAIN * domain
    places = range(first + FIRST_OFFSET, first + PORTS_OF_DOMAIN - 1, 2)
    return {port: bound[port] for port in places if port in bound and port + 1 in bound}


def enlarge_buffers(size: int = BUFFER) -> None:
    """Let the UDP sockets of this process hold that many bytes that were not read yet."""
    for descriptor in _own_sockets().values():
        with socket.socket(fileno=os.dup(descriptor)) as own:
            if own.type == socket.SOCK_DGRAM:
                own.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, size)


def knock_at_others(ports: dict[int, str]) -> None:
    """Make the participants at these ports announce themselves to the one of this process."""
    sockets = _own_sockets()
    own = [port for port, inode in ports.items() if inode in sockets]
    if own:
        knock(own[0], [port for port in ports if port not in own])


def _own_sockets() -> dict[str, int]:
    """Return the inodes of this process' sockets with their descriptors."""
    sockets = {}
    for descriptor in DESCRIPTORS.iterdir() if DESCRIPTORS.is_dir() else ():
        try:
            kind, _, inode = str(descriptor.readlink()).partition(":")
        except OSError:  # closed meanwhile
            continue
        if kind == "socket":
            sockets[inode.strip("[]")] = int(descriptor.name)
    return sockets
