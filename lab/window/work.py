"""The student's work behind the page: files, guide, check and terminals of one lab."""

from __future__ import annotations

import asyncio
import contextlib
import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from watchfiles import Change, awatch

from grader.base.errors import GraderError
from grader.base.folder import Folder
from lab.commands.events import DEBOUNCE, KEPT, STEP, counts
from lab.guide.opened import OpenedLab
from lab.guide.progress import FOLDER as OWN
from lab.window.checking import Checking
from lab.window.files import Files
from lab.window.guidance import Graph, Guidance
from lab.window.shells import KeptShells, OwnShells, Shells
from lab.window.terminals import Terminals
from lab.window.work_protocol import Asked, Close, Draft, Keep, Layout, Read, Save

Message = dict[str, Any]
Send = Callable[[Message], None]
WATCHED = (*KEPT, "ran")
LAYOUT = "page.json"
TICK = 5.0  # seconds after which the guide looks again while a page is open: at what no file tells
MOST_LAYOUT = 20_000  # bytes


class Work:
    """Answers what pages ask, and tells all of them what changes.

    `channel` leads to the keeper of the shells, if there is one.
    """

    def __init__(
        self,
        lab: OpenedLab,
        environment: Mapping[str, str],
        graph: Callable[[], Graph],
        channel: int | None = None,
    ) -> None:
        self.workspace = lab.workspace.resolve()
        self._translate = lab.translate
        self._files = Files(self.workspace)
        self._guidance = Guidance(lab, graph)
        self._guide: Message = {}
        self._pages: set[Send] = set()
        self._news = asyncio.Event()
        self._changed: set[str] = set()
        shells: Shells = OwnShells(environment, self.workspace)
        if channel is not None:
            shells = KeptShells(channel, environment, self.workspace)
        self.terminals = Terminals(shells, self._tell_terminals)
        program = Path(environment["LAB_PROGRAMS"], "check")
        self._checking = Checking(program, environment, self._tell)

    async def run(self) -> None:
        """Watch the workspace until this task is cancelled; then the terminals are closed."""
        self.terminals.take_kept()
        try:
            await asyncio.gather(self._watch(), self._look())
        finally:
            await asyncio.gather(self.terminals.close_all(), self._checking.close())

    def open(self, send: Send) -> None:
        """Add a page, and tell it everything."""
        self._pages.add(send)
        send(self._guidance.lesson)
        send({"kind": "layout", "layout": self._layout()})
        send({"kind": "files", "names": self._files.names()})
        send(self._terminals_now())
        send(self._checking.state)
        if self._guide:
            send(self._guide)
        self._news.set()

    def close(self, send: Send) -> None:
        """Forget a page."""
        self._pages.discard(send)

    def graph_changed(self) -> None:
        """Look again: a condition may be about the graph."""
        self._news.set()

    async def answer(self, asked: Asked) -> Message | None:
        """Do what a page asks, and return the answer: with `error` if it cannot be done."""
        try:
            answer = await self._answer(asked)
        except (GraderError, OSError) as error:
            answer = {"error": self._in_words(error)}
        return {**answer, "id": asked.id} if asked.id else None

    def _in_words(self, error: GraderError | OSError) -> str:
        if isinstance(error, OSError):
            return str(error.strerror or error)
        remedy = self._translate(error.remedy) if error.remedy else ""
        return f"{self._translate(error.message)}. {remedy}".strip()

    async def _answer(self, asked: Asked) -> Message:
        files = self._files
        if isinstance(asked, Read):
            found, draft = files.read(asked.path), files.draft(asked.path)
            more = {"draft": draft[0], "draft_version": draft[1]} if draft is not None else {}
            return {"text": found.text, "version": found.version, **more}
        if isinstance(asked, Save):
            return self._save(asked)
        if isinstance(asked, Draft):
            files.keep_draft(asked.path, asked.text, asked.version)
        elif isinstance(asked, Keep):
            return {"backup": files.keep(asked.path, asked.text.encode())}
        elif isinstance(asked, Layout):
            with Folder.open(self.workspace) as root, root.private(OWN) as own:
                own.replace(LAYOUT, asked.layout.encode())
        elif isinstance(asked, Close):
            await self.terminals.close(asked.number)
        elif asked.do == "files":
            return {"names": files.names()}
        elif asked.do == "hint":
            self._set_guide(await asyncio.to_thread(self._guidance.hint))
        elif asked.do == "open":
            return {"number": self.terminals.open()}
        elif asked.do == "check":
            self._checking.start()
        elif asked.do == "stop":
            self._checking.stop()
        return {}

    def _save(self, asked: Save) -> Message:
        files, backup = self._files, ""
        if asked.keeps:
            there = files.read(asked.path)
            if there.version == asked.version:
                backup = files.keep(asked.path, there.text.encode())
        saved = files.write(asked.path, asked.text, asked.version)
        if saved.conflict is not None:
            return {"conflict": saved.conflict.text, "version": saved.conflict.version}
        files.keep_draft(asked.path, None, "")
        return {"version": saved.version, "backup": saved.backup or backup}

    def _layout(self) -> str:
        try:
            with Folder.open(self.workspace) as root, root.private(OWN) as own:
                text = (own.read(LAYOUT) or b"")[:MOST_LAYOUT].decode()
            json.loads(text or "{}")
        except (OSError, ValueError, RecursionError):
            return ""
        return text

    def _tell(self, message: Message) -> None:
        for send in list(self._pages):
            send(message)

    def _terminals_now(self) -> Message:
        return {"kind": "terminals", "numbers": self.terminals.numbers}

    def _tell_terminals(self) -> None:
        self._tell(self._terminals_now())

    def _set_guide(self, state: Message) -> None:
        if state != self._guide:
            self._guide = state
            self._tell(state)

    async def _look(self) -> None:
        """Look at the guide's state after each change."""
        while True:
            with contextlib.suppress(asyncio.TimeoutError):
                await asyncio.wait_for(self._news.wait(), TICK)
            self._news.clear()
            changed, self._changed = sorted(self._changed), set()
            if not self._pages:
                continue
            if changed:
                self._tell({"kind": "files", "names": self._files.names(), "changed": changed})
            with contextlib.suppress(GraderError, OSError):
                if await asyncio.to_thread(self._guidance.moved):
                    self._tell(self._guidance.lesson)
                self._set_guide(await asyncio.to_thread(self._guidance.state))

    async def _watch(self) -> None:
        """Notice changed files."""

        def is_watched(_: Change, path: str) -> bool:
            return counts(Path(path), self.workspace, WATCHED)

        watched = awatch(
            self.workspace,
            watch_filter=is_watched,
            debounce=DEBOUNCE,
            step=STEP,
            ignore_permission_denied=True,
        )
        async for found in watched:
            paths = [Path(path).relative_to(self.workspace) for _, path in found]
            self._changed |= {path.as_posix() for path in paths if path.parts[:1] != (OWN,)}
            self._news.set()
