"""A whole verdict in Korean: the same ids, statuses and points, without English prose."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from rich.cells import cell_len

from grader.report import events
from grader.report.model import CheckResult, Report
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.corpus.model import Package
from tests.recorded import mark
from tests.report.samples import render_report
from tests.report.samples import report as sample_report

# one mistake of each kind: intake, manifest, setup.py, source, build, start, callback, text
NAMES = ("only_the_node", "manifest_other_name", "comma_missing", "super_missing", "f_prefix_missing",
         "printed", "timer_missing", "setup_prints", "colon_missing", "callback_misspelt")  # fmt: skip
# what programs print word for word, and commands to be typed
QUOTED = (
    "No executable found",
    "Package not found",
    "Convert Indentation to Spaces",
    "doesn't exist or not a regular file",
    "was never called",
    "package finished",
)
PROSE = re.compile(r"(?:\b[a-z]{2,}\b[ ,]+){3}[a-z]{2,}\b")


def packages() -> list[Package]:
    return [package for package in BROKEN if package.name in NAMES]


def english_prose(text: str, report: Report) -> list[str]:
    """Return the English prose in a text, ignoring program output and source code."""
    params = [p for check in report.checks for m in check.mistakes for p in m.params.values()]
    printed = sorted((p for p in params if isinstance(p, str) and p), key=len, reverse=True)
    for words in (*printed, *QUOTED):
        text = text.replace(words, " ")
    text = re.sub(r"'[^'\n]*'|`[^`\n]*`|\w+Error: .*|\w+Exception: .*|.*줄: .*", " ", text)
    return PROSE.findall(text)


def texts_of(report: Report) -> list[str]:
    found = [report.message, *report.submission.notes]
    for check in report.checks:
        found += [check.title, check.expected, check.actual, check.rationale, check.fix]
        found += check.advice
    return found


@pytest.mark.parametrize("package", packages(), ids=lambda package: package.name)
def test_a_verdict_in_korean_is_the_same_verdict_and_all_korean(
    package: Package, tmp_path: Path
) -> None:
    heard: list[events.Event] = []
    root = write(package, tmp_path)
    korean = mark(root, lang="ko", listener=heard.append)
    assert korean.lang == "ko"
    assert korean.score == package.expect_score
    failed = {check.id: check.mistakes[0].id for check in korean.checks if check.status == "failed"}
    assert failed == dict(package.expect_failed)
    for text in texts_of(korean):
        assert english_prose(text, korean) == [], text
    for check in korean.checks:
        assert re.search("[가-힣]", check.title)
        if check.status == "failed":
            assert re.search("[가-힣]", check.rationale) or check.consequence_of
            assert re.search("[가-힣]", check.fix)
    page = render_report(korean.model_copy(update={"evidence": type(korean.evidence)()}))
    head, _, _ = page.partition("ros2 run my_robot_controller")
    assert "  expected  " not in head
    assert "기대값" in head
    titles = [event.title for event in heard if isinstance(event, events.StageStarted)]
    assert titles
    assert all(re.search("[가-힣]", title) for title in titles)


def test_the_language_changes_texts_and_nothing_else(tmp_path: Path) -> None:
    package = next(package for package in BROKEN if package.name == "brackets_behind_callback")
    root = write(package, tmp_path)
    english, korean = mark(root), mark(root, lang="ko")
    assert (english.lang, korean.lang) == ("en", "ko")
    kept = ("id", "status", "score", "mistakes", "where", "depends", "blocked_by", "consequence_of")
    for one, other in zip(english.checks, korean.checks, strict=True):
        for name in kept:
            assert getattr(one, name) == getattr(other, name)
    period, output = korean.check("run.period"), korean.check("run.output")
    assert period.consequence_of == "run.output"
    assert output.consequence_of == ""
    assert [m.id for m in output.mistakes] == ["node.callback_called", "run.ended_early"]
    assert [m.id for m in period.mistakes] == ["node.callback_called", "run.by_hand"]


@pytest.mark.parametrize("lang", ["en", "ko"])
@pytest.mark.parametrize("width", [40, 80, 120])
def test_the_markers_stand_below_the_marked_text(lang: str, width: int) -> None:
    check = CheckResult(
        id="run.output",
        title="x",
        status="failed",
        max_score=10,
        actual="Hello Time: 0\n      ^\nHello time: 0",
    )
    report = sample_report(check, score=0).model_copy(update={"lang": lang})
    lines = render_report(report, width=width).splitlines()
    at = next(n for n, line in enumerate(lines) if "Hello Time: 0" in line)
    before, _, _ = lines[at].partition("Hello")
    column = cell_len(before)
    assert lines[at + 1].index("^") == column + len("Hello ")
    assert lines[at + 2].index("Hello time: 0") == column
