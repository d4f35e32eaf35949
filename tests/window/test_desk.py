"""The lab's page in Chromium: guide, editor, terminals and check know of each other."""

from __future__ import annotations

import os
import re
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import expect

from grader.base.unheard import unheard
from grader.ros.interfaces import with_turtlesim
from grader.ros.prefix import Ros
from tests.lab.workspaces import PACKAGE, SOLUTION, after_step
from tests.pages.axe import axe_source, violations
from tests.pages.browser import Open, PageRecord
from tests.window.desk import (
    SLOW,
    SOON,
    PagePlayer,
    open_file,
    owned,
    page_lab,
    server_of,
    show,
    type_line,
    wait_for_prompt,
    write_text,
)
from tests.window.programs import until

pytestmark = [pytest.mark.full, pytest.mark.prefix]
NODE = f"src/{PACKAGE}/{PACKAGE}/my_first_node.py"
SETUP = f"src/{PACKAGE}/setup.py"
WIDE = {"width": 1280, "height": 800}
SIZES = (WIDE, {"width": 1024, "height": 768}, {"width": 360, "height": 740})
PANES = ("guide", "editor", "terminal", "check", "turtle", "graph", "log", "plot", "parameters")


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("page") / "ws"
    after_step(folder, 6, (SOLUTION / PACKAGE / "my_first_node.py").read_text())
    return owned(folder)


@pytest.fixture(scope="module")
def address(ros_jazzy: Ros, workspace: Path) -> Iterator[str]:
    with_turtlesim(ros_jazzy, notify=unheard)
    with page_lab(workspace) as opened:
        yield opened


@pytest.fixture
def visited(visit: Open, address: str) -> Iterator[PageRecord]:
    record = visit(viewport=WIDE)
    record.page.goto(address)
    expect(record.page.locator("#todo")).not_to_be_empty(timeout=SOON)
    yield record
    assert record.complaints == []
    assert {url.split("/")[2] for url in record.requests} == {address.split("/")[2]}


def test_a_saved_mistake_is_found_at_once_and_its_line_is_marked(
    visited: PageRecord, workspace: Path
) -> None:
    page = visited.page
    before = (workspace / SETUP).read_text()
    wrong = before.replace("from setuptools", "def oops \nfrom setuptools")
    try:
        open_file(page, SETUP)
        write_text(page, wrong)
        assert (workspace / SETUP).read_text() == wrong
        expect(page.locator("#found")).to_contain_text("setup.py cannot be read", timeout=SOON)
        page.get_by_role("button", name="Files").or_(
            page.locator("#open-file summary")
        ).first.click()
        page.locator("#file-search").fill("my_first_node.py")
        page.locator("#file-list button").first.click()
        expect(page.locator(".cm-lintRange-error")).to_have_count(0)
        page.locator("#guide").get_by_role("button", name="Show me the line").click()
        mark = page.locator(".cm-lintRange-error")
        expect(mark.first).to_have_text(re.compile("def"))
        mark.first.hover()
        expect(page.locator(".cm-tooltip")).to_contain_text("cannot be read")
        page.locator("#guide").get_by_role("button", name="Hint").click()
        expect(page.locator("#hints li")).to_have_count(1)
        write_text(page, before)
        expect(page.locator("#found")).to_be_hidden(timeout=SOON)
        expect(page.locator(".cm-lintRange-error")).to_have_count(0)
    finally:
        (workspace / SETUP).write_text(before)


def test_nothing_is_lost_when_another_program_saves_the_file(
    visited: PageRecord, workspace: Path
) -> None:
    page, file = visited.page, workspace / NODE
    before = file.read_text()
    open_file(page, NODE)
    file.write_text(f"# theirs, read at once\n{before}")
    expect(page.locator(".cm-content")).to_contain_text("theirs, read at once", timeout=SOON)
    page.locator(".cm-content").focus()
    page.keyboard.press("Control+Home")
    page.keyboard.type("# mine\n")
    file.write_text(f"# theirs again\n{before}")
    expect(page.locator("#conflict")).to_be_visible(timeout=SOON)
    page.keyboard.press("Control+s")
    expect(page.locator("#conflict")).to_be_visible()
    assert file.read_text().startswith("# theirs again")
    page.get_by_role("button", name="Save my text").click()
    expect(page.locator("#notice")).to_contain_text(".lab/backups/my_first_node.py")
    assert file.read_text().startswith("# mine\n# theirs, read at once")
    (kept,) = (workspace / ".lab/backups").iterdir()
    assert kept.read_text().startswith("# theirs again")
    page.keyboard.press("Control+Home")
    page.locator(".cm-content").focus()
    page.keyboard.type("# more\n")
    file.write_text(before)
    page.get_by_role("button", name="Take the text of the file").click(timeout=SOON)
    expect(page.locator(".cm-content")).not_to_contain_text("# more")
    texts = {path.read_text() for path in (workspace / ".lab/backups").iterdir()}
    assert any("# more\n" in text for text in texts)
    assert file.read_text() == before


def test_a_reload_finds_the_same_shell_and_what_was_not_saved(
    visited: PageRecord, workspace: Path
) -> None:
    page, before = visited.page, (workspace / NODE).read_text()
    type_line(page, "kept=in-this-shell; seq 5000")
    wait_for_prompt(page)
    open_file(page, NODE)
    page.keyboard.press("Control+Home")
    page.keyboard.type("# not saved\n")
    page.reload()
    expect(page.locator(".cm-content")).to_contain_text("# not saved", timeout=SOON)
    expect(page.locator("#save")).to_be_enabled()
    assert (workspace / NODE).read_text() == before
    type_line(page, "echo $kept-$((40+2))")
    rows = page.locator(".screen.chosen .xterm-rows")
    expect(rows).to_contain_text("in-this-shell-42", timeout=SOON)
    expect(rows).to_contain_text("5000")
    open_file(page, NODE)
    write_text(page, before)


def test_a_server_that_is_killed_comes_back_with_the_same_shells(
    visited: PageRecord, workspace: Path
) -> None:
    page = visited.page
    type_line(page, "clear; survives=yes; sleep 1000 &")
    wait_for_prompt(page)
    open_file(page, NODE)
    page.keyboard.press("Control+Home")
    page.keyboard.type("# not saved either\n")
    for _ in range(2):
        server = server_of(workspace)
        os.kill(server, signal.SIGKILL)
        until(lambda: server_of(workspace) not in (0, server), 60)  # noqa: B023 - at once
    expect(page.locator("#status")).to_have_text("connected", timeout=SLOW)
    type_line(page, "echo $survives-$((40+2)); jobs")
    rows = page.locator(".screen.chosen .xterm-rows")
    expect(rows).to_contain_text("yes-42", timeout=SOON)
    expect(rows).to_contain_text("Running")
    page.reload()
    expect(rows).to_contain_text("yes-42", timeout=SOON)
    expect(page.locator(".cm-content")).to_contain_text("# not saved either", timeout=SOON)
    write_text(page, (workspace / NODE).read_text())
    visited.complaints[:] = [c for c in visited.complaints if "WebSocket connection" not in c]


def test_a_line_of_a_traceback_opens_the_file_there(visited: PageRecord) -> None:
    page = visited.page
    type_line(page, f"clear; echo '  File \"/home/student/ros2_ws/{NODE}\", line 7, in main'")
    wait_for_prompt(page)
    link = page.locator(".screen.chosen .xterm-rows > div", has_text="line 7, in").first
    box = link.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + 60, box["y"] + box["height"] / 2)
    expect(page.locator(".screen.chosen .xterm-cursor-pointer")).to_be_visible()
    page.mouse.click(box["x"] + 60, box["y"] + box["height"] / 2)
    expect(page.locator(".cm-content")).to_have_attribute("aria-label", re.compile(NODE))
    expect(page.locator(".cm-lineNumbers .cm-activeLineGutter")).to_have_text("7")
    type_line(page, f"code ~/ros2_ws/{SETUP}")
    expect(page.locator(".cm-content")).to_have_attribute("aria-label", re.compile(SETUP))


def test_panes_are_moved_by_the_keyboard_and_remembered(visited: PageRecord) -> None:
    page = visited.page
    page.get_by_role("button", name="Panes").click()
    place = page.locator("#pane-places label")
    place.filter(has_text="Log").locator("select").select_option(label="Left")
    place.filter(has_text="Plot").locator("select").select_option(label="Hidden")
    page.get_by_role("button", name="Close", exact=True).click()
    expect(page.locator("[data-area=left] nav a[href='#log']")).to_be_visible()
    expect(page.locator("section#log")).to_be_visible()
    expect(page.locator("nav a[href='#plot']")).to_have_count(0)
    page.locator(".line").first.focus()
    wide = page.locator("[data-area=left]").bounding_box()
    page.keyboard.press("ArrowRight")
    wider = page.locator("[data-area=left]").bounding_box()
    assert wide is not None
    assert wider is not None
    assert wider["width"] > wide["width"] + 10
    page.keyboard.press("F6")
    page.wait_for_timeout(1000)  # (it is kept half a second later)
    page.reload()
    expect(page.locator("[data-area=left] nav a[href='#log']")).to_be_visible(timeout=SOON)
    expect(page.locator("nav a[href='#plot']")).to_have_count(0)
    page.get_by_role("button", name="Panes").click()
    page.get_by_role("button", name="As at the beginning").click()
    expect(page.locator("nav a[href='#plot']")).to_have_count(1)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_every_pane_is_accessible_and_fits(visit: Open, address: str, scheme: str) -> None:
    record = visit(viewport=WIDE, color_scheme=scheme, bypass_csp=True)
    page = record.page
    page.goto(address)
    expect(page.locator("#todo")).not_to_be_empty(timeout=SOON)
    open_file(page, NODE)
    for size in SIZES:
        page.set_viewport_size(size)  # type: ignore[arg-type]
        for pane in PANES if size["width"] < 400 else ("check", "guide"):
            show(page, pane)
            assert violations(page, axe_source()) == [], (size, pane)
            assert page.evaluate("document.documentElement.scrollWidth") <= size["width"]
            assert page.evaluate("document.documentElement.scrollHeight") <= size["height"]


def test_two_labs_do_not_see_each_other(
    visited: PageRecord, visit: Open, ros_jazzy: Ros, tmp_path: Path
) -> None:
    with page_lab(tmp_path / "other", ROS_DOMAIN_ID="0") as other:
        page = visit(viewport=WIDE).page
        page.goto(other)
        type_line(page, "ros2 run turtlesim turtlesim_node &")
        show(page, "graph")
        page.locator("g.node[data-id='node /turtlesim']").wait_for(timeout=SLOW)
        type_line(visited.page, "clear; ROS_DOMAIN_ID=0 ros2 node list; echo listed-$((1+1))")
        rows = visited.page.locator(".screen.chosen .xterm-rows")
        expect(rows).to_contain_text("listed-2", timeout=SOON)
        expect(rows).not_to_contain_text("/turtlesim")
        assert page.context.request.get(other.partition("?")[0]).status == 200
        assert visited.page.context.request.get(other.partition("?")[0]).status == 403


@pytest.mark.long
@pytest.mark.parametrize("lang", ["en", "ko"])
def test_two_lessons_are_played_to_full_marks_in_the_page_alone(
    visit: Open, ros_jazzy: Ros, tmp_path: Path, lang: str
) -> None:
    with_turtlesim(ros_jazzy, notify=unheard)
    workspace = tmp_path / "ws"
    with page_lab(workspace, "--lang", lang) as address:
        record = visit(viewport=WIDE)
        page = record.page
        page.goto(address)
        expect(page.locator("#todo")).not_to_be_empty(timeout=SOON)
        for lesson in ("hello_time", "draw_circle"):
            player = PagePlayer(page, lesson, workspace)
            player.play()
            show(page, "check")
            expect(page.locator("#verdict .score")).to_contain_text("100")
            show(page, "guide")
            player.follow("lab submit")
            expect(page.locator("#todo")).to_contain_text(f"submit/{lesson}.zip", timeout=SLOW)
            assert (workspace / "submit" / f"{lesson}.zip").is_file()
            if lesson == "hello_time":
                player.follow("lab next")
                expect(page.locator("#next.ready")).to_have_count(0, timeout=SLOW)
        assert record.complaints == []
