"""The folder of pages: its content, its permissions, the time to write it."""

from __future__ import annotations

import html.parser
import re
import stat
import time
from pathlib import Path
from urllib.parse import unquote

import pytest

from grader.base.errors import SurroundingsError
from grader.publish.pages import write_site
from grader.report.model import Report
from tests.pages import classes
from tests.report.samples import failing_report, report


class Links(html.parser.HTMLParser):
    """Collects every link and every id of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.addresses: list[str] = []
        self.ids: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = dict(attrs)
        assert not [name for name in found if name.startswith("on") or name == "style"]
        self.addresses += [v for k, v in attrs if k in ("href", "src", "action") and v]
        self.ids += [value for name, value in attrs if name == "id" and value]


def contents(folder: Path) -> dict[str, bytes]:
    files = [path for path in folder.rglob("*") if path.is_file()]
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


def test_every_link_leads_to_a_page_or_place_in_the_folder(site: Path) -> None:
    pages = {path: Links(path.read_text(encoding="utf-8")) for path in site.rglob("*.html")}
    assert len(pages) == 41
    for page, links in pages.items():
        assert len(links.ids) == len(set(links.ids)), page
        assert links.addresses
        for address in links.addresses:
            file, _, part = unquote(address).partition("#")
            target = (page.parent / file).resolve() if file else page
            assert target in pages, (page, address)
            assert not part or part in pages[target].ids, (page, address)


def test_the_next_links_reach_every_student(site: Path) -> None:
    page = site / "students/1000.html"
    seen = [page.name]
    while found := re.search(r'rel="next" href="([^"]+)"', page.read_text(encoding="utf-8")):
        page = page.parent / found[1]
        seen.append(page.name)
    assert seen == [f"{key}.html" for key in range(1000, 1040)]


def test_the_folder_has_only_pages_readable_by_their_owner_only(site: Path) -> None:
    for path in (site / "students", *site.rglob("*")):
        mode = stat.S_IMODE(path.stat().st_mode)
        assert mode == (0o700 if path.is_dir() else 0o600), path
        assert path.is_dir() or path.suffix == ".html"


def test_the_same_class_gives_the_same_bytes(site: Path, tmp_path: Path) -> None:
    reports = [failing_report(), report()]
    first, second = classes.mixed(reports, 12), classes.mixed(reports, 12)
    write_site(first, tmp_path / "a")
    write_site(second, tmp_path / "b")
    assert contents(tmp_path / "a") == contents(tmp_path / "b")


def test_the_path_of_the_start_page_is_returned(tmp_path: Path) -> None:
    out = tmp_path / "not" / "there" / "yet"
    assert write_site(classes.mixed([report()], 3), out) == out / "index.html"
    assert (out / "index.html").is_file()


def test_a_class_of_two_hundred_takes_under_five_seconds_and_a_megabyte(
    reports: tuple[Report, ...], tmp_path: Path
) -> None:
    made = classes.mixed(reports, 200)
    begin = time.process_time()
    index = write_site(made, tmp_path / "site")
    assert time.process_time() - begin < 5
    assert index.stat().st_size < 1_000_000
    assert len(list((tmp_path / "site/students").iterdir())) == 200


def test_the_overview_stays_small_if_everybody_fails_everything(tmp_path: Path) -> None:
    bad = report()
    fault = [{"id": f"mistake.{n}"} for n in range(3)]
    checks = [
        check.model_copy(update={"status": "failed", "score": 0, "actual": "x" * 5_000})
        for check in bad.checks
    ]
    worst = Report.model_validate(
        bad.model_dump(by_alias=True)
        | {"checks": [{**check.model_dump(), "mistakes": fault} for check in checks]}
    )
    everybody = [classes.entry(number, worst) for number in range(200)]
    index = write_site(classes.result(everybody), tmp_path)
    assert index.stat().st_size < 1_000_000


def test_pages_of_former_students_are_removed_and_other_files_stay(tmp_path: Path) -> None:
    write_site(classes.mixed([report()], 5), tmp_path)
    own = tmp_path / "students" / "notes.html"
    own.write_text("<!doctype html>\n<html>the instructor's own notes")
    write_site(classes.mixed([report()], 3), tmp_path)
    names = {path.name for path in (tmp_path / "students").iterdir()}
    assert names == {"1000.html", "1001.html", "1002.html", "notes.html"}


def test_an_empty_class_has_a_page(tmp_path: Path) -> None:
    index = write_site(classes.result([]), tmp_path)
    assert "0 students" in index.read_text(encoding="utf-8")


def test_a_link_in_place_of_the_pages_is_not_followed(tmp_path: Path) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    out = tmp_path / "site"
    out.mkdir()
    (out / "students").symlink_to(elsewhere)
    with pytest.raises(SurroundingsError, match="page of the class"):
        write_site(classes.mixed([report()], 3), out)
    assert not list(elsewhere.iterdir())


def test_a_file_in_place_of_the_folder_is_reported_without_a_traceback(tmp_path: Path) -> None:
    (tmp_path / "site").write_text("in the way")
    with pytest.raises(SurroundingsError, match="page of the class"):
        write_site(classes.mixed([report()], 3), tmp_path / "site")
