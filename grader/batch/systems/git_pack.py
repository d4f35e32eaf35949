"""One object out of git's packs, found by the index and not by reading them; gitformat-pack(5)."""

from __future__ import annotations

import os
import stat
import struct
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import islice

MAGIC = b"\xfftOc\0\0\0\x02"  # an index of version 2
FANOUT = 8  # where its table of 256 counts begins
NAMES = FANOUT + 256 * 4
MOST_PACKS = 50
COMMIT, OFS_DELTA, REF_DELTA = 1, 6, 7
DEEPEST = 50  # git's own limit on deltas of deltas


def in_packs(git: int, sha: bytes, *, most: int) -> bytes | None:
    """Return a commit's content from the packs of an open `.git`; None if it is in none of them.

    Raises ValueError, IndexError or zlib.error for a damaged pack.
    """
    try:
        with _open("objects", git, os.O_DIRECTORY) as objects:
            return _in_folder(objects, sha, most)
    except OSError:
        return None


def _in_folder(objects: int, sha: bytes, most: int) -> bytes | None:
    with _open("pack", objects, os.O_DIRECTORY) as packs:
        with os.scandir(packs) as entries:
            found = (entry.name for entry in entries if entry.name.endswith(".idx"))
            names = sorted(islice(found, MOST_PACKS))
        for name in names:
            offset = _offset(packs, name, sha)
            if offset is not None:
                with _open(f"{name[:-4]}.pack", packs) as pack:
                    return _commit(pack, offset, most)
    return None


@contextmanager
def _open(name: str, below: int, more: int = 0) -> Iterator[int]:
    flags = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC | more
    handle = os.open(name, flags, dir_fd=below)
    try:
        if not more and not stat.S_ISREG(os.fstat(handle).st_mode):
            raise ValueError("no plain file")
        yield handle
    finally:
        os.close(handle)


def _number(handle: int, position: int, form: str = ">I") -> int:
    data = os.pread(handle, struct.calcsize(form), position)
    if len(data) < struct.calcsize(form):
        raise ValueError("cut short")
    return int(struct.unpack(form, data)[0])


def _offset(packs: int, name: str, sha: bytes) -> int | None:
    """Return where in its pack an object begins, by halving the index's sorted names."""
    with _open(name, packs) as index:
        if os.pread(index, len(MAGIC), 0) != MAGIC:
            return None
        low = _number(index, FANOUT + 4 * (sha[0] - 1)) if sha[0] else 0
        high = _number(index, FANOUT + 4 * sha[0])
        total = _number(index, FANOUT + 4 * 255)
        while low < high:
            middle = (low + high) // 2
            there = os.pread(index, len(sha), NAMES + len(sha) * middle)
            if there == sha:
                offsets = NAMES + (len(sha) + 4) * total
                offset = _number(index, offsets + 4 * middle)
                if not offset & 0x80000000:
                    return offset
                large = offsets + 4 * total + 8 * (offset & 0x7FFFFFFF)
                return _number(index, large, ">Q")
            low, high = (middle + 1, high) if there < sha else (low, middle)
    return None


def _commit(pack: int, offset: int, most: int) -> bytes | None:
    """Return a commit that is stored whole or as a delta of an earlier one in the same pack."""
    deltas: list[bytes] = []
    while len(deltas) <= DEEPEST:
        kind, head = _header(os.pread(pack, 64, offset))
        if kind == COMMIT:
            content = _inflated(pack, offset + head, most)
            for delta in reversed(deltas):
                content = _applied(content, delta, most)
            return content
        if kind != OFS_DELTA:
            return None
        back, used = _backwards(os.pread(pack, 64, offset + head))
        deltas.append(_inflated(pack, offset + head + used, most))
        offset -= back
    return None


def _header(data: bytes) -> tuple[int, int]:
    """Return an object's type, and how long its header is."""
    end = 0
    while data[end] & 0x80:
        end += 1
    return (data[0] >> 4) & 7, end + 1


def _backwards(data: bytes) -> tuple[int, int]:
    """Return how far before a delta its base is, and how long that number is."""
    value = data[0] & 0x7F
    used = 1
    while data[used - 1] & 0x80:
        value = ((value + 1) << 7) | (data[used] & 0x7F)
        used += 1
    if value <= 0:
        raise ValueError("a delta of itself")
    return value, used


def _inflated(pack: int, offset: int, most: int) -> bytes:
    return zlib.decompressobj().decompress(os.pread(pack, most, offset), most)


def _applied(base: bytes, delta: bytes, most: int) -> bytes:
    """Return what a delta makes of its base: pieces of the base, and new bytes."""
    _, position = _size(delta, 0)
    _, position = _size(delta, position)
    parts = []
    length = 0
    while position < len(delta) and length <= most:
        command = delta[position]
        position += 1
        if command & 0x80:
            start, position = _little(delta, position, command, 4)
            size, position = _little(delta, position, command >> 4, 3)
            parts.append(base[start : start + (size or 0x10000)])
        else:
            parts.append(delta[position : position + command])
            position += command
        length += len(parts[-1])
    return b"".join(parts)[:most]


def _size(delta: bytes, position: int) -> tuple[int, int]:
    value = shift = 0
    while True:
        byte = delta[position]
        value |= (byte & 0x7F) << shift
        position, shift = position + 1, shift + 7
        if not byte & 0x80:
            return value, position


def _little(delta: bytes, position: int, which: int, count: int) -> tuple[int, int]:
    """Return a number of which only the bytes that are not zero are written."""
    value = 0
    for n in range(count):
        if which & (1 << n):
            value |= delta[position] << (8 * n)
            position += 1
    return value, position
