"""A student's feedback: complete, nothing about others, and no text becomes markup."""

from __future__ import annotations

import dataclasses
from html.parser import HTMLParser
from pathlib import Path

import pytest
from hypothesis import given, settings
from markdown_it import MarkdownIt

from grader.batch.model import ClassResult
from grader.batch.points import single
from grader.publish.feedback import html_page
from grader.publish.markdown import markdown
from grader.report.model import Report
from tests.gradebook.hostile_texts import hostile_entry, texts
from tests.pages.browser import Open
from tests.report import samples

TITLE = "Hello time"


def visible_text(text: str) -> str:
    """Return the visible text of the Markdown, line by line."""
    tokens = MarkdownIt("commonmark").parse(text)
    lines = [token for token in tokens if token.type in ("inline", "fence")]
    return "\n".join(
        "".join(c.content for c in token.children or []) if token.children else token.content
        for token in lines
    )


def both(entry_of: ClassResult, key: str) -> list[str]:
    entry = entry_of.entry(key)
    page = html_page(entry, TITLE, show_hidden=False).decode()
    return [visible_text(markdown(entry, TITLE, show_hidden=False)), page]


def test_result_corrections_lateness_and_attempts_are_listed(mixed: ClassResult) -> None:
    for text in both(mixed, "1003"):
        assert "of 100 points" in text
        assert "Late by 2 h 10 min: 5 points taken." in text
        assert "Attempt 2 of 3 is the one that counts." in text
    for text in both(mixed, "1009"):
        assert "shown to work in the laboratory" in text
        assert "M. Curie" in text


def test_a_failed_check_is_explained(broken: Report) -> None:
    entry = single(broken)
    check = broken.check("run.output")
    text = visible_text(markdown(entry, TITLE, show_hidden=False))
    for shown_text in (check.title, check.expected, check.actual.split("\n")[0], check.fix):
        assert shown_text in text
    assert "hello time: 9" in text


def test_hidden_checks_are_counted_and_not_named() -> None:
    hidden = samples.check("build.colcon", "failed", visibility="hidden", actual="secret fault")
    entry = single(samples.report(hidden))
    for text in (
        markdown(entry, TITLE, show_hidden=False),
        html_page(entry, TITLE, show_hidden=False).decode(),
    ):
        assert "1 hidden check" in text
        assert "build.colcon" not in text
        assert "secret" not in text
    assert "secret" in markdown(entry, TITLE, show_hidden=True)


def test_nothing_about_others_and_no_notes_for_the_instructor_are_shown(mixed: ClassResult) -> None:
    entry = dataclasses.replace(mixed.entries[0], same_as=("1006",), notes=("smells of copying",))
    result = dataclasses.replace(mixed, entries=(entry, *mixed.entries[1:]))
    assert entry.report is not None
    for text in both(result, entry.student.key):
        assert "1006" not in text
        assert "smells" not in text
        assert entry.report.submission.path not in text


@pytest.mark.parametrize(("key", "output"), [("1013", "ends in the middle"), ("1007", "nothing")])
def test_a_student_without_a_report_gets_the_reason(
    mixed: ClassResult, key: str, output: str
) -> None:
    for text in both(mixed, key):
        assert output in text


@settings(max_examples=80)
@given(texts)
def test_no_text_becomes_markup_in_markdown(text: str) -> None:
    written = markdown(hostile_entry(text), text, show_hidden=True)
    reader = MarkdownIt("commonmark").enable(["table", "strikethrough"])
    tokens = reader.parse(written)
    flat = [token for outer in tokens for token in (outer, *(outer.children or []))]
    known = {"heading", "paragraph", "bullet_list", "list_item", "strong"}
    kinds = {token.type.removesuffix("_open").removesuffix("_close") for token in flat}
    assert kinds <= known | {"inline", "text", "text_special", "code_inline", "fence"}
    heads = [token.tag for token in tokens if token.type == "heading_open"]
    assert heads.count("h1") == 1
    assert written.replace("\n", "").isprintable()


class Markup(HTMLParser):
    """Collects the tags and attributes of a page."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: set[str] = set()
        self.attributes: list[tuple[str, str | None]] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        self.attributes += attrs


@settings(max_examples=20)
@given(texts)
def test_no_text_becomes_markup_in_html(text: str) -> None:
    plain = Markup(html_page(hostile_entry("x"), "x", show_hidden=True).decode())
    page = html_page(hostile_entry(text), text, show_hidden=True).decode()
    found = Markup(page)
    assert found.tags <= plain.tags
    assert not {"script", "img", "iframe", "link"} & found.tags
    assert {name for name, _ in found.attributes} <= {name for name, _ in plain.attributes}
    assert all((value or "").startswith("#") for name, value in found.attributes if name == "href")


@pytest.mark.full  # `make test` has no Chromium
def test_the_page_loads_nothing_and_runs_nothing(visit: Open, tmp_path: Path) -> None:
    text = "\"'></pre><script>alert(1)</script><img src=http://x.example/ onerror=alert(2)>"
    path = tmp_path / "feedback.html"
    path.write_bytes(html_page(hostile_entry(text), text, show_hidden=True))
    witness = visit()
    page = witness.open(path)
    assert "<script>alert(1)</script>" in page.inner_text("h1")
    assert witness.requests == [path.as_uri()]
    assert (witness.dialogs, witness.complaints) == ([], [])
