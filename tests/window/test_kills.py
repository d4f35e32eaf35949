"""Page, server and lab are killed at moments that nobody chose: files, progress, history are there."""

from __future__ import annotations

import contextlib
import os
import random
import re
import signal
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Error, Page, expect

from grader.base.unheard import unheard
from grader.ros.interfaces import with_turtlesim
from grader.ros.prefix import Ros
from lab.guide.progress import read_progress
from tests.lab.workspaces import PACKAGE, SOLUTION, after_step
from tests.pages.browser import Open
from tests.window.desk import (
    SLOW,
    SOON,
    lab_of,
    open_file,
    owned,
    page_lab,
    server_of,
    type_line,
    wait_for_prompt,
    write_text,
)
from tests.window.programs import children, until

pytestmark = [pytest.mark.full, pytest.mark.prefix, pytest.mark.long]
NODE = f"src/{PACKAGE}/{PACKAGE}/my_first_node.py"
TEXT = (SOLUTION / PACKAGE / "my_first_node.py").read_text()
KILLS = 20
TYPED = 5  # commands, one after the other
MOST_SECONDS = 1.5  # from the first key to the kill


class Student:
    """A student who writes, saves and types commands, in a lab whose parts are killed."""

    def __init__(self, visit: Open, workspace: Path) -> None:
        self._visit = visit
        self.workspace = workspace
        self._labs = contextlib.ExitStack()
        self.open_lab()

    def open_lab(self) -> None:
        """Open the lab, or open it again after a kill."""
        self._labs.close()
        self._address = self._labs.enter_context(page_lab(self.workspace))
        self.open_page()
        type_line(self.page, "kept=in-this-shell")

    def open_page(self) -> None:
        """Open the page in a new window of the browser."""
        self.page: Page = self._visit().page
        self.page.goto(self._address)
        expect(self.page.locator("#status")).to_have_text("connected", timeout=SLOW)
        wait_for_prompt(self.page)

    def close(self) -> None:
        """Close the lab."""
        self._labs.close()

    def work(self, number: int) -> None:
        """Save a text, type a command, and leave a draft: all of that is there from now on."""
        open_file(self.page, NODE)
        write_text(self.page, f"# saved {number}\n{TEXT}")
        type_line(self.page, f"echo command-{number}")
        wait_for_prompt(self.page)
        open_file(self.page, NODE)
        self.page.keyboard.press("Control+Home")
        self.page.keyboard.type(f"# draft {number}\n")
        until(lambda: f"# draft {number}\\n" in self.drafts())
        self.page.locator("#next-actions button", has_text=re.compile("int")).first.click()

    def go_on(self, number: int, killed: threading.Event) -> None:
        """Save another text and type commands until something of it is killed."""
        keyboard = self.page.keyboard
        with contextlib.suppress(Error):
            self.page.locator(".cm-content").focus()
            keyboard.press("Control+a")
            keyboard.insert_text(f"# later {number}\n{TEXT}")
            keyboard.press("Control+s")
            self.page.locator(".screen.chosen textarea").focus()
            for _ in range(TYPED):
                keyboard.insert_text("lab hint")
                keyboard.press("Enter")
        killed.wait()

    def drafts(self) -> str:
        """Return the drafts that the lab keeps, as JSON."""
        folder = self.workspace / ".lab/drafts"
        return "".join(path.read_text() for path in folder.glob("*") if path.is_file())

    def hints(self) -> int:
        """Return how many hints the progress has counted."""
        return sum(read_progress(self.workspace).of("hello_time").hints.values())


def renderers(page: Page) -> list[int]:
    """Return the processes that draw pages."""
    browser = page.context.browser
    assert browser is not None
    session = browser.new_browser_cdp_session()
    found = session.send("SystemInfo.getProcessInfo")["processInfo"]
    return [process["id"] for process in found if process["type"] == "renderer"]


@contextlib.contextmanager
def killed_soon(processes: list[int], seconds: float) -> Iterator[threading.Event]:
    """Kill processes after so many seconds; the event says when it is done."""
    done = threading.Event()

    def kill() -> None:
        for process in processes:
            with contextlib.suppress(ProcessLookupError):
                os.kill(process, signal.SIGKILL)
        done.set()

    timer = threading.Timer(seconds, kill)
    timer.start()
    try:
        yield done
    finally:
        timer.join()


def test_a_kill_of_page_server_or_lab_loses_nothing(
    visit: Open, ros_jazzy: Ros, tmp_path: Path
) -> None:
    with_turtlesim(ros_jazzy, notify=unheard)
    workspace = tmp_path / "ws"
    after_step(workspace, 6, TEXT)
    student = Student(visit, owned(workspace))
    chance = random.Random()
    try:
        for number in range(KILLS):
            kind = ("page", "server", "lab")[number % 3]
            moment = chance.uniform(0, MOST_SECONDS)
            print(f"{number}: {kind} after {moment:.3f} s")
            student.work(number)
            hints = student.hints()
            server = server_of(workspace)
            lab = lab_of(workspace)
            victims = {
                "page": renderers(student.page),
                "server": [server],
                "lab": [lab, *children(lab)],
            }[kind]
            with killed_soon(victims, moment) as killed:
                student.go_on(number, killed)
            if kind == "lab":
                student.open_lab()
            elif kind == "server":
                until(lambda: server_of(workspace) not in (0, server), 60)  # noqa: B023 - at once
                student.open_page()
            else:
                student.open_page()
            first, rest = (workspace / NODE).read_text().split("\n", 1)
            assert first in (f"# saved {number}", f"# later {number}")
            assert rest == TEXT
            open_file(student.page, NODE)
            unsaved = re.compile(rf"# (draft|later) {number}\b")
            expect(student.page.locator(".cm-content")).to_contain_text(unsaved, timeout=SOON)
            assert student.hints() >= hints
            assert f"echo command-{number}\n" in (workspace / ".lab/home/.bash_history").read_text()
            if kind != "lab":
                type_line(student.page, f"clear; echo $kept-{number}")
                rows = student.page.locator(".screen.chosen .xterm-rows")
                expect(rows).to_contain_text(f"in-this-shell-{number}", timeout=SOON)
    finally:
        student.close()
