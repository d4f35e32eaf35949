"""Who may use the window: the student's own browser, with the address that the command printed.

Every page of the internet can make a browser send requests to 127.0.0.1. Such a request lacks the
token (its cookie is SameSite=Strict), and it has another Origin; after DNS rebinding it has another
Host. Each of the three is refused by itself.
"""

from __future__ import annotations

import hmac
import ipaddress
import secrets
import struct
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import urlsplit

ROUTES = Path("/proc/net/route")
GATEWAY_FLAG = 0x2  # RTF_GATEWAY of <linux/route.h>


@dataclass(frozen=True)
class Access:
    """The rules for a window at a port (the same inside and outside of a container).

    `front` is the address of the page where another server passes the requests on, as
    `https://lab.example.org/user/ada/`; "" if the browser comes to the port itself.
    """

    port: int
    token: str = field(default_factory=lambda: secrets.token_urlsafe(32))
    front: str = ""

    @property
    def address(self) -> str:
        """The address to open, with the token."""
        return f"{self.front or f'http://127.0.0.1:{self.port}/'}?token={self.token}"

    @property
    def cookie(self) -> str:
        """The name of the cookie; a browser shares cookies between ports of a host."""
        return f"lab_window_{self.port}"

    @property
    def path(self) -> str:
        """The path of the page, for which the cookie is."""
        return urlsplit(self.front).path or "/"

    @property
    def sockets(self) -> list[str]:
        """The origins of our websockets."""
        return [
            f"{'wss' if of.startswith('https:') else 'ws'}:{of.partition(':')[2]}"
            for of in self._origins
        ]

    @property
    def _origins(self) -> list[str]:
        if self.front:
            return ["{0.scheme}://{0.netloc}".format(urlsplit(self.front))]
        return [f"http://127.0.0.1:{self.port}", f"http://localhost:{self.port}"]

    def is_host(self, host: str | None) -> bool:
        """Whether a Host header is one of ours."""
        return any(host == origin.partition("//")[2] for origin in self._origins)

    def is_origin(self, origin: str | None, host: str | None) -> bool:
        """Whether an Origin header is that of our own page at this host."""
        own = [each for each in self._origins if each.partition("//")[2] == host]
        return self.is_host(host) and origin in own

    def is_token(self, token: str | None) -> bool:
        """Whether a token is ours; compared in constant time."""
        return token is not None and hmac.compare_digest(token.encode(), self.token.encode())


@dataclass(frozen=True)
class Neighbourhood:
    """The IPv4 networks that this machine or container is directly on, and its gateways."""

    networks: tuple[ipaddress.IPv4Network, ...] = ()
    gateways: tuple[ipaddress.IPv4Address, ...] = ()

    def is_answered(self, address: str) -> bool:
        """Whether a connection from this address is answered at all.

        In a container, a connection to the published port comes from the gateway, or, with Docker
        Desktop, from outside of the network. Another container on the network gets no answer.
        """
        peer = ipaddress.ip_address(address)
        if peer.is_loopback or peer in self.gateways:
            return True
        return not any(peer in network for network in self.networks)


def neighbourhood(routes: Path = ROUTES) -> Neighbourhood:
    """Read the kernel's routes (proc(5)); addresses are hexadecimal, in the machine's byte order."""
    networks, gateways = [], []
    try:
        lines = routes.read_text(encoding="ascii").splitlines()[1:]
    except OSError:
        return Neighbourhood()
    for line in lines:
        _, destination, gateway, flags, _, _, _, mask, *_ = line.split()
        if int(flags, 16) & GATEWAY_FLAG:
            gateways.append(_address(gateway))
        else:
            networks.append(ipaddress.IPv4Network((_address(destination), str(_address(mask)))))
    return Neighbourhood(tuple(networks), tuple(gateways))


def _address(text: str) -> ipaddress.IPv4Address:
    return ipaddress.IPv4Address(struct.pack("=L", int(text, 16)))
