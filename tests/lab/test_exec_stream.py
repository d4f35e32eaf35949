"""The connection to a command in a container, tested with our own very fast daemon."""

from __future__ import annotations

import json
import socketserver
import struct
import threading
from collections.abc import Iterator
from pathlib import Path

import docker
import pytest

from grader.sandbox.execs import Frames
from lab.exec_stream import STDERR, STDOUT, ExecStream


class _Daemon(socketserver.StreamRequestHandler):
    """Answers `exec`; the command's first output arrives together with the response header."""

    def handle(self) -> None:
        while line := self.rfile.readline():
            length = 0
            while (header := self.rfile.readline().strip().lower()) != b"":
                if header.startswith(b"content-length:"):
                    length = int(header.partition(b":")[2])
            self.rfile.read(length)
            if b"/start " in line:
                head = b"HTTP/1.1 101 UPGRADED\r\nConnection: Upgrade\r\nUpgrade: tcp\r\n\r\n"
                self.wfile.write(head + b"first words")
                self.wfile.write(b", and the rest")
                return
            body = json.dumps({"Id": "made"}).encode()
            self.wfile.write(b"HTTP/1.1 201 Created\r\nContent-Type: application/json\r\n")
            self.wfile.write(b"Content-Length: %d\r\n\r\n%s" % (len(body), body))


class _Server(socketserver.ThreadingMixIn, socketserver.UnixStreamServer):
    daemon_threads = True


@pytest.fixture
def api(tmp_path: Path) -> Iterator[docker.APIClient]:
    with _Server(str(tmp_path / "sock"), _Daemon) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        client = docker.APIClient(base_url=f"unix://{tmp_path}/sock", version="1.41")
        yield client
        client.close()
        server.shutdown()
        thread.join()


def test_output_that_arrives_with_the_response_header_is_not_lost(api: docker.APIClient) -> None:
    stream = ExecStream(api, "any", ["true"], tty=True)
    output = b""
    while data := stream.read():
        output += data
    stream.close()
    assert output == b"first words, and the rest"


@pytest.mark.parametrize("size", [1, 7, 8, 9, 1000])
def test_the_two_streams_are_separated_however_they_are_split(size: int) -> None:
    sent = [(STDOUT, b"a" * 300), (STDERR, b"b"), (STDOUT, b""), (STDOUT, b"c\n")]
    wire = b"".join(struct.pack(">BxxxL", stream, len(text)) + text for stream, text in sent)
    frames = Frames()
    found = [part for at in range(0, len(wire), size) for part in frames.feed(wire[at : at + size])]
    assert found == sent
