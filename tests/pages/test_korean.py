"""The instructor's pages in Korean: the class, its students, the course, and the search."""

from __future__ import annotations

import dataclasses
import re
from datetime import timedelta
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import expect

from grader.batch.course_result import LessonResult, course_result
from grader.batch.join import STRANGER
from grader.batch.model import ClassResult, LapsedOverride, Remark
from grader.batch.result import GONE
from grader.batch.systems.known import FOLDERS
from grader.batch.systems.layout import HIDDEN
from grader.batch.systems.notes import Notes
from grader.publish.pages import write_site
from grader.publish.pages.course import course_page
from grader.report.model import LimitInfo
from tests.gradebook.test_korean import CORRECTIONS, ENTRIES, EVERYTHING, TITLE, Texts, english
from tests.pages import classes
from tests.pages.axe import violations
from tests.pages.browser import Open

# what is typed, the names of fields in report.json, and units
CODE = re.compile(
    r"grader override( STUDENT --points N --because TEXT| --mistake.*)?|grader (grade-all|mail) .*"
    r"|--remove|\{shown\}|SHA-256|\d bytes|[0-9a-f]{64}|\d{4}-\d\d-\d\dT[\d:.+Z]*"
    r"|^(rmw|python|colcon|setuptools|image|grader)$|rmw_fastrtps_cpp|cgroup|memory|^/[/\w]+$"
    r"|(setup|intake|build|run|total) \d+\.\d\d s"
)


NAMES = "가나다라마바사아자차카타파하"


def korean_class() -> ClassResult:
    """Return a class with every kind of student, and with everything that needs attention."""
    limits = {"memory": LimitInfo(value=10**9, unit="bytes", held_by="cgroup")}
    environment = EVERYTHING.environment.model_copy(update={"limits": limits})
    report = EVERYTHING.model_copy(update={"environment": environment})
    usual: dict[str, Any] = {
        "lapsed": (LapsedOverride(CORRECTIONS[0], 1), LapsedOverride(CORRECTIONS[0])),
        "remark": Remark("1", "글"),
        "is_extended": True,
        "slip_days": 2,
        "due": classes.DUE + timedelta(days=1),
    }
    more = [
        dataclasses.replace(ENTRIES[0], report=report, **usual),
        dataclasses.replace(ENTRIES[0], late_seconds=None, due=classes.DUE),
        *(dataclasses.replace(ENTRIES[-1], status=s) for s in ("error", "unclear")),
    ]
    notes = Notes()
    notes.add_names(HIDDEN, ["가"] * 60)
    entries = [
        dataclasses.replace(
            entry,
            student=dataclasses.replace(
                classes.student(n), name=f"김{NAMES[n]}", email="", username="", section="가"
            ),
            report=entry.report,
            problem="글" if entry.problem else "",
            notes=(STRANGER, GONE),
            same_as=(str(1000 + (n + 1) % 2),) if n < 2 else (),
        )
        for n, entry in enumerate((*ENTRIES, *more))
    ]
    return classes.result(
        entries,
        title=TITLE,
        assignment="과제",
        lang="ko",
        system=FOLDERS,
        identical=(("1000", "1001"),),
        unclear=("글",),
        notes=notes.lines(),
    )


@pytest.fixture(scope="module")
def korean_site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The pages of a Korean class, and of a course of two lessons with it."""
    out, result = tmp_path_factory.mktemp("site"), korean_class()
    write_site(result, out)
    lessons = [LessonResult(name, 1, result, ".") for name in ("하나", "둘")]
    (out / "course.html").write_bytes(course_page(course_result(TITLE, lessons, ["셋"])))
    return out


def test_a_korean_class_has_no_english_on_its_pages(korean_site: Path) -> None:
    pages = sorted(korean_site.rglob("*.html"))
    assert len(pages) == len(ENTRIES) + 4 + 2
    for page in pages:
        text = page.read_text(encoding="utf-8")
        assert '<html lang="ko" ' in text
        for found in Texts(text).found:
            assert english(CODE.sub(" ", found)) == [], (page.name, found)


def test_pages_of_former_students_are_removed_in_either_language(tmp_path: Path) -> None:
    for lang, count in (("ko", 5), ("en", 3), ("ko", 2)):
        write_site(classes.result(ENTRIES[:0], lang=lang), tmp_path)
        entries = [classes.entry(number, None, status="missing") for number in range(count)]
        write_site(classes.result(entries, lang=lang), tmp_path)
        assert len(list((tmp_path / "students").iterdir())) == count


@pytest.mark.full  # `make test` has no Chromium
def test_the_search_of_a_korean_page_answers_in_korean(
    visit: Open, korean_site: Path, axe_source: str
) -> None:
    witness = visit(viewport={"width": 390, "height": 800})
    for name in ("index.html", "course.html"):
        page = witness.open(korean_site / name)
        count = page.locator("#all tbody tr").count()
        expect(page.get_by_role("status")).to_have_text(f"학생 {count}명")
        page.get_by_label("학생 찾기").fill(f"김{NAMES[3]}")
        expect(page.get_by_role("status")).to_have_text(f"학생 {count}명 중 1명 표시")
        assert page.evaluate("document.documentElement.scrollWidth") == 390, name
        assert violations(page, axe_source) == []
