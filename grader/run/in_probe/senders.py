"""Which node sent a message: the middleware gives each message the GID of its publisher's endpoint.

The graph has the same GID with the endpoint's node. A GID begins with that of its DDS participant, which
the nodes of one process share (the GUID of https://www.omg.org/spec/DDSI-RTPS, 8.2.4).
"""

from __future__ import annotations

import ctypes
import os
from collections.abc import Iterator
from functools import cache
from typing import Any

from rclpy.serialization import deserialize_message

OURS = "-"  # the sender of what the probe and its world send
UNKNOWN = "?"  # begins the sender of a message of which the graph does not yet tell the node
GUID, PREFIX = 16, 12  # bytes; humble's GIDs are longer
MOST_KNOWN = 20_000
NAMELESS = "_NODE_NAME_UNKNOWN_"  # an endpoint that no node of the graph has told about
SILENT_ABOUT_SENDERS = ("humble", "jazzy")  # rclpy tells the publisher's GID from kilted on
EVERY_NODE = ("/parameter_events", "/rosout")  # topics on which each node has a publisher


class Senders:
    """The nodes of the publishers on the graph.

    Made before any other process is on it: whatever publishes then is ours.
    """

    def __init__(self, node: Any) -> None:
        self.node = node
        self.known: dict[bytes, str] = {}
        self.open: dict[bytes, str] = {}  # the topics of publishers whose node is not yet known
        self.own = {
            bytes(info.endpoint_gid)[:PREFIX]
            for topic in EVERY_NODE
            for info in node.get_publishers_info_by_topic(topic)
        }

    def of(self, gid: bytes, topic: str) -> str:
        """Return the full name of the node that sent a message; "" if the middleware does not tell.

        What begins with UNKNOWN stands for a node that `found` may tell later.
        """
        gid = gid[:GUID]
        if not gid:
            return ""
        if gid[:PREFIX] in self.own:
            return OURS
        name = self.known.get(gid) or self._look_for(gid, topic)
        if name:
            return name
        self.open[gid] = topic
        return UNKNOWN + gid.hex()

    def found(self) -> dict[str, str]:
        """Return the nodes that have become known of what had none."""
        names = {gid: self._look_for(gid, topic) for gid, topic in self.open.items()}
        for gid, name in names.items():
            if name:
                del self.open[gid]
        return {UNKNOWN + gid.hex(): name for gid, name in names.items() if name}

    def _look_for(self, gid: bytes, topic: str) -> str:
        """Return the node of a publisher; of one that is already gone, the only node of its process."""
        for one in (topic, *EVERY_NODE):
            for info in self.node.get_publishers_info_by_topic(one):
                if info.node_name != NAMELESS and len(self.known) < MOST_KNOWN:
                    name = f"{info.node_namespace.rstrip('/')}/{info.node_name}"
                    self.known[bytes(info.endpoint_gid)[:GUID]] = name
            if gid in self.known:
                return self.known[gid]
        there = {name for known, name in self.known.items() if known[:PREFIX] == gid[:PREFIX]}
        return there.pop() if len(there) == 1 else ""


def taken_with_sender(subscription: Any, most: int) -> Iterator[tuple[Any, int, bytes]]:
    """Take messages; yield each with when it was sent (ns of wall time) and its publisher's GID.

    The GID is empty if neither rclpy nor rcl tells it.
    """
    for _ in range(most):
        with subscription.handle:
            taken = _taken_by_rcl(subscription) if _rcl() else _taken_by_rclpy(subscription)
        if taken is None:
            return
        yield taken


def _taken_by_rclpy(subscription: Any) -> tuple[Any, int, bytes] | None:
    taken = subscription.handle.take_message(subscription.msg_type, False)
    if taken is None:
        return None
    message, info = taken
    return message, info["source_timestamp"], info.get("publisher_gid", {}).get("data", b"")


class _Allocator(ctypes.Structure):
    """An rcutils_allocator_t."""

    _fields_ = [(name, ctypes.c_void_p) for name in ("take", "give", "again", "zero", "state")]


class _Bytes(ctypes.Structure):
    """An rcl_serialized_message_t."""

    _fields_ = [
        ("buffer", ctypes.c_void_p),
        ("length", ctypes.c_size_t),
        ("capacity", ctypes.c_size_t),
        ("allocator", _Allocator),
    ]


class _Info(ctypes.Structure):
    """An rmw_message_info_t, of any length of GID."""

    _fields_ = [
        ("sent", ctypes.c_int64),
        ("received", ctypes.c_int64),
        ("published", ctypes.c_uint64),
        ("reception", ctypes.c_uint64),
        ("middleware", ctypes.c_char_p),
        ("gid", ctypes.c_uint8 * GUID),
        ("rest", ctypes.c_uint8 * 64),
    ]


@cache
def _rcl() -> Any:
    """Return rcl's function that takes a message, and the place for its bytes; None if not needed."""
    if os.environ.get("ROS_DISTRO") not in SILENT_ABOUT_SENDERS:
        return None
    utils = ctypes.CDLL("librcutils.so")
    utils.rcutils_get_default_allocator.restype = _Allocator
    place, allocator = _Bytes(), utils.rcutils_get_default_allocator()
    array = ctypes.byref(place), ctypes.c_size_t(0), ctypes.byref(allocator)
    if utils.rcutils_uint8_array_init(*array) != 0:
        return None
    return ctypes.CDLL("librcl.so").rcl_take_serialized_message, place


def _taken_by_rcl(subscription: Any) -> tuple[Any, int, bytes] | None:
    take, place = _rcl()
    info = _Info()
    pointer = ctypes.c_void_p(subscription.handle.pointer)
    if take(pointer, ctypes.byref(place), ctypes.byref(info), None) != 0:
        return None
    data = ctypes.string_at(place.buffer, place.length)
    return deserialize_message(data, subscription.msg_type), info.sent, bytes(info.gid)
