"""The window in a lab: it shows the turtle of any terminal of the workspace, whatever its lesson."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import expect

from grader.base.unheard import unheard
from grader.ros.interfaces import with_turtlesim
from grader.ros.prefix import Ros
from tests.domains import new_domain
from tests.lab.kinds import Kind
from tests.lab.screen import Lab
from tests.pages.browser import Open
from tests.window.programs import ADDRESS, SECONDS, window

pytestmark = [pytest.mark.full, pytest.mark.prefix]


@pytest.mark.parametrize(
    ("of_turtle", "of_window"), [("draw_circle", "hello_time"), ("hello_time", "own_message")]
)
def test_a_turtle_of_another_lessons_terminal_is_shown_and_driven(
    of_turtle: str, of_window: str, visit: Open, ros_jazzy: Ros, tmp_path: Path
) -> None:
    with_turtlesim(ros_jazzy, notify=unheard)  # a terminal is not waited for so long
    domain = {"ROS_DOMAIN_ID": new_domain()}
    labs = [
        Lab(Kind("bubblewrap"), tmp_path / "ros2_ws", env={**domain, "GRADER_ASSIGNMENT": lesson})
        for lesson in (of_turtle, of_window)
    ]
    with labs[0] as turtles, labs[1] as windows:
        turtles.screen.sendline("ros2 run turtlesim turtlesim_node")
        turtles.screen.expect_exact("Spawning turtle [turtle1]")
        windows.screen.sendline("lab window")
        windows.screen.expect(ADDRESS)
        page = visit().page
        page.goto(windows.screen.match.group())
        turtle = page.locator("#turtle-list button[value='/turtle1']")
        expect(turtle).to_contain_text("x 5.54 m, y 5.54 m", timeout=1000 * SECONDS)
        turtle.click()  # (from the terminal, which has the keys, to the turtle)
        page.keyboard.down("ArrowUp")
        expect(turtle).to_contain_text("2.00 m/s")
        page.keyboard.up("ArrowUp")


def test_without_turtlesim_the_page_shows_no_turtles(
    visit: Open, ros_jazzy: Ros, ros_env: dict[str, str], tmp_path: Path
) -> None:
    from tests.window.programs import ros_environment

    bare = {**ros_env, **ros_environment(ros_jazzy.path, tmp_path)}
    with window(bare) as running:
        record = visit()
        record.page.goto(running.address)
        expect(record.page.locator("#status")).to_have_text("connected")
        expect(record.page.locator("section:visible")).to_have_id("graph")
        expect(record.page.locator("nav a")).to_have_count(4)
        assert "turtle" not in record.page.locator("body").inner_text().lower()
        assert record.complaints == []
