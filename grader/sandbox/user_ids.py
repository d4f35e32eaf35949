"""Unprivileged user ids for the submissions, new ones for each.

The kernel keeps some things for each user (keyrings, limits on processes and locked memory). Two
submissions never share a user id, so that neither finds anything of the other's.
"""

from __future__ import annotations

import secrets
from pathlib import Path

from grader.base.errors import SurroundingsError
from grader.base.i18n.message import say

LEAST = 61_000  # above every account of a system
MOST = 2**31 - 2  # some programs read a user id as a signed number


def new_user_ids() -> tuple[int, int]:
    """Return two neighbouring user ids that exist in this user namespace.

    Raises SurroundingsError if it maps none that are free for submissions.
    """
    highest = min(MOST, max(_highest_ids(), default=0))
    if highest < LEAST + 2:
        raise SurroundingsError(
            say("this user namespace has no user id above {least}", least=LEAST),
            remedy=say("Run the grader as an ordinary user, or map more user ids."),
        )
    first = LEAST + secrets.randbelow((highest - LEAST) // 2) * 2
    return first, first + 1


def _highest_ids() -> list[int]:
    """Return the highest id of each range that this user namespace maps."""
    rows = [row.split() for row in Path("/proc/self/uid_map").read_text().splitlines()]
    return [int(first) + int(count) - 1 for first, _, count in rows]
