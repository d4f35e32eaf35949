"""The page in Chromium, with real nodes: what it shows, and what it makes them do."""

from __future__ import annotations

import re
import time
from collections.abc import Iterator

import pytest
from playwright.sync_api import Page, expect

from tests.pages.axe import axe_source, violations
from tests.pages.browser import Open, PageRecord
from tests.window.programs import SECONDS, OpenWindow, nodes, started, turtles, until, window

pytestmark = [pytest.mark.full, pytest.mark.prefix]
VIEWS = ("turtle", "graph", "log", "plot", "parameters")
SIZES = ({"width": 1280, "height": 800}, {"width": 360, "height": 740})
POSITION = re.compile(r"x ([\d.]+) m, y ([\d.]+) m")
COUNT_FRAMES = """async seconds => {
    const field = document.getElementById("field");
    const before = Number(field.dataset.frames);
    await new Promise(done => setTimeout(done, 1000 * seconds));
    return (Number(field.dataset.frames) - before) / seconds;
}"""

WORDS_IN_TWO_LINES = r"""element => {
    const broken = [];
    const walker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
        for (const word of walker.currentNode.data.matchAll(/\S+/g)) {
            const range = document.createRange();
            range.setStart(walker.currentNode, word.index);
            range.setEnd(walker.currentNode, word.index + word[0].length);
            if (range.getClientRects().length > 1) broken.push(word[0]);
        }
    }
    return broken;
}"""


@pytest.fixture
def visited(visit: Open, opened: OpenWindow) -> Iterator[PageRecord]:
    """The page, from which nothing may be complained about and nothing fetched elsewhere."""
    record = visit(viewport=SIZES[0])
    record.page.goto(opened.address)
    expect(record.page.locator("#status")).to_have_text("connected")
    yield record
    assert record.complaints == []
    assert {url.split("/")[2] for url in record.requests} == {f"127.0.0.1:{opened.port}"}


def look_at(page: Page, view: str) -> None:
    page.locator(f"nav a[href='#{view}']").click()
    expect(page.locator(f"section#{view}")).to_be_visible()


def position(page: Page, turtle: str) -> tuple[float, float]:
    """Return where a turtle is, in m, as the page says."""
    words = page.locator(f"#turtle-list button[value='{turtle}']").inner_text()
    match = POSITION.search(words)
    assert match is not None
    return float(match[1]), float(match[2])


def test_the_arrow_keys_drive_the_chosen_turtle(
    visited: PageRecord, ros_env: dict[str, str]
) -> None:
    page = visited.page
    assert "token" not in page.url
    expect(page.locator("#no-turtle")).to_be_visible()
    with turtles(ros_env, 2):
        button = page.locator("#turtle-list button[value='/turtle1']")
        expect(button).to_have_attribute("aria-pressed", "true")
        expect(page.locator("#no-turtle")).to_be_hidden()
        x, y = position(page, "/turtle1")
        other = position(page, "/turtle2")
        page.keyboard.down("ArrowUp")
        expect(button).to_contain_text("2.00 m/s, 0.00 rad/s")
        page.keyboard.up("ArrowUp")
        expect(button).to_contain_text("0.00 m/s, 0.00 rad/s")  # 1 s later, as in turtlesim
        moved = position(page, "/turtle1")
        assert moved[0] > x + 1.5
        assert moved[1] == y
        assert position(page, "/turtle2") == other
        page.locator("#turtle-list button[value='/turtle2']").click()
        page.keyboard.press("ArrowLeft")
        second = page.locator("#turtle-list button[value='/turtle2']")
        expect(second).to_contain_text("0.00 m/s, 2.00 rad/s")
        page.keyboard.press("Tab")  # (on a button, the space bar presses it)
        page.locator("#field").focus()
        page.keyboard.press("Space")
        expect(second).to_contain_text("0.00 m/s, 0.00 rad/s", timeout=900)
        page.get_by_role("button", name="Forward").press("Enter")
        expect(second).to_contain_text("2.00 m/s, 0.00 rad/s")
    expect(page.locator("#no-turtle")).to_be_visible()


@pytest.mark.long  # of wall time, which other tests take away
def test_five_turtles_move_at_thirty_frames_a_second(
    visited: PageRecord, ros_env: dict[str, str]
) -> None:
    with turtles(ros_env, 5, "move"):
        expect(visited.page.locator("#turtle-list button")).to_have_count(5)
        until(lambda: visited.page.evaluate(COUNT_FRAMES, 2) >= 30)


def test_turtles_that_stand_are_not_drawn_again(
    visited: PageRecord, ros_env: dict[str, str]
) -> None:
    page = visited.page
    with turtles(ros_env, 5):
        expect(page.locator("#turtle-list button").first).to_contain_text("0.00 m/s")
        until(lambda: page.evaluate(COUNT_FRAMES, 0.5) == 0)
        assert page.evaluate(COUNT_FRAMES, 1) == 0


def test_the_graph_follows_within_a_second(visited: PageRecord, ros_env: dict[str, str]) -> None:
    page = visited.page
    look_at(page, "graph")
    # (the nodes of the test before leave the graph after their lease, 20 s, if their goodbye is lost)
    expect(page.locator("#drawing")).to_contain_text("no node yet", timeout=1000 * SECONDS)

    with nodes(ros_env, "talker", "listener", "sensor", "reader"):
        expect(page.locator("g.node")).to_have_count(4)
        expect(page.locator("g.topic")).to_have_count(3)
        expect(page.locator("path.edge.misfit")).to_have_count(1)
        expect(page.locator("#problems li")).to_have_text(
            "/reader gets no messages from /sensor on /scan: reliability: it asks for reliable, but "
            "best effort is offered"
        )
        seconds = [seen_after(page, ros_env) for _ in range(3)]
        assert min(seconds) < 1.0, "(other tests may keep the cores busy for a while)"
        with nodes(ros_env, "late"):
            page.locator("path.edge.misfit").nth(1).wait_for()
            page.locator("g.node[data-id='node /late']").wait_for()
            assert labels(page, "node") == {"/talker", "/listener", "/sensor", "/reader", "/late"}
            assert labels(page, "topic") == {"/words", "/wave", "/scan"}
            assert labels(page, "service") == {"/reset_reader"}
            assert edges(page) == {
                ("node /talker", "topic /words", False),
                ("node /talker", "topic /wave", False),
                ("topic /words", "node /listener", False),
                ("topic /words", "node /late", True),
                ("node /sensor", "topic /scan", False),
                ("topic /scan", "node /reader", True),
                ("service /reset_reader", "node /reader", False),
                ("node /late", "service /reset_reader", False),
            }
            page.locator("g.topic[data-id='topic /scan']").focus()
            page.keyboard.press("Enter")
            expect(page.locator("#details")).to_contain_text("/sensor (best effort, volatile)")
            expect(page.locator("#details")).to_contain_text("/reader (reliable, volatile)")


def seen_after(page: Page, ros_env: dict[str, str]) -> float:
    """Return the seconds until a node is drawn that has started, or until it is gone if longer."""
    late = page.locator("g.node[data-id='node /late']")
    with nodes(ros_env, "late"):
        began = time.monotonic()
        late.wait_for()
        page.locator("path.edge.misfit").nth(1).wait_for()
        drawn = time.monotonic() - began
    began = time.monotonic()
    late.wait_for(state="detached")
    return max(drawn, time.monotonic() - began)


def labels(page: Page, kind: str) -> set[str]:
    """Return the names in the boxes of a kind."""
    found = page.locator(f"g.{kind}").evaluate_all("boxes => boxes.map(box => box.dataset.id)")
    return {name.partition(" ")[2] for name in found}


def edges(page: Page) -> set[tuple[str, str, bool]]:
    """Return the lines of the drawing: from, to, and whether it is dashed."""
    found = page.locator("path.edge").evaluate_all(
        "paths => paths.map(path => [path.dataset.from, path.dataset.to,"
        " getComputedStyle(path).strokeDasharray !== 'none'])"
    )
    return {(start, end, dashed) for start, end, dashed in found}


def test_the_log_is_filtered_by_level_node_and_text(
    visited: PageRecord, ros_env: dict[str, str]
) -> None:
    page = visited.page
    look_at(page, "log")
    rows = page.locator("#log-rows > div")
    with nodes(ros_env, "talker", "listener"):
        expect(rows.filter(has_text="an error of the listener")).not_to_have_count(0)
        expect(rows.filter(has_text="still here")).not_to_have_count(0)
        page.select_option("#log-level", label="WARN")
        expect(rows.filter(has_text="still here")).to_have_count(0)
        expect(rows.filter(has_text="a warning of the talker")).not_to_have_count(0)
        page.select_option("#log-node", "listener")
        expect(rows.filter(has_text="talker")).to_have_count(0)
        expect(rows.filter(has_text="an error of the listener")).not_to_have_count(0)
        page.fill("#log-text", "nothing like this")
        expect(rows).to_have_count(0)
        page.fill("#log-text", "")
        page.select_option("#log-node", "")
        page.select_option("#log-level", label="DEBUG")
        page.click("#log-clear")
        expect(rows.filter(has_text="an error of the listener")).to_have_count(0)
        expect(rows.filter(has_text="still here")).not_to_have_count(0)


def test_the_log_begins_at_info_with_the_newest_line_in_sight(
    visit: Open, opened: OpenWindow, ros_env: dict[str, str]
) -> None:
    with nodes(ros_env, "chatter"):
        for size in SIZES:
            page = visit(viewport=size).page
            page.goto(opened.address)
            look_at(page, "log")
            rows = page.locator("#log-rows > div")
            expect(page.locator("#log-level option:checked")).to_have_text("INFO")
            expect(rows).to_have_count(300)
            last = int(rows.last.inner_text().split()[-1])
            for count in (last + 1, last + 100):  # while lines come, too
                until(lambda: newest_in_sight(page) >= count)  # noqa: B023 - at once
            expect(rows.filter(has_text="DEBUG")).to_have_count(0)
            expect(rows).to_have_count(300)
            assert page.evaluate("document.documentElement.scrollHeight") <= size["height"]


def newest_in_sight(page: Page) -> int:
    """Return the number in the newest line of the log; -1 if it is not in sight."""
    found = page.locator("#log-rows").evaluate(
        """rows => {
            const line = rows.lastElementChild.getBoundingClientRect();
            const room = rows.getBoundingClientRect();
            const seen = line.top >= room.top && line.bottom <= room.bottom && room.bottom <= innerHeight;
            return seen ? Number(/\\d+$/.exec(rows.lastElementChild.textContent)[0]) : -1;
        }"""
    )
    return int(found)


def test_a_plot_begins_with_the_turtle_that_moves(
    visited: PageRecord, ros_env: dict[str, str]
) -> None:
    page = visited.page
    look_at(page, "plot")
    expect(page.locator("#plot-hint")).to_contain_text("Nothing moves yet")
    series = page.locator("#series li")
    with turtles(ros_env, 1), nodes(ros_env, "sensor"):
        page.locator("#plot-topic option[value='/turtle1/pose']").wait_for(state="attached")
        look_at(page, "turtle")
        expect(page.locator("#turtle-list button")).to_have_count(1)
        look_at(page, "plot")
        expect(series).to_have_count(0)  # it stands, and a sensor says always the same
    with turtles(ros_env, 1, "move"), nodes(ros_env, "sensor"):
        expect(series).to_have_count(1, timeout=1000 * SECONDS)
        expect(series).to_contain_text("/turtle1/pose x")
        expect(page.locator("#chart")).to_have_attribute("data-points", re.compile("[1-9][0-9]"))
        expect(page.locator("#plot-topic")).to_have_value("/turtle1/pose")
        page.get_by_role("button", name="Remove /turtle1/pose x").click()
        expect(page.locator("#plot-hint")).to_contain_text("Choose a topic")


def test_without_a_topic_that_moves_a_plot_begins_with_the_counter_in_the_log(
    visited: PageRecord, ros_env: dict[str, str]
) -> None:
    page = visited.page
    look_at(page, "plot")
    with nodes(ros_env, "chatter", "sensor"):
        series = page.locator("#series li")
        expect(series).to_contain_text("number in the lines of chatter", timeout=1000 * SECONDS)
        value = series.locator("output")
        before = int(value.inner_text())
        until(lambda: int(value.inner_text()) > before)
        look_at(page, "graph")
        look_at(page, "plot")
        expect(series).to_have_count(1)


def test_the_graph_of_a_turtle_fits_a_phone(visit: Open, ros_env: dict[str, str]) -> None:
    names = ("talker", "listener", "sensor", "reader")
    node = ["ros2", "run", "turtlesim", "turtlesim_node"]
    with window(ros_env) as opened, started(node, ros_env), nodes(ros_env, *names):
        for size in (SIZES[1], {"width": 1024, "height": 768}, SIZES[0]):
            page = visit(viewport=size).page
            page.goto(opened.address)
            look_at(page, "graph")
            page.locator("g.action[data-id='action /turtle1/rotate_absolute']").wait_for()
            expect(page.locator("g.topic")).to_have_count(6)
            found = page.evaluate(FITS)
            assert found["beside"] == [], size
            assert found["over"] == [], size
            assert found["smallest"] >= 9, size  # px
            assert found["scrolls"] is False, size
            assert page.evaluate("document.documentElement.scrollWidth") <= size["width"]
            page.locator("g.topic[data-id='topic /scan']").click()
            expect(page.locator("#details")).to_contain_text("/sensor (best effort, volatile)")


FITS = """() => {
    const drawing = document.getElementById("drawing");
    const room = drawing.getBoundingClientRect();
    const boxes = [...drawing.querySelectorAll("g.box")].map(box => ({
        id: box.dataset.id, place: box.querySelector(".shape").getBoundingClientRect(),
        texts: [...box.querySelectorAll("text:not(.kind)")].map(text => text.getBoundingClientRect())}));
    const inside = (one, other) => one.left >= other.left && one.right <= other.right;
    const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
    return {
        beside: boxes.filter(({place, texts}) => !inside(place, room)
            || texts.some(text => !inside(text, place))).map(box => box.id),
        over: boxes.filter((a, i) => boxes.some((b, j) => i < j && meet(a.place, b.place))).map(box => box.id),
        smallest: Math.min(...[...drawing.querySelectorAll("g.box text:not(.kind)")].map(text =>
            parseFloat(getComputedStyle(text).fontSize) * text.getCTM().a)),
        scrolls: drawing.scrollWidth > drawing.clientWidth};
}"""


def test_a_plot_shows_the_values_of_two_topics(
    visited: PageRecord, ros_env: dict[str, str]
) -> None:
    page = visited.page
    look_at(page, "plot")
    with nodes(ros_env, "talker", "sensor"):
        for topic in ("/wave", "/scan"):
            page.locator(f"#plot-topic option[value='{topic}']").wait_for(state="attached")
            page.select_option("#plot-topic", topic)
            page.locator("#plot-field option[value='data']").wait_for(state="attached")
            page.get_by_role("button", name="Add").click()
        series = page.locator("#series li")
        expect(series).to_have_count(2)
        expect(series.nth(1).locator("output")).to_have_text("7")
        expect(page.locator("#chart")).to_have_attribute("data-points", re.compile("[1-9][0-9]{2}"))
        assert abs(float(series.nth(0).locator("output").inner_text())) <= 1
        page.wait_for_function(
            """() => { // each series' line has its color: 50 pixels of it at least
                const {width, height} = document.querySelector("#chart canvas");
                const pen = new OffscreenCanvas(width, height).getContext("2d", {willReadFrequently: true});
                pen.drawImage(document.querySelector("#chart canvas"), 0, 0);
                const pixels = pen.getImageData(0, 0, width, height).data;
                const colors = [[0x24, 0x50, 0xc8], [0xc2, 0x41, 0x0c]];
                return colors.every(([r, g, b]) => {
                    let count = 0;
                    for (let i = 0; i < pixels.length; i += 4)
                        if (pixels[i] === r && pixels[i + 1] === g && pixels[i + 2] === b) count++;
                    return count > 50;
                });
            }"""
        )
        page.get_by_role("button", name="Remove /scan data").click()
        expect(series).to_have_count(1)
        look_at(page, "graph")
        page.locator("g.topic[data-id='topic /words']").click()
        page.get_by_role("button", name="Plot a field of it").click()
        expect(page.locator("#plot-topic")).to_have_value("/words")
        expect(page.locator("#plot-field")).to_have_text("no numeric field")


def test_a_parameter_is_set(visited: PageRecord, ros_env: dict[str, str]) -> None:
    page = visited.page
    look_at(page, "parameters")
    expect(page.locator("#no-parameters")).to_be_visible()
    with nodes(ros_env, "listener"):
        rate = page.get_by_label("rate", exact=True)
        expect(rate).to_have_value("2.5")
        rate.fill("fast")
        page.get_by_role("button", name="Set rate").click()
        expect(page.get_by_role("alert").filter(has_text="rate")).to_have_text(
            "rate is not set: this is not a value of type double"
        )
        rate.fill("4")
        rate.press("Enter")
        expect(page.locator("#parameter-said")).to_have_text("rate is set.")
        page.get_by_label("loud", exact=True).check()
        page.get_by_role("button", name="Set loud").click()
        expect(page.locator("#parameter-said")).to_have_text("loud is set.")
        page.reload()
        expect(page.get_by_label("rate", exact=True)).to_have_value("4.0")
        expect(page.get_by_label("loud", exact=True)).to_be_checked()


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", SIZES, ids=["wide", "narrow"])
def test_every_view_is_accessible(
    visit: Open, opened: OpenWindow, ros_env: dict[str, str], scheme: str, size: dict[str, int]
) -> None:
    names = ("talker", "listener", "sensor", "reader")
    with turtles(ros_env, 2), nodes(ros_env, *names), nodes(ros_env, "late"):
        record = visit(viewport=size, color_scheme=scheme, bypass_csp=True)
        page = record.page
        page.goto(opened.address)
        for view in VIEWS:
            look_at(page, view)
            if view == "turtle":
                expect(page.locator("#turtle-list button")).to_have_count(2)
            if view == "graph":
                expect(page.locator("path.edge.misfit")).to_have_count(2)
                page.locator("g.topic[data-id='topic /words']").click()
            if view == "log":
                expect(page.locator("#log-rows")).to_contain_text("an error of the listener")
            if view == "plot":
                page.get_by_role("button", name="Add").click()
            if view == "parameters":
                page.select_option("#parameter-node", "/listener")
                expect(page.get_by_label("rate", exact=True)).to_be_visible()
            assert violations(page, axe_source()) == [], view
            wide = page.evaluate("document.documentElement.scrollWidth")
            assert wide <= size["width"], f"{view} is wider than the screen"
            assert record.complaints == []


def test_the_page_is_korean_where_the_reader_is(visit: Open, ros_env: dict[str, str]) -> None:
    from lab.window.texts import TEXTS, page_texts

    texts = page_texts("ko")
    with window(ros_env, "--lang", "ko") as running:
        page = visit().page
        page.goto(running.address)
        expect(page.locator("html")).to_have_attribute("lang", "ko")
        for view in VIEWS:
            expect(page.locator(f"nav a[href='#{view}']")).to_have_text(texts[view])
            assert texts[view] != TEXTS[view]
        page.set_viewport_size({"width": 360, "height": 740})
        look_at(page, "turtle")
        words = page.locator("#turtle p").first
        assert words.evaluate(WORDS_IN_TWO_LINES) == []


def test_the_page_says_when_the_window_has_ended(visit: Open, ros_env: dict[str, str]) -> None:
    page = visit().page
    with window(ros_env) as running:
        page.goto(running.address)
        expect(page.locator("#status")).to_have_text("connected")
    expect(page.locator("#status")).to_have_text("connection lost")
    expect(page.locator("#trouble")).to_contain_text("start it again", timeout=20_000)
