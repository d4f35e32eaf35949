"""ROS domains of the tests that run nodes in the machine's own network.

They are locked as the grader's plain sandbox locks its own: no other test process and no grader on
this machine uses one at the same time.
"""

from __future__ import annotations

import os
from collections import deque

from grader.sandbox.plain import lock_domain

KEPT = 8  # more than one test uses; nodes that end late find no others in theirs
_locks: deque[int] = deque()


def new_domain() -> str:
    """Return a ROS domain for one test; it is locked until KEPT more have been asked for."""
    domain, lock = lock_domain()
    _locks.append(lock)
    if len(_locks) > KEPT:
        os.close(_locks.popleft())
    return str(domain)
