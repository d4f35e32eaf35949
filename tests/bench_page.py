"""`python -m tests.bench_page`: how fast and how large the page of a lab is (the machine must be idle).

Typing echo is the time from a key to the character in the terminal of the page. Processor time and
memory (PSS) are of all processes of one lab with its page, without the browser.
"""

from __future__ import annotations

import os
import statistics
import tempfile
import time
from pathlib import Path

from playwright.sync_api import Page, expect

from grader.base.unheard import unheard
from grader.ros.distro import find_distro
from grader.ros.interfaces import with_turtlesim
from grader.sandbox.proof import proven_ros
from tests.lab.workspaces import PACKAGE, SOLUTION, after_step
from tests.pages.browser import browser, opening
from tests.window.desk import SLOW, lab_of, owned, page_lab, wait_for_prompt
from tests.window.programs import children, ros_environment, turtles, window
from tests.window.test_page import COUNT_FRAMES

KEYS = 60
SETTLE, IDLE = 15.0, 30.0  # s
ECHO = """async () => {
    const rows = document.querySelector(".screen.chosen .xterm-rows");
    const area = document.querySelector(".screen.chosen textarea");
    area.focus();
    const before = rows.innerText.split("x").length;
    const shown = new Promise(done => {
        const watch = new MutationObserver(() => {
            if (rows.innerText.split("x").length > before) { watch.disconnect(); done(performance.now()); }
        });
        watch.observe(rows, { childList: true, characterData: true, subtree: true });
    });
    const typed = new Promise(done => document.addEventListener("keydown", () => done(performance.now()), { once: true, capture: true }));
    window.echoed = Promise.all([typed, shown]).then(([from, to]) => to - from);
}"""


def main() -> None:
    """Print the figures, a line each."""
    ros = with_turtlesim(proven_ros(find_distro("jazzy"), notify=unheard), notify=unheard)
    with tempfile.TemporaryDirectory() as place, browser() as started, opening(started) as visit:
        folder = Path(place)
        folder.chmod(0o755)
        workspace = folder / "ws"
        after_step(workspace, 6, (SOLUTION / PACKAGE / "my_first_node.py").read_text())
        with page_lab(owned(workspace)) as address:
            page = visit(viewport={"width": 1280, "height": 800}).page
            sizes: list[int] = []
            page.on("requestfinished", lambda done: sizes.append(done.sizes()["responseBodySize"]))
            page.goto(address)
            expect(page.locator("#status")).to_have_text("connected", timeout=SLOW)
            wait_for_prompt(page)
            print(f"page: {sum(sizes) / 1e6:.2f} MB in {len(sizes)} files")
            times = [echo(page) for _ in range(KEYS)]
            worst = max(times)
            print(f"typing echo: {statistics.median(times):.0f} ms (most {worst:.0f} ms) of {KEYS}")
            time.sleep(SETTLE)
            processes = tree(lab_of(workspace))
            before = processor_time(processes)
            time.sleep(IDLE)
            share = (processor_time(processes) - before) / IDLE
            print(f"idle, with the page open: {100 * share:.1f} % of a core")
            print(f"memory: {memory(processes) / 1e6:.0f} MB in {len(processes)} processes")
        env = ros_environment(ros.path, folder)
        with window(env) as opened, turtles(env, 5, "move"):
            page = visit().page
            page.goto(opened.address)
            expect(page.locator("#turtle-list button")).to_have_count(5, timeout=SLOW)
            print(f"five turtles: {page.evaluate(COUNT_FRAMES, 10):.0f} frames a second")


def echo(page: Page) -> float:
    """Type a character; return the time until the terminal shows it, in ms."""
    page.evaluate(ECHO)
    page.keyboard.press("x")
    return float(page.evaluate("window.echoed"))


def tree(process: int) -> list[int]:
    """Return a process and all that it has started."""
    return [process, *(each for child in children(process) for each in tree(child))]


def processor_time(processes: list[int]) -> float:
    """Return the processor time of processes, in s."""
    fields = (Path(f"/proc/{n}/stat").read_text().rpartition(")")[2].split() for n in processes)
    return sum(int(f[11]) + int(f[12]) for f in fields) / os.sysconf("SC_CLK_TCK")


def memory(processes: list[int]) -> int:
    """Return the memory of processes, in bytes; what several share is counted once (PSS)."""
    rollups = (Path(f"/proc/{n}/smaps_rollup").read_text().splitlines() for n in processes)
    lines = (line for rollup in rollups for line in rollup if line.startswith("Pss:"))
    return sum(int(line.split()[1]) * 1024 for line in lines)


if __name__ == "__main__":
    main()
