"""Accessibility of the pages: screen readers, keyboard, dark mode, phones, paper."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import expect

from grader.base.nearest import compared
from grader.batch.model import Student
from grader.batch.points import single
from grader.publish.feedback import html_page
from grader.publish.pages import write_site
from grader.report.model import Evidence, Report
from tests.pages import classes
from tests.pages.axe import violations
from tests.pages.browser import Open
from tests.report.samples import check, failing_report, report

pytestmark = pytest.mark.full  # `make test` has no Chromium

# one page of each kind in a class of `classes.mixed`
KINDS = {
    "overview": "index.html",
    "full marks": "students/1000.html",
    "a check failed": "students/1001.html",
    "not started": "students/1002.html",
    "late": "students/1003.html",
    "too fast": "students/1004.html",
    "wall clock, a hidden check": "students/1005.html",
    "missing": "students/1007.html",
    "corrected, not built": "students/1009.html",
    "open points": "students/1011.html",
    "ungradable": "students/1013.html",
    "pending": "students/1017.html",
}
WIDTH = "document.documentElement.scrollWidth"


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_no_violation_on_any_kind_of_page(
    scheme: str, visit: Open, site: Path, axe_source: str
) -> None:
    witness = visit(color_scheme=scheme)
    for kind, path in KINDS.items():
        page = witness.open(site / path)
        for fold in page.locator("summary").all():
            fold.click()
        assert violations(page, axe_source) == [], kind


def test_axe_finds_no_violation_after_search_and_sort_on_a_narrow_screen(
    visit: Open, site: Path, axe_source: str
) -> None:
    page = visit(viewport={"width": 320, "height": 640}).open(site / "index.html")
    page.get_by_label("Find students").fill("lee")
    page.locator("#all").get_by_role("button", name="Points").click()
    assert violations(page, axe_source) == []


def test_axe_finds_a_planted_violation(visit: Open, site: Path, axe_source: str) -> None:
    """This shows that axe works in these tests."""
    page = visit().open(site / "students/1001.html")
    page.evaluate(
        "document.querySelector('caption').closest('.scroll').removeAttribute('tabindex')"
    )
    page.evaluate("document.querySelector('h1').outerHTML = '<h4><img></h4>'")
    assert {"image-alt", "page-has-heading-one"} <= {
        found.partition(":")[0] for found in violations(page, axe_source)
    }


def test_marks_stay_below_what_they_mark_on_a_phone(
    visit: Open, tmp_path: Path, axe_source: str
) -> None:
    """The lines are not wrapped, and the page is not wider than the screen: the block scrolls."""
    names = [f"the_executable_of_my_package = my_robot_controller.my_{n}_node:main"
             for n in ("frist", "first")]  # fmt: skip
    failed = check("entry_point.mapping", "failed", actual=compared(*names))
    page_file = tmp_path / "feedback.html"
    page_file.write_bytes(html_page(single(report(failed)), "Hello", show_hidden=False))
    page = visit(viewport={"width": 320, "height": 640}).open(page_file)
    block = page.locator("pre.marks")
    expect(block).to_have_count(1)
    style = "e => [e.clientHeight, parseFloat(getComputedStyle(e).lineHeight)]"
    height, line = block.evaluate(style)
    assert round(height / line) == 3
    assert block.evaluate("e => e.scrollWidth > e.clientWidth")
    assert page.evaluate(WIDTH) == 320
    assert violations(page, axe_source) == []


@pytest.mark.parametrize("width", [320, 640, 1280])
def test_a_page_is_never_wider_than_the_screen(width: int, visit: Open, site: Path) -> None:
    """320 is a phone, or 1280 at a zoom of 400 % (WCAG 1.4.10); 640 is 1280 at 200 %."""
    witness = visit(viewport={"width": width, "height": 800}, device_scale_factor=1280 / width)
    for kind, path in KINDS.items():
        page = witness.open(site / path)
        for fold in page.locator("summary").all():
            fold.click()
        assert page.evaluate(WIDTH) == width, kind


def test_the_dark_and_light_schemes_are_followed(visit: Open, site: Path) -> None:
    def brightness(scheme: str) -> int:
        page = visit(color_scheme=scheme).open(site / "index.html")
        colour = page.evaluate("getComputedStyle(document.body).backgroundColor")
        return sum(map(int, colour.removeprefix("rgb(").rstrip(")").split(",")))

    assert brightness("light") > 3 * 230
    assert brightness("dark") < 3 * 40


def test_the_first_tab_skips_to_the_content_and_focus_is_visible(visit: Open, site: Path) -> None:
    page = visit().open(site / "students/1001.html")
    page.keyboard.press("Tab")
    skip = page.get_by_role("link", name="Skip to the content")
    expect(skip).to_be_focused()
    expect(skip).to_be_in_viewport()
    assert skip.evaluate("e => getComputedStyle(e).outlineStyle") == "solid"
    page.keyboard.press("Enter")
    expect(page.locator("main")).to_be_focused()


PAINTED = "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"


def test_a_long_transcript_can_be_scrolled_by_keyboard(visit: Open, tmp_path: Path) -> None:
    text = "\n".join(f"line {number} " + "x" * 300 for number in range(500))
    report = failing_report(evidence=Evidence(transcript=text))
    write_site(classes.result([classes.entry(1, report)]), tmp_path)
    page = visit().open(tmp_path / "students/1001.html")
    log = page.get_by_role("region", name="What ros2 run printed")
    log.focus()
    expect(log).to_be_focused()
    page.evaluate(PAINTED)  # (a key before the first frame scrolls nothing)
    page.keyboard.press("End")
    page.wait_for_function("e => e.scrollTop > 100", arg=log.element_handle())
    assert page.evaluate(f"{WIDTH} === innerWidth")


def test_no_state_is_shown_by_colour_alone(visit: Open, site: Path) -> None:
    page = visit().open(site / "students/1011.html")
    for state in page.locator(".state").all():
        words = state.inner_text()
        assert words.split()[-1] in ("passed", "failed", "skipped", "inconclusive"), words


def test_a_page_makes_no_request_and_works_offline(visit: Open, site: Path) -> None:
    witness = visit(offline=True)
    for path in KINDS.values():
        witness.open(site / path)
        assert witness.requests == [(site / path).as_uri()]
        assert witness.complaints == []


def test_folded_and_scrolled_content_is_printed_and_controls_are_not(
    visit: Open, site: Path
) -> None:
    page = visit().open(site / "students/1001.html")
    table = page.get_by_role("table", name="The lines and when they came")
    expect(table).not_to_be_visible()
    page.emulate_media(media="print")
    expect(table).to_be_visible()
    expect(page.get_by_role("navigation")).not_to_be_visible()
    for log in page.locator("pre").all():
        assert log.evaluate("e => e.scrollHeight <= e.clientHeight && e.scrollWidth <= innerWidth")
    links = "[...document.links].every(a => getComputedStyle(a).textDecorationLine === 'none')"
    assert page.evaluate(links)


def test_a_pdf_has_a_white_background_in_the_dark_scheme(visit: Open, site: Path) -> None:
    page = visit(color_scheme="dark").open(site / "index.html")
    page.emulate_media(media="print")
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    assert page.pdf().startswith(b"%PDF-")


def test_names_in_every_script_are_shown_unchanged(
    reports: tuple[Report, ...], visit: Open, tmp_path: Path
) -> None:
    names = ["محمد علي", "李小龍", "Nguyễn Thị Ánh", "O'Brien & Søn <3"]
    entries = [
        classes.entry(number, reports[0], student=Student(str(number), name))
        for number, name in enumerate(names)
    ]
    index = write_site(classes.result(entries), tmp_path)
    rows = visit().open(index).locator("#all tbody tr")
    assert [row.locator("th").inner_text() for row in rows.all()] == names
