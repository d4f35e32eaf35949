"""The course's page and a student's feedback in Chromium: readable for everybody, searched at once."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import expect

from grader.batch.course_result import LessonResult, course_result
from grader.publish.gradebooks import write_outputs
from grader.publish.pages.course import course_page
from grader.report.model import Report
from tests.pages import classes
from tests.pages.axe import violations
from tests.pages.browser import Open

pytestmark = pytest.mark.full  # `make test` has no Chromium


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_no_violation_on_course_and_feedback(
    scheme: str, reports: tuple[Report, ...], tmp_path: Path, visit: Open, axe_source: str
) -> None:
    result = classes.mixed(reports, 24)
    lessons = [LessonResult(name, 1, result, name) for name in ("one", "two")]
    (tmp_path / "index.html").write_bytes(course_page(course_result("A course", lessons)))
    write_outputs(result, tmp_path)
    witness = visit(color_scheme=scheme)
    for page_file in sorted((tmp_path / "feedback").glob("*.html"))[:3]:
        assert violations(witness.open(page_file), axe_source) == [], page_file.name
    page = witness.open(tmp_path / "index.html")
    assert violations(page, axe_source) == []
    first = result.entries[0]
    page.get_by_label("Find students").fill(first.student.email)
    expect(page.get_by_role("status")).to_have_text("1 of 24 students shown")
    row = page.locator("#all tbody tr:not([hidden])")
    expect(row.get_by_role("link")).to_have_count(2)
    assert row.get_by_role("link").first.get_attribute("href") == "one/students/1000.html"
