"""The port that the lab's container publishes for the window, on this machine's 127.0.0.1 only.

It has the same number inside, so that the window knows the address that the browser uses.
"""

from __future__ import annotations

import socket
from typing import Any

PORT = "LAB_WINDOW_PORT"
HOST = "LAB_WINDOW_HOST"
"""Variables in the container: the published port, and where the window listens."""
LOCALHOST = "127.0.0.1"
EVERY_ADDRESS = "0.0.0.0"  # noqa: S104 - of the container
TAKEN = ("port is already allocated", "address already in use")  # in the daemon's messages


def published() -> dict[str, Any]:
    """Return the options of `containers.create` that publish a port which is free now."""
    with socket.socket() as probe:
        probe.bind((LOCALHOST, 0))
        port = int(probe.getsockname()[1])
    return {
        "ports": {f"{port}/tcp": (LOCALHOST, port)},
        "environment": {PORT: str(port), HOST: EVERY_ADDRESS},
    }


def is_taken(error: Exception) -> bool:
    """Whether a container did not start because another program took the port meanwhile."""
    return any(text in str(error) for text in TAKEN)
