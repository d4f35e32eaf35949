"""The port that the lab's container publishes for the window, on this machine's 127.0.0.1 only.

It has the same number inside, so that the window knows the address that the browser uses.
"""

from __future__ import annotations

import socket
from collections.abc import Mapping
from typing import Any

PORT = "LAB_WINDOW_PORT"
HOST = "LAB_WINDOW_HOST"
"""Variables in the container: the published port, and where the window listens."""
DESCRIPTOR = "LAB_WINDOW_DESCRIPTOR"
"""The variable with the descriptor of a socket that is open already."""
TOKEN = "LAB_WINDOW_TOKEN"  # noqa: S105 - the name of a variable
"""The variable with a token that the caller chose, because it has to know the address."""
IN_PAGE = "LAB_IN_PAGE"
"""The variable in the terminals of a page."""
LOCALHOST = "127.0.0.1"
EVERY_ADDRESS = "0.0.0.0"  # noqa: S104 - of the container
TAKEN = ("port is already allocated", "address already in use")  # in the daemon's messages


def has_browser(environment: Mapping[str, str]) -> bool:
    """Whether a browser can be opened from here: a desktop, and not in the lab."""
    desktop = environment.get("DISPLAY") or environment.get("WAYLAND_DISPLAY")
    return bool(desktop) and not environment.get("LAB_PROGRAMS")


def published(environment: Mapping[str, str]) -> dict[str, Any]:
    """Return the options of `containers.create` that publish a port which is free now.

    The container's variables are `environment` and those that name the port.
    """
    with socket.socket() as probe:
        probe.bind((LOCALHOST, 0))
        port = int(probe.getsockname()[1])
    return {
        "ports": {f"{port}/tcp": (LOCALHOST, port)},
        "environment": {**environment, PORT: str(port), HOST: EVERY_ADDRESS},
    }


def is_taken(error: Exception) -> bool:
    """Whether a container did not start because another program took the port meanwhile."""
    return any(text in str(error) for text in TAKEN)
