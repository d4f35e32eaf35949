"""The `window` command: how it starts, what it refuses, and that nothing is left running."""

from __future__ import annotations

import asyncio
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import urllib.error
import urllib.request
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from tornado.httpclient import HTTPRequest
from tornado.websocket import websocket_connect

from lab.window.server import TYPES
from tests.installed import npm_packages
from tests.lab.screen import command, environment
from tests.window.programs import ADDRESS, ROOT, OpenWindow, alive, until, window

START_SECONDS = 60  # for the bridge, on a busy machine
PAGE = ROOT / "lab" / "window" / "page"
VENDOR = PAGE / "vendor"


def run(*options: str, env: dict[str, str]) -> subprocess.CompletedProcess[str]:
    words = [sys.executable, "-m", "lab.window", *options]
    return subprocess.run(
        words, env=env, cwd=ROOT, capture_output=True, text=True, timeout=60, check=False
    )


def test_without_ros_it_says_where_to_run_it() -> None:
    done = run(env={"PATH": os.environ["PATH"], "LC_ALL": "C.UTF-8"})
    assert done.returncode == 3
    assert "ROS is not set up in this terminal" in done.stderr
    assert "make lab" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.prefix
@pytest.mark.full
def test_a_port_in_use_and_a_wrong_host_are_refused(ros_env: dict[str, str]) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        done = run("--port", str(port), env=ros_env)
        assert done.returncode == 3
        assert f"port {port} is in use" in done.stderr
    done = run("--host", "everywhere", env=ros_env)
    assert done.returncode == 2
    assert "'everywhere' is not an IPv4 address" in done.stderr


@pytest.mark.prefix
@pytest.mark.full
def test_ctrl_c_ends_the_bridge_too(ros_env: dict[str, str]) -> None:
    with window(ros_env) as opened:
        bridge = opened.bridge
        opened.process.send_signal(signal.SIGINT)
        assert opened.process.wait(10) == 0
        assert not alive(bridge)


@pytest.mark.prefix
@pytest.mark.full
def test_a_killed_window_leaves_no_bridge(ros_env: dict[str, str]) -> None:
    with window(ros_env) as opened:
        bridge = opened.bridge
        opened.process.kill()
        opened.process.wait()
        until(lambda: not alive(bridge), 10)


@pytest.mark.prefix
@pytest.mark.full
def test_a_bridge_that_ends_is_started_again(opened: OpenWindow) -> None:
    before = opened.bridge
    os.kill(before, signal.SIGKILL)
    assert until(lambda: opened.bridge != before and opened.bridge)
    assert alive(opened.bridge)


def first_state(port: int, cookie: str) -> dict[str, str]:
    """Return the first message about the bridge that the websocket tells."""

    async def ask() -> dict[str, str]:
        headers = {"Cookie": cookie, "Origin": f"http://127.0.0.1:{port}"}
        request = HTTPRequest(f"ws://127.0.0.1:{port}/socket", headers=headers)
        socket = await websocket_connect(request)
        while True:
            text = await asyncio.wait_for(socket.read_message(), START_SECONDS)
            assert text is not None
            for message in json.loads(text):
                if message["kind"] == "bridge":
                    socket.close()
                    return dict(message)

    with ThreadPoolExecutor(1) as thread:  # the browser of another test has this thread's loop
        return thread.submit(asyncio.run, ask()).result()


@pytest.mark.full
@pytest.mark.prefix
def test_in_the_lab_the_printed_address_is_reachable_from_the_host(tmp_path: Path) -> None:
    line = command("--sandbox", "bubblewrap", "--workspace", tmp_path / "ws", "--", "window")
    lab = subprocess.Popen(
        line, env=environment(), stdout=subprocess.PIPE, text=True, start_new_session=True
    )
    try:
        assert lab.stdout is not None
        match = next(filter(None, map(ADDRESS.search, lab.stdout)))
        with urllib.request.urlopen(match[0], timeout=10) as answer:
            assert answer.status == 200
            assert b'<section id="turtle"' in answer.read()
            cookie = answer.headers["Set-Cookie"].partition(";")[0]
        ready = {"kind": "bridge", "state": "ready", "distro": "jazzy"}
        assert first_state(int(match[1]), cookie) == ready
        with pytest.raises(urllib.error.HTTPError, match="403"):
            urllib.request.urlopen(f"http://127.0.0.1:{match[1]}/", timeout=10)
    finally:
        lab.terminate()
        lab.wait(20)
        assert lab.stdout is not None
        lab.stdout.close()
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection(("127.0.0.1", int(match[1])), timeout=10)


@pytest.mark.full
def test_the_vendored_libraries_are_those_of_the_lock_file(tmp_path: Path) -> None:
    packages = npm_packages(VENDOR)
    sources = {
        "dagre.esm.js": "@dagrejs/dagre/dist/dagre.esm.js",
        "dagre.LICENSE": "@dagrejs/dagre/LICENSE",
        "uPlot.iife.min.js": "uplot/dist/uPlot.iife.min.js",
        "uPlot.min.css": "uplot/dist/uPlot.min.css",
        "uPlot.LICENSE": "uplot/LICENSE",
        "xterm.esm.js": "@xterm/xterm/lib/xterm.mjs",
        "xterm.css": "@xterm/xterm/css/xterm.css",
        "xterm.LICENSE": "@xterm/xterm/LICENSE",
        "xterm-fit.esm.js": "@xterm/addon-fit/lib/addon-fit.mjs",
        "codemirror.LICENSE": "@codemirror/state/LICENSE",
    }
    built = {"codemirror.source.mjs", "codemirror.esm.js"}
    ours = {path.name for path in VENDOR.iterdir() if path.suffix != ".json"}
    assert ours == set(sources) | built
    for name, source in sources.items():
        assert (VENDOR / name).read_bytes() == (packages / source).read_bytes(), name
    for name in ("package.json", "codemirror.source.mjs"):
        shutil.copy(VENDOR / name, tmp_path)
    (tmp_path / "node_modules").symlink_to(packages)
    subprocess.run(["npm", "run", "build"], cwd=tmp_path, check=True, capture_output=True)
    assert (tmp_path / "codemirror.esm.js").read_bytes() == (
        VENDOR / "codemirror.esm.js"
    ).read_bytes()


def test_the_page_is_small() -> None:
    files = [path for path in PAGE.rglob("*") if path.suffix in TYPES]
    assert sum(path.stat().st_size for path in files) < 3_000_000
