"""Exclusive locks (flock(2)): the kernel releases a lock when its holder ends, even if killed."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

LOCK_FILE = os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC
OWNER_ONLY = 0o600


class HeldError(Exception):
    """Another process holds the lock."""


def lock_open(descriptor: int, *, waits: bool = True) -> None:
    """Lock an open file or folder until it is closed.

    Raises HeldError if another process holds the lock and `waits` is False, OSError if the file
    system has no locks.
    """
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX if waits else fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise HeldError from None


def take_lock(path: Path, *, waits: bool = True) -> int:
    """Lock a file, which is created if it is missing; the caller closes the returned descriptor.

    Raises HeldError as `lock_open`, OSError if the file cannot be opened or locked.
    """
    descriptor = os.open(path, LOCK_FILE, OWNER_ONLY)
    try:
        lock_open(descriptor, waits=waits)
    except BaseException:
        os.close(descriptor)
        raise
    return descriptor


@contextmanager
def locked(path: Path, *, waiting: Callable[[], object] | None = None) -> Iterator[None]:
    """Hold the lock on a file; `waiting` is called first if another process holds it."""
    try:
        descriptor = take_lock(path, waits=False)
    except HeldError:
        if waiting is not None:
            waiting()
        descriptor = take_lock(path)
    try:
        yield
    finally:
        os.close(descriptor)
