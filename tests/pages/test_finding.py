"""Search and sort on the overview."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.pages.browser import Open

pytestmark = pytest.mark.full  # `make test` has no Chromium


@pytest.fixture
def page(visit: Open, site: Path) -> Page:
    return visit().open(site / "index.html")


def column(page: Page, number: int) -> list[str]:
    """Return the texts of a column of the students' table, of visible rows only."""
    cells = page.locator(f"#all tbody tr:not([hidden]) > :nth-child({number})")
    return [text.strip() for text in cells.all_inner_texts()]


def points(page: Page) -> list[float]:
    return [float(text.split()[0]) for text in column(page, 5) if text != "–"]


def search(page: Page, text: str) -> None:
    page.get_by_label("Find students").fill(text)


def test_search_shows_those_who_match_every_word_and_says_how_many(page: Page) -> None:
    search(page, "LEE ann")
    assert column(page, 1) == ["Ann Lee"]
    expect(page.get_by_role("status")).to_have_text("1 of 40 students shown")
    search(page, "")
    assert len(column(page, 1)) == 40
    expect(page.get_by_role("status")).to_have_text("40 students")


@pytest.mark.parametrize(
    ("text", "name"),
    [("jose lee", "José Lee"), ("ILIC", ""), ("dorte lee", "Dörte Lee"), ("70021", "Dörte Lee"),
     ("student4@example.org", "Émile Lee"), ("user8", "Ines Lee")],
)  # fmt: skip
def test_search_knows_names_without_their_accents_numbers_and_addresses(
    page: Page, text: str, name: str
) -> None:
    search(page, text)
    assert column(page, 1) == ([name] if name else [])


def test_search_finds_states_failed_checks_and_mistakes(page: Page) -> None:
    search(page, "by hand")
    assert set(column(page, 4)) == {"to be looked at by hand"}
    search(page, "run.output")
    assert set(column(page, 6)) == {"run.output"}
    search(page, "setup.misspelt_module")
    assert set(column(page, 6)) == {"entry_point.mapping"}
    search(page, "misspelt")
    assert set(column(page, 6)) == {"entry_point.mapping"}
    search(page, "isspelt")
    assert column(page, 6) == []


def test_a_search_without_matches_says_so(page: Page) -> None:
    search(page, "nobody at all")
    expect(page.get_by_role("status")).to_have_text("0 of 40 students shown")


def test_one_click_shows_who_failed_a_check(page: Page) -> None:
    page.get_by_role("button", name="who failed run.output").press("Enter")
    expect(page.get_by_label("Find students")).to_be_focused()
    assert set(column(page, 6)) == {"run.output"}


def test_every_column_has_a_button_that_sorts_it(page: Page) -> None:
    heads = page.locator("#all thead th")
    assert heads.count() == 9
    for head in heads.all():
        button = head.get_by_role("button")
        button.press("Enter")
        expect(head).to_have_attribute("aria-sort", "ascending")
        button.press(" ")
        expect(head).to_have_attribute("aria-sort", "descending")
        assert page.locator("#all thead th[aria-sort]").count() == 1


def test_points_are_sorted_as_numbers_with_missing_ones_last(page: Page) -> None:
    button = page.locator("#all thead").get_by_role("button", name="Points")
    button.click()
    assert points(page) == sorted(points(page))
    assert len(set(points(page))) > 3
    assert set(column(page, 5)[-6:]) == {"–"}
    button.click()
    assert points(page) == sorted(points(page), reverse=True)
    assert set(column(page, 5)[-6:]) == {"–"}


def test_names_are_sorted_with_their_accents_where_readers_expect_them(page: Page) -> None:
    page.locator("#all thead").get_by_role("button", name="Student").click()
    firsts = [name.split()[0] for name in column(page, 1)]
    assert list(dict.fromkeys(firsts)) == [
        "Ann", "Bela", "Chidi", "Dörte", "Émile", "Farah", "Goran", "Hana", "Ines", "José",
    ]  # fmt: skip


def test_lateness_is_sorted_by_duration(page: Page) -> None:
    page.locator("#all thead").get_by_role("button", name="Late").click()
    assert column(page, 7)[:3] == ["2 h 10 min", "2 h 10 min", ""]


def test_a_sorted_table_keeps_the_search(page: Page) -> None:
    search(page, "lee")
    before = column(page, 1)
    page.locator("#all thead").get_by_role("button", name="Points").click()
    assert sorted(column(page, 1)) == sorted(before)


def test_without_scripts_everything_is_readable_and_no_control_is_shown(
    visit: Open, site: Path
) -> None:
    page = visit(java_script_enabled=False).open(site / "index.html")
    expect(page.locator("#all tbody tr")).to_have_count(40)
    expect(page.get_by_label("Find students")).not_to_be_visible()
    expect(page.get_by_role("button")).to_have_count(0)
    page.get_by_role("link", name="Bela Lee").first.click()
    expect(page.get_by_role("heading", level=1)).to_have_text("Bela Lee")
    page.get_by_role("link", name="Next").click()
    expect(page.get_by_role("heading", level=1)).to_have_text("Chidi Lee")
    page.get_by_role("link", name="The class").click()
    expect(page.get_by_role("heading", level=1)).to_have_text("Robotics 1, winter term")


def test_a_click_on_the_histogram_shows_the_students_with_these_points(page: Page) -> None:
    everybody = points(page)
    button = page.get_by_role("button", name="90 to 100")
    wanted = [value for value in everybody if value >= 90]
    assert 0 < len(wanted) < len(everybody)
    button.click()
    assert sorted(points(page)) == sorted(wanted)
    expect(button).to_have_attribute("aria-pressed", "true")
    page.locator("rect.bar[data-bin='9']").click()
    assert points(page) == everybody


def test_a_section_is_chosen(page: Page) -> None:
    names = set(column(page, 3)) - {""}
    assert len(names) > 1
    for name in names:
        page.get_by_label("Section", exact=True).select_option(name)
        assert set(column(page, 3)) == {name}


def test_the_table_is_on_the_first_screen(page: Page) -> None:
    page.set_viewport_size({"width": 1280, "height": 900})
    box = page.locator("#all").bounding_box()
    assert box is not None
    assert box["y"] < 900
