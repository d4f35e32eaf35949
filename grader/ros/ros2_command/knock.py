"""Make the DDS participants of this machine announce themselves to one of ours again.

A participant answers the first announcement (RTPS 2.5, 8.5.3: SPDP) of every new participant at
once, and repeats its own only every 3 s. The first announcement of our own is sent while Fast DDS
2.14 is still setting it up, and the answers are then often dropped (seen in a trace of the packets:
half of the calls on a busy machine). So, when ours is ready, the announcement of a participant that
does not exist is sent to the others' ports, with our port as its address, and then its end. It has
no endpoints, so nobody looks for any.

The bytes are RTPS 2.5, 8.3 (messages) and 9.6.3 (parameters); all numbers are little-endian here.
"""

from __future__ import annotations

import os
import socket
import struct

LOCALHOST = "127.0.0.1"
VENDOR = b"\x01\x0f"  # eProsima's, as participants of other vendors are treated differently
VERSION = b"\x02\x03"
PARTICIPANT_ENTITY = b"\x00\x00\x01\xc1"
ANNOUNCER = b"\x00\x01\x00\xc2"  # the writer of announcements
ANY_READER = b"\x00\x00\x00\x00"
LEASE = 2  # seconds, should the packet with the end get lost
UDP4 = 1
ENCAPSULATION = b"\x00\x03\x00\x00"  # a list of parameters, little-endian
ENDED = b"\x00\x00\x00\x03"  # disposed and unregistered


def knock(own_port: int, others: list[int]) -> None:
    """Send the announcement and the end of a participant at `own_port` to the others' ports."""
    prefix = VENDOR + os.urandom(10)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        for packet in (announcement(prefix, own_port), end(prefix)):
            for port in others:
                try:
                    sender.sendto(packet, (LOCALHOST, port))
                except OSError:  # it has just ended
                    continue


def announcement(prefix: bytes, port: int) -> bytes:
    """Return the packet that announces a participant (12 bytes of GUID) at a port of this host."""
    address = struct.pack("<iI", UDP4, port) + bytes(12) + socket.inet_aton(LOCALHOST)
    parameters = (
        _parameter(0x0015, VERSION + bytes(2))
        + _parameter(0x0016, VENDOR + bytes(2))
        + _parameter(0x0050, prefix + PARTICIPANT_ENTITY)
        + _parameter(0x0032, address)  # metatraffic
        + _parameter(0x0031, address)
        + _parameter(0x0002, struct.pack("<iI", LEASE, 0))
        + _parameter(0x0058, struct.pack("<I", 0b11))  # its endpoints: announcer and detector
        + _parameter(0x0001, b"")
    )
    return _message(prefix, _data(1, b"", ENCAPSULATION + parameters, flags=0x05))


def end(prefix: bytes) -> bytes:
    """Return the packet with which that participant ends."""
    guid = prefix + PARTICIPANT_ENTITY
    inline = _parameter(0x0070, guid) + _parameter(0x0071, ENDED) + _parameter(0x0001, b"")
    key = ENCAPSULATION + _parameter(0x0050, guid) + _parameter(0x0001, b"")
    return _message(prefix, _data(2, inline, key, flags=0x0B))


def _message(prefix: bytes, submessage: bytes) -> bytes:
    return b"RTPS" + VERSION + VENDOR + prefix + submessage


def _data(number: int, inline: bytes, payload: bytes, *, flags: int) -> bytes:
    """Return a DATA submessage with this sequence number."""
    content = struct.pack("<HH", 0, 16) + ANY_READER + ANNOUNCER + struct.pack("<iI", 0, number)
    content += inline + payload
    return struct.pack("<BBH", 0x15, flags, len(content)) + content


def _parameter(name: int, value: bytes) -> bytes:
    return struct.pack("<HH", name, len(value)) + value
