"""Outputs of a Korean report for systems and students: all of our prose is Korean."""

from __future__ import annotations

import dataclasses
import io
import json
import re
import shlex
import zipfile
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest

from grader.base.errors import SurroundingsError
from grader.batch.model import ClassResult, GradebookEntry, Override
from grader.batch.policy import Attempt, standing
from grader.batch.systems.gradescope import container as gradescope_run
from grader.batch.systems.gradescope import write as gradescope
from grader.batch.systems.gradescope.archive import gradescope_zip
from grader.batch.systems.gradescope.container import OUR_FAULT, ResultsFile
from grader.batch.systems.moodle.gradebook_import import moodle_import
from grader.batch.systems.prairielearn import write as prairielearn
from grader.course.policy import Policy
from grader.publish import junit
from grader.publish.feedback import html_page, short_html
from grader.publish.markdown import markdown
from grader.report.model import Evidence, Report
from grader.verdict.order import Order
from tests import processes
from tests.gradebook.fill import comment
from tests.marking import ASSIGNMENT
from tests.pages import classes
from tests.report import samples

TITLE = "첫 노드"
# names, units of the SI, and words that are the same in every language
KNOWN = re.compile(
    r"[\w.]+\.(?:py|xml|cfg)|\w+\.\w+|ros2 run|colcon build|ROS|UTC|jazzy|wheels|bubblewrap"
    r"|/clock|```text|my_robot_controller|rclpy"
)
LATIN = re.compile(r"[A-Za-z]{2,}")


def korean(report: Report) -> Report:
    """Return a report with all prose and program output replaced by Korean."""
    checks = []
    for check in report.checks:
        prose = dict.fromkeys(("expected", "actual", "rationale", "fix", "patch"), "글")
        text = {name: "글" for name, value in prose.items() if getattr(check, name)}
        advice = ["글"] * len(check.advice)
        checks.append(check.model_copy(update={"title": "제목", "advice": advice, **text}))
    submission = report.submission.model_copy(update={"name": "김하나", "notes": ["글"]})
    assignment = report.assignment.model_copy(update={"title": TITLE})
    ticks = [tick.model_copy(update={"text": "줄"}) for tick in report.observed.ticks]
    return report.model_copy(
        update={
            "lang": "ko",
            "observed": report.observed.model_copy(update={"ticks": ticks}),
            "evidence": Evidence(build_log="출력", transcript="출력"),
            "message": "글" if report.message else "",
            "checks": checks,
            "assignment": assignment,
            "submission": submission,
        }
    )


def report_of(**statuses: str) -> Report:
    """Return a Korean report whose checks have the given statuses (`run_output=` …)."""
    changed = []
    for name, status in statuses.items():
        check_id = name.replace("_", ".", 1)
        changed.append(
            samples.check(check_id, status, actual="글", fix="글", depends=["build.colcon"])
        )
    hidden = samples.check("run.logger", "failed", visibility="hidden")
    return korean(samples.report(*changed, hidden, score=60))


EVERYTHING = report_of(
    build_colcon="failed", run_output="skipped", run_period="inconclusive", run_interrupt="error"
)
CORRECTIONS = (
    Override("1", "run.output", 5, "봤음", by="박", at=classes.DUE),
    Override("1", "run.logger", 1, "봤음"),
)


def entries() -> Iterator[GradebookEntry]:
    """Yield an entry of each kind: late, corrected, missing, ungradable, waiting, with our fault."""
    usual: dict[str, Any] = {"student": classes.student(1), "lang": "ko"}
    usual["student"] = dataclasses.replace(usual["student"], name="김하나", section="가")
    late = {"penalty": 5, "late_seconds": 7_800, "attempt": 2, "attempts": 3}
    yield classes.entry(1, EVERYTHING, **usual, **{**late, "final": 55})
    yield classes.entry(1, EVERYTHING, **usual, late_seconds=90_000)
    yield classes.entry(1, EVERYTHING, **usual, penalty=1, final=59)
    yield classes.entry(1, EVERYTHING, **usual, overrides=CORRECTIONS, score=66, final=66)
    total = (Override("1", "", 80, "구두 시험", by="박"),)
    yield classes.entry(1, EVERYTHING, **usual, overrides=total, score=80, final=80)
    for status in ("missing", "elsewhere", "pending", "ungradable"):
        yield classes.entry(1, None, **usual, status=status)
    fault = EVERYTHING.model_copy(update={"status": "error", "message": "", "checks": []})
    attempt = Attempt(1, None, late=True, report=fault)
    stands = standing(usual["student"], [attempt], (), _policy(), 100)
    yield dataclasses.replace(stands, lang="ko")


def _policy() -> Policy:
    return ASSIGNMENT.policy


ENTRIES = list(entries())


class Texts(HTMLParser):
    """Collects the text of a page, visible or read aloud."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.found: list[str] = []
        self._skipping = False
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self._skipping = tag in ("style", "script")
        read = ("aria-label", "title", "data-some")
        self.found += [value or "" for name, value in attrs if name in read]

    def handle_endtag(self, tag: str) -> None:
        self._skipping = False

    def handle_data(self, data: str) -> None:
        self.found += [] if self._skipping else [data]


def strings(part: Any) -> Iterator[str]:
    """Yield every text of a JSON document that is prose or a name, not a keyword of its format."""
    if isinstance(part, dict):
        for name, value in part.items():
            form = ("status", "visibility", "extra_data", "execution_time")
            if name not in form and not name.endswith(("_format", "_visibility")):
                yield from strings(value)
    elif isinstance(part, list):
        for value in part:
            yield from strings(value)
    elif isinstance(part, str):
        yield part


def english(text: str) -> list[str]:
    """Return the Latin words of a text that are not names."""
    return LATIN.findall(KNOWN.sub(" ", text.replace(samples.COMMAND, " ")))


@pytest.mark.parametrize("show_hidden", [False, True])
@pytest.mark.parametrize("entry", ENTRIES, ids=range(len(ENTRIES)))
def test_feedback_has_no_english_in_it(entry: GradebookEntry, show_hidden: bool) -> None:
    page = html_page(entry, TITLE, show_hidden=show_hidden).decode()
    assert '<html lang="ko"' in page
    short = short_html(entry, show_hidden=show_hidden)
    shown_text = [markdown(entry, TITLE, show_hidden=show_hidden)]
    for text in (*shown_text, *Texts(page).found, *Texts(short).found):
        assert english(_without_contact(text, entry)) == [], text


def _without_contact(text: str, entry: GradebookEntry) -> str:
    for own in (entry.student.email, entry.student.username):
        text = text.replace(own, " ")
    return text


@pytest.mark.parametrize("entry", ENTRIES, ids=range(len(ENTRIES)))
def test_what_other_systems_show_has_no_english_in_it(entry: GradebookEntry) -> None:
    documents: list[Any] = [prairielearn.results(entry)]
    if entry.report is not None:
        documents.append(gradescope.results(entry.report, penalty=5, overrides=entry.overrides))
    for document in documents:
        for text in strings(document):
            assert english(text.replace("0ms", "")) == [], text
    suite = ET.fromstring(junit.class_xml(classes.result([entry], title=TITLE)))
    for part in suite.iter():
        shown = [part.get("message", ""), part.text or ""]
        shown += [part.get("value", "")] if part.get("name") in ("adjusted", "corrected") else []
        for text in shown:
            assert english(text) == [], text


def test_a_student_without_a_report_gets_the_chosen_language() -> None:
    found = gradescope.problem(OUR_FAULT, lang="ko")
    for text in strings(found):
        assert re.search("[가-힣]", text)
        assert english(text) == [], text


def test_moodles_feedback_is_korean_and_its_header_stays() -> None:
    result: ClassResult = classes.result([ENTRIES[0]], title=TITLE)
    header, row = moodle_import(result, comment, by="email").content.decode().splitlines()
    assert header.startswith("Email address,Full name,")
    assert header.endswith(",Feedback")
    assert "늦음" in row


def test_ids_points_and_states_are_the_same_in_both_languages() -> None:
    english_one = EVERYTHING.model_copy(update={"lang": "en"})
    one, other = gradescope.results(EVERYTHING), gradescope.results(english_one)
    for test, same in zip(one["tests"], other["tests"], strict=True):
        kept = ("score", "max_score", "status", "visibility", "extra_data")
        assert [test.get(name) for name in kept] == [same.get(name) for name in kept]
    xml = [ET.fromstring(junit.report_xml(report)) for report in (EVERYTHING, english_one)]
    names = [
        [(case.get("name"), [p.tag for p in case]) for case in x.iter("testcase")] for x in xml
    ]
    assert names[0] == names[1]
    assert json.dumps(gradescope.results(EVERYTHING)).isascii()


def test_gradescopes_archive_keeps_the_language(tmp_path: Path) -> None:
    with zipfile.ZipFile(io.BytesIO(gradescope_zip(lang="ko"))) as archive:
        script = archive.read("run_autograder").decode("ascii")
        names = archive.namelist()
    assert "--lang ko" in script
    assert "grader/base/i18n/ko/LC_MESSAGES/grader.mo" in names
    line = next(line for line in script.splitlines() if "echo " in line)
    out = tmp_path / "results.json"
    done = processes.run(["bash", "-c", f"results={shlex.quote(str(out))}\n{line}"])
    assert done.returncode == 0, done.stderr
    found = json.loads(out.read_text())
    assert found["score"] == 0
    assert english(found["output"]) == []


def test_gradescopes_results_are_korean_before_the_first_check_and_after_a_fault(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "submission").mkdir()
    seen: list[str] = []

    def fails(order: Order, file: ResultsFile) -> Report:
        seen.append((tmp_path / "results/results.json").read_text())
        assert order.lang == "ko"
        raise SurroundingsError("no sandbox")

    monkeypatch.setattr(gradescope_run, "grade", fails)
    assert gradescope_run.run(tmp_path, sandbox="bubblewrap", lang="ko") == 3
    seen.append((tmp_path / "results/results.json").read_text())
    assert gradescope_run.run(tmp_path, assignment="hello_tme", lang="ko") == 2
    seen.append((tmp_path / "results/results.json").read_text())
    for text in seen:
        found = json.loads(text)
        assert re.search("[가-힣]", found["output"])
        for shown_text in strings(found):
            assert english(shown_text) == [], shown_text
