"""Line numbers that a web page shows beside the code, pasted above it."""

from __future__ import annotations


def numbers_above(found: bytes) -> int:
    """Return how many lines at the start of a file are 1, 2, 3 and so on; 0 if fewer than three."""
    count = 0
    for row in found.splitlines():
        if row.strip() != str(count + 1).encode():
            break
        count += 1
    return count if count > 2 else 0
