"""The door of a lab in the browser: a socket of this machine that a lab with another network serves.

It is opened here, before the lab, and given to the page's server. What listens on it is reached from
this machine's 127.0.0.1 only, and the lab's network stays closed.
"""

from __future__ import annotations

import os
import socket
import webbrowser

from lab.window.access import Access
from lab.window.published import DESCRIPTOR, LOCALHOST, TOKEN, has_browser

WAITING = 64  # connections that the lab has not taken yet


class Door:
    """A listening socket, and the address by which a browser comes to it."""

    def __init__(self) -> None:
        self._socket = socket.create_server((LOCALHOST, 0), backlog=WAITING)
        self._access = Access(self._socket.getsockname()[1])

    @property
    def descriptor(self) -> int:
        """The socket's descriptor, to be passed on."""
        return self._socket.fileno()

    @property
    def variables(self) -> dict[str, str]:
        """The variables by which the page's server knows it."""
        return {DESCRIPTOR: str(self.descriptor), TOKEN: self._access.token}

    def show(self) -> None:
        """Leave the door to the lab, and open the browser if there is one: it waits for the answer."""
        self._socket.close()
        if has_browser(os.environ):
            webbrowser.open(self._access.address)
