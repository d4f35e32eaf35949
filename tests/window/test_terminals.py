"""The page's terminals: real shells, whose output a page gets again after it was away."""

from __future__ import annotations

import asyncio
import os
import re
from collections.abc import Awaitable, Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from lab.window.shells import OwnShells
from lab.window.terminals import KEPT, MOST_UNSEEN, PART, Output, Terminals, Viewer
from tests.window.programs import alive, until

SECONDS = 30


class Page:
    """A page that shows a terminal; it says at once that it has shown what it got."""

    def __init__(self, terminals: Terminals, number: int, *, shows: bool = True) -> None:
        terminal = terminals.get(number)
        assert terminal is not None
        self.got = bytearray()
        self.ended = False
        self.news = asyncio.Event()
        self._shows = shows
        self.viewer: Viewer = terminal.view(self._take, self._end)
        self._loop = asyncio.get_running_loop()
        terminal.start(24, 100)
        terminal.flow()

    def _take(self, data: bytes) -> None:
        self.got += data
        if self._shows:
            self._loop.call_soon(self.viewer.took, len(data))
        self.news.set()

    def _end(self) -> None:
        self.ended = True
        self.news.set()

    async def until(self, condition: Callable[[], object]) -> None:
        async def wait() -> None:
            while not condition():
                self.news.clear()
                await self.news.wait()

        await asyncio.wait_for(wait(), SECONDS)


def running(test: Callable[[Terminals], Awaitable[None]], folder: Path) -> None:
    async def run() -> None:
        environment = {
            "PATH": os.environ["PATH"],
            "HOME": str(folder),
            "PS1": "$ ",
            "TERM": "xterm",
        }
        terminals = Terminals(OwnShells(environment, folder), lambda: None)
        try:
            await test(terminals)
        finally:
            await terminals.close_all()
            assert terminals.numbers == []

    with ThreadPoolExecutor(1) as thread:  # (in this one, a browser may have its event loop)
        thread.submit(asyncio.run, run()).result()


def test_forty_thousand_lines_reach_the_page(tmp_path: Path) -> None:
    async def test(terminals: Terminals) -> None:
        page = Page(terminals, terminals.open())
        terminal = terminals.get(1)
        assert terminal is not None
        terminal.type("seq 40000; echo the-$((1+1))-end\n")
        await page.until(lambda: b"the-2-end" in page.got)
        assert b"\r\n39999\r\n40000\r\n" in page.got
        assert page.got.count(b"\n") > 40000

    running(test, tmp_path)


def test_a_page_that_shows_nothing_stops_the_program_and_not_another_page(tmp_path: Path) -> None:
    async def test(terminals: Terminals) -> None:
        slow = Page(terminals, terminals.open(), shows=False)
        terminal = terminals.get(1)
        assert terminal is not None
        terminal.type("yes | head -c 1000000; echo the-$((1+1))-end\n")
        await slow.until(lambda: len(slow.got) >= MOST_UNSEEN)
        assert len(slow.got) <= MOST_UNSEEN + PART
        assert terminal.output.end < 1_000_000, "the program waits"
        quick = Page(terminals, 1)
        await quick.until(lambda: b"the-2-end" in quick.got)
        assert len(slow.got) <= MOST_UNSEEN + PART
        slow.viewer.took(len(slow.got))
        assert slow.got.count(b"\x1bc") == 1, "what it has missed is gone: it begins anew"

    running(test, tmp_path)


def test_another_page_gets_what_was_printed_while_none_was_open(tmp_path: Path) -> None:
    async def test(terminals: Terminals) -> None:
        first = Page(terminals, terminals.open())
        terminal = terminals.get(1)
        assert terminal is not None
        terminal.type("x=kept; stty size; echo $((6*7))-a\n")
        await first.until(lambda: b"42-a" in first.got)
        assert b"24 100" in first.got
        terminal.leave(first.viewer)
        terminal.type("echo $x-$((6*7))-b > seen; cat seen\n")
        second = Page(terminals, 1)
        await second.until(lambda: b"kept-42-b" in second.got)
        assert b"42-a" in second.got

    running(test, tmp_path)


def test_a_shell_that_ends_is_forgotten_and_its_programs_are_hung_up(tmp_path: Path) -> None:
    async def test(terminals: Terminals) -> None:
        page = Page(terminals, terminals.open())
        terminal = terminals.get(1)
        assert terminal is not None
        terminal.type("exit 3\n")
        await page.until(lambda: page.ended)
        assert terminals.numbers == []
        for _ in range(10):  # (at this moment readline looks for signals and begins to wait)
            number = terminals.open()
            other = Page(terminals, number)
            shell = terminals.get(number)
            assert shell is not None
            shell.type("sleep 1000 & echo pid-$!-\n")
            said = re.compile(rb"pid-(\d+)-")  # (what was typed is shown too, perhaps twice)
            await other.until(lambda: said.search(other.got))  # noqa: B023 - called at once
            found = said.search(other.got)
            assert found is not None
            pid = int(found[1])
            await terminals.close(number)
            until(lambda: not alive(pid))  # noqa: B023 - called at once

    running(test, tmp_path)


def test_there_is_an_end_of_terminals(tmp_path: Path) -> None:
    async def test(terminals: Terminals) -> None:
        assert [terminals.open() for _ in range(13)] == [*range(1, 13), 0]

    running(test, tmp_path)


def test_the_newest_output_is_kept_and_what_is_gone_is_skipped() -> None:
    output = Output()
    for n in range(150_000):
        output.add(f"{n:08}\n".encode())
    assert output.end == 1_350_000
    assert KEPT <= output.end - output.begin <= 2 * KEPT
    data, place = output.part(0)
    assert data.startswith(b"\x1bc")
    assert data[2:11].endswith(b"\n")
    assert place == output.begin + (9 - output.begin % 9) % 9 + len(data) - 2
    assert output.part(output.end) == (b"", output.end)


def test_a_shell_that_does_not_hang_up_is_killed_and_forgotten(tmp_path: Path) -> None:
    async def test(terminals: Terminals) -> None:
        page = Page(terminals, terminals.open(), shows=False)
        terminal = terminals.get(1)
        assert terminal is not None
        terminal.type("trap '' HUP; echo is-$((1+1))-deaf; yes\n")
        await page.until(lambda: page.viewer.lags)
        assert b"is-2-deaf" in page.got

    running(test, tmp_path)
