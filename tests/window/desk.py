"""A student in the lab's page: what the tests of the page do there."""

from __future__ import annotations

import contextlib
import os
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

from playwright.sync_api import Page, expect

from grader.course.load import load_assignment
from tests import processes
from tests.domains import new_domain
from tests.lab.screen import command, environment
from tests.window.programs import ADDRESS

SLOW = 120_000  # ms; a build beside other tests
SOON = 30_000
MOST_ACTIONS = 40


@contextlib.contextmanager
def page_lab(workspace: Path, *options: str, **more: str) -> Iterator[str]:
    """Open the lab of a workspace in the browser; yield the address."""
    line = command("--sandbox", "bubblewrap", "--workspace", workspace, "--page", *options)
    lab = subprocess.Popen(
        line,
        env=environment(**{"ROS_DOMAIN_ID": new_domain(), **more}),
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    try:
        assert lab.stdout is not None
        yield next(filter(None, map(ADDRESS.search, lab.stdout)))[0]
    finally:
        lab.terminate()
        lab.wait(20)
        assert lab.stdout is not None
        lab.stdout.close()


def server_of(workspace: Path) -> int:
    """Return the process of the server of a workspace's page; 0 if it does not run."""
    mark = f"LAB_WORKSPACE={workspace}".encode()
    for entry in Path("/proc").iterdir():
        with contextlib.suppress(OSError):
            words = (entry / "cmdline").read_bytes().split(b"\0")
            is_server = b"--served" in words and not any(w.endswith(b"keeper.py") for w in words)
            if is_server and mark in (entry / "environ").read_bytes().split(b"\0"):
                return int(entry.name)
    return 0


def lab_of(workspace: Path) -> int:
    """Return the process that has opened the lab of a workspace with its page; 0 if none."""
    for entry in Path("/proc").iterdir():
        with contextlib.suppress(OSError):
            words = (entry / "cmdline").read_bytes().split(b"\0")
            if b"--page" in words and str(workspace).encode() in words:
                return int(entry.name)
    return 0


def owned(workspace: Path) -> Path:
    """Give a workspace that root has made to the lab's student, and return it."""
    if os.geteuid() == 0:
        for path in (workspace, *workspace.rglob("*")):
            os.chown(path, 1000, 1000, follow_symlinks=False)
    return workspace


def show(page: Page, pane: str) -> None:
    """Bring a pane to the front."""
    page.locator(f"nav a[href='#{pane}']").click()
    expect(page.locator(f"section#{pane}")).to_be_visible()


def wait_for_prompt(page: Page) -> None:
    """Wait until the chosen terminal has a prompt in its last line."""
    rows = page.locator(".screen.chosen .xterm-rows")
    expect(rows).to_have_text(re.compile(r"student@lab-\w+:[^$]*\$\s*$"), timeout=SLOW)


def type_line(page: Page, line: str) -> None:
    """Type a line into the chosen terminal."""
    wait_for_prompt(page)
    page.locator(".screen.chosen textarea").focus()
    page.keyboard.insert_text(line)
    expect(page.locator(".screen.chosen .xterm-rows")).to_contain_text(line[-8:], timeout=SLOW)
    page.keyboard.press("Enter")


def open_file(page: Page, path: str) -> None:
    """Open a file of the workspace by the list."""
    show(page, "editor")
    page.locator("#open-file summary").click()
    page.locator("#file-search").fill(path)
    page.locator("#file-list button").first.click()
    expect(page.locator(".cm-content")).to_have_attribute("aria-label", re.compile(re.escape(path)))


def write_text(page: Page, text: str) -> None:
    """Replace the text in the editor, and save it."""
    page.locator(".cm-content").focus()
    page.keyboard.press("Control+a")
    page.keyboard.insert_text(text)
    page.keyboard.press("Control+s")
    expect(page.locator("#save")).to_be_disabled()


class PagePlayer:
    """Plays a lesson by the guide of the page. What a student must invent comes from the solution."""

    def __init__(self, page: Page, lesson: str, workspace: Path) -> None:
        self.page = page
        self.workspace = workspace
        self.assignment = load_assignment(
            processes.ROOT / "lab/course" / lesson / "assignment.yaml"
        )
        package = self.assignment.package
        self.source = f"src/{package}"
        self.inner = f"{package}/{self.assignment.node_file}"
        self.solution = processes.ROOT / "grader/keys" / lesson / "solution" / package
        self.played: list[str] = []

    def play(self) -> None:
        """Do what the guide says until nothing is left."""
        for _ in range(MOST_ACTIONS):
            if self.page.locator("#next.ready").count():
                return
            action = self.page.locator("#todo").inner_text().strip()
            self.played.append(action)
            self._do(action)
            expect(self.page.locator("#todo")).not_to_have_text(action, timeout=SLOW)
        raise AssertionError(f"no end: {self.played}")

    def follow(self, command: str) -> None:
        """Do what the guide says when a lesson is done: its button writes this command."""
        expect(self.page.locator("#todo")).to_contain_text(command, timeout=SLOW)
        self._write()
        wait_for_prompt(self.page)

    def _do(self, action: str) -> None:
        page, package = self.page, self.assignment.package
        if action == "check":
            page.locator("#next-actions button.main").click()
        elif action.startswith(f"ros2 run {package}"):
            self._run(f"/{self.assignment.node_name}")
        elif action.startswith("ros2 run turtlesim"):
            self._run("/turtlesim")
        elif page.locator("#todo code").count():
            self._write()
        elif "console_scripts" in action:
            (entry,) = re.findall(r"'.* = .*:.*',", action)
            self._change("setup.py", "'console_scripts': [", f"'console_scripts': [{entry}")
        elif "<depend>" in action:
            lines = "\n  ".join(["<depend>rclpy</depend>", *re.findall(r"<depend>\S+", action)])
            self._change("package.xml", "<depend>rclpy</depend>", lines)
        else:
            open_file(page, f"{self.source}/{self.inner}")
            write_text(page, (self.solution / self.inner).read_text())

    def _write(self) -> None:
        """Press the button that writes the command into the terminal, and Enter."""
        wait_for_prompt(self.page)
        self.page.locator("#next-actions button.main").click()
        self.page.keyboard.press("Enter")

    def _run(self, node: str) -> None:
        """Run a program, and stop it with Ctrl+C when the graph shows its node."""
        self._write()
        show(self.page, "graph")
        box = self.page.locator(f"g.node[data-id='node {node}']")
        box.wait_for(timeout=SLOW)
        self.page.locator(".screen.chosen textarea").focus()
        self.page.keyboard.press("Control+c")
        wait_for_prompt(self.page)

    def _change(self, file: str, old: str, new: str) -> None:
        open_file(self.page, f"{self.source}/{file}")
        text = (self.workspace / self.source / file).read_text()
        assert old in text
        write_text(self.page, text.replace(old, new))
