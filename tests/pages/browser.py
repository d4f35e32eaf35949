"""Chromium from Debian's packages, without its own network requests."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, Page, sync_playwright

from tests.installed import installed

FLAGS = (
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)


@contextmanager
def browser() -> Iterator[Browser]:
    """Start headless Chromium with a temporary profile."""
    path = installed("chromium", "chromium")
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(
            executable_path=path, headless=True, chromium_sandbox=False, args=list(FLAGS)
        )
        try:
            yield started
        finally:
            started.close()


@dataclass
class PageRecord:
    """Records what the open page did: requested addresses, console errors, windows."""

    page: Page
    requests: list[str] = field(default_factory=list)
    complaints: list[str] = field(default_factory=list)
    dialogs: list[str] = field(default_factory=list)

    def open(self, path: Path, part: str = "") -> Page:
        """Open a page and discard the records of the one before."""
        for kept in (self.requests, self.complaints, self.dialogs):
            kept.clear()
        self.page.goto(path.as_uri() + part)
        return self.page


Open = Callable[..., PageRecord]


@contextmanager
def opening(started: Browser) -> Iterator[Open]:
    """Yield a function that opens a page in a separate context (options as new_context)."""
    contexts = []

    def new(**options: Any) -> PageRecord:
        context = started.new_context(**options)
        contexts.append(context)
        witness = PageRecord(context.new_page())
        page = witness.page
        context.on("request", lambda request: witness.requests.append(request.url))
        page.on("console", lambda message: witness.complaints.append(message.text))
        page.on("pageerror", lambda error: witness.complaints.append(str(error)))

        def dismiss(dialog: Any) -> None:
            witness.dialogs.append(dialog.message)
            dialog.dismiss()

        page.on("dialog", dismiss)
        return witness

    try:
        yield new
    finally:
        for context in contexts:
            context.close()
