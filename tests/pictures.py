"""Makes the README's pictures of the real thing: `python -m tests.pictures` (`make pictures`).

The lab's page with the second lesson's solution, and the pages of a class that is marked for it.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path
from shutil import copytree

from playwright.sync_api import Browser, Page, expect

from grader.base.unheard import unheard
from grader.ros.distro import find_distro
from grader.ros.interfaces import with_turtlesim
from grader.sandbox.proof import proven_ros
from tests.batch.pool_tasks import package
from tests.lab.workspaces import open_to_all
from tests.pages.browser import browser
from tests.processes import ROOT
from tests.window.desk import SLOW, open_file, owned, page_lab, show, type_line, wait_for_prompt

PICTURES = ROOT / "docs" / "pictures"
LESSON, PACKAGE = "draw_circle", "my_robot_controller"
SIZE = {"width": 1280, "height": 800}
CLASS = {
    "Ann Lee": "solution",
    "Bela Nagy": "entry_missing",
    "Chidi Okafor": "text_other_capital",
    "Doerte Weiss": "tutorial",
    "Emile Zola": "spin_missing",
    "Fatima Haddad": "period_half",
    "Goran Ilic": "two_nodes",
    "Hana Sato": "marker_missing",
}
"""The students of the class, with the packages of the tests that they hand in."""
SHOWN = "Chidi Okafor"


def main() -> int:
    """Make all pictures."""
    PICTURES.mkdir(exist_ok=True)
    with browser() as chromium:
        _lab(chromium)
        _class(chromium)
    return 0


def _opened(chromium: Browser, address: str) -> Page:
    page = chromium.new_page(viewport=SIZE)  # type: ignore[arg-type]
    page.goto(address)
    return page


def _saved(page: Page, name: str) -> None:
    page.screenshot(path=PICTURES / f"{name}.png")
    print(f"{PICTURES / name}.png")


def _lab(chromium: Browser) -> None:
    """Draw a circle in the lab's page."""
    with_turtlesim(proven_ros(find_distro("jazzy")), notify=unheard)
    with open_to_all() as folder:
        workspace = folder / "ros2_ws"
        copytree(ROOT / "grader" / "keys" / LESSON / "solution", workspace / "src")
        with page_lab(owned(workspace), "--lesson", LESSON) as address:
            page = _opened(chromium, address)
            open_file(page, f"src/{PACKAGE}/{PACKAGE}/{LESSON}.py")
            type_line(page, "ros2 run turtlesim turtlesim_node &")
            type_line(page, "colcon build --symlink-install && source install/setup.bash")
            wait_for_prompt(page)
            type_line(page, f"ros2 run {PACKAGE} {LESSON}")
            show(page, "turtle")
            turtle = page.locator("#turtle-list button[value='/turtle1']")
            expect(turtle).to_contain_text("2.00 m/s", timeout=SLOW)
            expect(turtle).to_contain_text("x 5.5", timeout=SLOW)
            _saved(page, "lab")
            page.close()


def _class(chromium: Browser) -> None:
    """Mark a class; show its page, and that of a student who lost points."""
    with tempfile.TemporaryDirectory() as kept:
        handed_in, out = Path(kept) / "handed in", Path(kept) / "out"
        for student, name in CLASS.items():
            package(name, handed_in, called=student)
        line = [sys.executable, "-m", "grader", "grade-all", "--yes", "--out", out, handed_in]
        subprocess.run(list(map(str, line)), cwd=ROOT, check=False)
        page = _opened(chromium, (out / "index.html").as_uri())
        _saved(page, "class")
        (shown,) = (out / "students").glob(f"{SHOWN.replace(' ', '_')}-*.html")
        page.goto(shown.as_uri())
        page.locator(".state", has_text="failed").first.scroll_into_view_if_needed()
        _saved(page, "student")


if __name__ == "__main__":
    sys.exit(main())
