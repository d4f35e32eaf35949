"""The window answers only the student's own browser."""

from __future__ import annotations

import asyncio
import contextlib
import ipaddress
import json
import os
import socket
from collections.abc import AsyncIterator, Awaitable, Callable
from pathlib import Path
from typing import Any

import pytest
from tornado.httpclient import AsyncHTTPClient, HTTPRequest, HTTPResponse
from tornado.netutil import bind_sockets
from tornado.websocket import websocket_connect

from lab.guide.opened import opened_lab
from lab.window.access import Access, Neighbourhood, neighbourhood
from lab.window.hub import Hub
from lab.window.server import FILES, TYPES, make_server
from lab.window.texts import page_texts
from lab.window.work import Work

CONTAINER = """\
Iface\tDestination\tGateway \tFlags\tRefCnt\tUse\tMetric\tMask\t\tMTU\tWindow\tIRTT
eth0\t00000000\t010011AC\t0003\t0\t0\t0\t00000000\t0\t0\t0
eth0\t000011AC\t00000000\t0001\t0\t0\t0\t0000FFFF\t0\t0\t0
"""
FILE_NAMES = sorted(
    path.relative_to(FILES).as_posix() for path in FILES.rglob("*") if path.suffix in TYPES
)
PATHS = ["/texts.json", "/missing", *(f"/{name}" for name in FILE_NAMES if name != "index.html")]


@contextlib.asynccontextmanager
async def work_in(folder: Path) -> AsyncIterator[Work]:
    """A student's work in a lab without nodes, with one terminal."""
    (folder / "src").mkdir()
    (folder / "src" / "mine.py").write_text("mine\n")
    lab = opened_lab("en", folder)
    work = Work(lab, {"LAB_PROGRAMS": "/nonexistent", "PATH": os.environ["PATH"]}, dict)
    try:
        work.terminals.open()
        yield work
    finally:
        await work.terminals.close_all()


class Client:
    """A browser without its rules: it sends the headers that a test wants."""

    def __init__(self, access: Access) -> None:
        self.access = access
        self.origin = f"http://127.0.0.1:{access.port}"
        self.cookie = f"{access.cookie}={access.token}"

    async def get(self, path: str, **headers: str) -> HTTPResponse:
        request = HTTPRequest(f"{self.origin}{path}", headers=headers, follow_redirects=False)
        return await AsyncHTTPClient(force_instance=True).fetch(request, raise_error=False)

    async def socket(self, path: str = "/socket", **headers: str) -> Any:
        request = HTTPRequest(f"ws://127.0.0.1:{self.access.port}{path}", headers=headers)
        return await websocket_connect(request)

    async def socket_status(self, path: str = "/socket", **headers: str) -> int:
        """Return the status that refuses a websocket; 101 if it opens."""
        from tornado.httpclient import HTTPClientError

        try:
            opened = await self.socket(path, **headers)
        except HTTPClientError as error:
            return error.code
        opened.close()
        return 101


def serving(
    check: Callable[[Client], Awaitable[None]],
    *,
    host: str = "127.0.0.1",
    neighbours: Neighbourhood | None = None,
    workspace: Path | None = None,
    front: str = "",
) -> None:
    """Run a check against a server without a bridge, with the work in a workspace if there is one."""

    async def run() -> None:
        sockets = bind_sockets(0, host, family=socket.AF_INET)
        access = Access(sockets[0].getsockname()[1], front=front)
        async with contextlib.AsyncExitStack() as opened:
            work = None
            if workspace is not None:
                work = await opened.enter_async_context(work_in(workspace))
            near = neighbours or Neighbourhood()
            server = make_server(access, Hub(), page_texts("en"), near, work)
            server.add_sockets(sockets)
            try:
                await check(Client(access))
            finally:
                server.stop()
                await server.close_all_connections()

    asyncio.run(run())


def test_the_printed_address_gives_the_page_and_a_cookie_for_it_alone() -> None:
    async def check(client: Client) -> None:
        page = await client.get(f"/?token={client.access.token}")
        assert page.code == 200
        assert page.headers["Content-Type"] == "text/html; charset=utf-8"
        cookie = page.headers["Set-Cookie"]
        assert cookie.startswith(f"{client.cookie};")
        assert "HttpOnly" in cookie
        assert "SameSite=Strict" in cookie
        for path in ("/", *PATHS):
            found = await client.get(path, Cookie=client.cookie)
            assert found.code == (404 if path == "/missing" else 200), path

    serving(check)


def test_nothing_is_cached_and_nothing_from_elsewhere_may_run() -> None:
    async def check(client: Client) -> None:
        page = await client.get("/", Cookie=client.cookie)
        rules = dict(
            rule.strip().split(" ", 1)
            for rule in page.headers["Content-Security-Policy"].split(";")
        )
        assert rules["default-src"] == "'none'"
        assert rules["script-src"] == "'self'"
        assert rules["frame-ancestors"] == rules["base-uri"] == "'none'"
        for path in ("/", *PATHS):
            found = await client.get(path, Cookie=client.cookie)
            assert found.headers["Cache-Control"] == "no-store", path
            assert found.headers["X-Content-Type-Options"] == "nosniff", path
            assert "Server" not in found.headers, path

    serving(check)


def test_without_the_token_every_path_is_refused() -> None:
    async def check(client: Client) -> None:
        name, wrong = client.access.cookie, "x" * len(client.access.token)
        for path in ("/", f"/?token={wrong}", "/?token=", *PATHS):
            for cookie in ("", f"{name}={wrong}", f"{name}=", f"other={client.access.token}"):
                assert (await client.get(path, Cookie=cookie)).code == 403, (path, cookie)
        # only the page itself takes the token from the address
        for path in PATHS:
            assert (await client.get(f"{path}?token={client.access.token}")).code == 403, path

    serving(check)


def test_a_wrong_host_or_origin_is_refused_even_with_the_token() -> None:
    async def check(client: Client) -> None:
        port = client.access.port
        for path in ("/", f"/?token={client.access.token}", *PATHS):
            for host in (f"evil.example:{port}", f"127.0.0.1:{port + 1}", "127.0.0.1", ""):
                found = await client.get(path, Cookie=client.cookie, Host=host)
                # (tornado itself answers an empty Host)
                assert found.code in ((400, 403) if not host else (403,)), (path, host)
            for origin in ("http://evil.example", f"http://localhost:{port}", "null"):
                found = await client.get(path, Cookie=client.cookie, Origin=origin)
                assert found.code == 403, (path, origin)

    serving(check)


@pytest.mark.parametrize("path", ["/socket", "/work", "/terminal/1"])
def test_each_websocket_is_refused_by_the_same_rules(path: str, tmp_path: Path) -> None:
    async def check(client: Client) -> None:
        right = {"Cookie": client.cookie, "Origin": client.origin}
        assert await client.socket_status(path, **right) == 101
        wrong = [
            {"Cookie": f"{client.access.cookie}=x", "Origin": client.origin},
            {"Origin": client.origin},
            {"Cookie": client.cookie},  # a browser always sends its origin
            {**right, "Origin": "http://evil.example"},
            {**right, "Origin": "null"},
            {**right, "Origin": f"http://127.0.0.1:{client.access.port + 1}"},
            {**right, "Origin": f"https://127.0.0.1:{client.access.port}"},
            {**right, "Host": f"evil.example:{client.access.port}"},
            {
                **right,
                "Host": f"evil.example:{client.access.port}",
                "Origin": f"http://evil.example:{client.access.port}",
            },
        ]
        for headers in wrong:
            assert await client.socket_status(path, **headers) == 403, headers
        assert (await client.get(path)).code == 403

    serving(check, workspace=tmp_path)


def test_behind_another_server_only_its_address_is_ours(tmp_path: Path) -> None:
    async def check(client: Client) -> None:
        name = client.access.cookie
        page = await client.get(f"/?token={client.access.token}", Host="lab.example.org")
        assert page.code == 200
        assert "Path=/user/ada/;" in page.headers["Set-Cookie"] + ";"
        assert "Secure" in page.headers["Set-Cookie"]
        assert " wss://lab.example.org;" in page.headers["Content-Security-Policy"]
        right = {
            "Cookie": f"{name}={client.access.token}",
            "Host": "lab.example.org",
            "Origin": "https://lab.example.org",
        }
        for path in ("/work", "/terminal/1", "/socket"):
            assert await client.socket_status(path, **right) == 101
            for wrong in (
                {"Host": f"127.0.0.1:{client.access.port}", "Origin": client.origin},
                {"Origin": "http://lab.example.org"},
                {"Origin": "https://lab.example.org.evil.example"},
                {"Cookie": f"{name}=x"},
            ):
                assert await client.socket_status(path, **{**right, **wrong}) == 403, wrong

    serving(check, workspace=tmp_path, front="https://lab.example.org/user/ada/")


def test_without_a_lab_there_is_no_work_to_reach() -> None:
    async def check(client: Client) -> None:
        right = {"Cookie": client.cookie, "Origin": client.origin}
        for path in ("/work", "/terminal/1"):
            assert await client.socket_status(path, **right) == 404

    serving(check)


def test_a_terminal_that_is_none_ends_the_connection(tmp_path: Path) -> None:
    async def check(client: Client) -> None:
        right = {"Cookie": client.cookie, "Origin": client.origin}
        opened = await client.socket("/terminal/7", **right)
        assert await opened.read_message() is None
        assert opened.close_code == 4004
        for path in ("/terminal/-1", "/terminal/1/2", "/terminal/"):
            assert await client.socket_status(path, **right) == 404, path

    serving(check, workspace=tmp_path)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"do": "read", "path": "../mine.py"}, "is no file of the workspace"),
        ({"do": "read", "path": "src/other.py"}, "cannot be opened"),
        ({"do": "save", "path": "/tmp/x", "text": "", "version": ""}, "is no file"),
        ({"do": "draft", "path": ".lab/progress.json", "text": "", "version": ""}, "is no file"),
    ],
)
def test_a_wrong_path_is_answered_with_what_to_do(
    asked: dict[str, str], said: str, tmp_path: Path
) -> None:
    async def check(client: Client) -> None:
        opened = await client.socket("/work", Cookie=client.cookie, Origin=client.origin)
        await opened.write_message(json.dumps({"id": 1, **asked}))
        while (answer := json.loads(await opened.read_message())).get("id") != 1:
            pass
        assert said in answer["error"]

    serving(check, workspace=tmp_path)


@pytest.mark.parametrize(
    "text",
    [
        "no json",
        '{"do": "shout"}',
        '{"do": "drive", "turtle": "/t", "linear": 1e999, "angular": 0}',
        '{"do": "watch", "views": ["kitchen"]}',
        '{"do": "watch", "views": ["plot"], "series": [["a", "b", "c"]]}',
        '{"do": "set", "id": 1, "node": "/n", "name": "p", "type": "bool", "text": true}',
    ],
)
def test_a_message_that_no_page_sends_ends_the_connection(text: str, tmp_path: Path) -> None:
    async def check(client: Client) -> None:
        for path in ("/socket", "/work", "/terminal/1"):
            opened = await client.socket(path, Cookie=client.cookie, Origin=client.origin)
            await opened.write_message(text)
            while await opened.read_message() is not None:
                pass
            assert opened.close_code == 1008, path

    serving(check, workspace=tmp_path)


def test_the_outer_address_of_this_machine_does_not_answer() -> None:
    async def check(client: Client) -> None:
        with pytest.raises(ConnectionRefusedError):
            await asyncio.open_connection(outer_address(), client.access.port)

    serving(check)


def test_a_neighbour_of_a_container_gets_no_answer() -> None:
    """The server listens on every address, as in a container; we call from an outer one."""

    async def check(client: Client) -> None:
        reader, writer = await asyncio.open_connection(outer_address(), client.access.port)
        writer.write(f"GET /?token={client.access.token} HTTP/1.1\r\n\r\n".encode())
        try:
            assert await reader.read() == b""
        except ConnectionResetError:
            pass
        finally:
            writer.close()
        assert (await client.get("/", Cookie=client.cookie)).code == 200

    own = ipaddress.IPv4Network(f"{outer_address()}/32")
    serving(check, host="0.0.0.0", neighbours=Neighbourhood(networks=(own,)))


def test_in_a_container_only_the_gateway_and_outsiders_are_answered(tmp_path: Path) -> None:
    routes = tmp_path / "route"
    routes.write_text(CONTAINER)
    found = neighbourhood(routes)
    assert found.is_answered("127.0.0.1")
    assert found.is_answered("172.17.0.1")  # the gateway: a published port
    assert found.is_answered("192.168.65.1")  # the same with Docker Desktop
    assert not found.is_answered("172.17.0.3")
    assert not found.is_answered("172.17.200.9")


def outer_address() -> str:
    """Return an address of this machine that is not a loopback one."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.connect(("192.0.2.1", 9))  # (sends nothing)
        address = str(probe.getsockname()[0])
    assert not ipaddress.ip_address(address).is_loopback
    return address
