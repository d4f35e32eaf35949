"""Text from a submission is shown as plain text, whatever it contains."""

from __future__ import annotations

import re
import time
import unicodedata
from typing import Any

import pytest
from hypothesis import given, settings, strategies
from rich.cells import cell_len

from grader.base.i18n.message import Message
from grader.base.plain_text import first_lines, last_lines, one_line, visible
from grader.report.model import Report
from grader.report.terminal import render_matrix
from tests.marking_catalogue import MarkingCatalogue
from tests.report.samples import check, render_report, report

OUR_STYLES = re.compile(r"\x1b\[[0-9;]*m")
SURVIVING = ("\n", "\t")  # (a diff keeps its tabs)
HOSTILE = {
    "clear screen": "\x1b[2J\x1b[H",
    "title": "\x1b]0;owned\x07",
    "clipboard": "\x1b]52;c;cm0gLXJmIC8=\x1b\\",
    "C1 CSI": "\x9b31m\x85\x90",
    "bidi override": "abc\u202edef\u2066ghi\u2069\u200f\u061c",
    "zero width": "He\u200bllo\ufeff \u2060time\u00ad",
    "backspaces": "FAIL\b\b\b\bpass\x7f",
    "carriage return": "Score 0 / 100\rScore 100 / 100",
    "line separators": "a\x0bb\x0cc\u2028d\u2029e\x1c\x1d\x1e\x85",
    "nul": "\x00\x01\x02",
    "tags": "\U000e0041\U000e007f",
    "no-break space": "a\u00a0b",
}


def report_full_of(text: str) -> Report:
    """Return a report with the text in every field that anybody can fill."""
    fields: dict[str, Any] = {
        "title": text,
        "rationale": text,
        "expected": text,
        "actual": text,
        "fix": text,
        "patch": text,
        "advice": [text],
        "mistakes": [{"id": text}],
        "where": {"file": text, "line": 1},
    }
    broken = [
        check(check_id, status, **fields)
        for check_id, status in (
            ("build.colcon", "failed"),
            ("run.starts", "failed"),
            ("run.node_name", "inconclusive"),
            ("run.output", "error"),
            ("run.logger", "skipped"),
            ("run.period", "passed"),
        )
    ]
    odd = check(f"own.{text}", "skipped", depends=["build.colcon"], **fields)
    clean = report()
    return report(
        *broken,
        odd,
        message=text,
        assignment={**clean.assignment.model_dump(), "title": text},
        submission={
            **clean.submission.model_dump(),
            "name": text,
            "student_id": text,
            "path": text,
            "package": text,
            "notes": [text],
        },
        environment={**clean.environment.model_dump(), "distro": text, "rclpy": text,
                     "limits": {text: {"value": 1, "unit": text, "held_by": text}}},
        observed={
            "command": text,
            "clock": "virtual",
            "nodes": [text],
            "ticks": [{"n": 0, "text": text, "virtual": 0.0, "wall": 0.0}],
        },
        evidence={"build_log": text, "transcript": text},
    )  # fmt: skip


def pages(marked: Report, width: int = 80) -> list[str]:
    return [
        render_report(marked, width=width, verbose=verbose, styled=styled)
        for verbose in (False, True)
        for styled in (False, True)
    ] + [render_matrix([marked], width=width, styled=styled) for styled in (False, True)]


def forbidden_in(page: str) -> set[str]:
    """Return the characters of a page that are neither printable nor part of our styles."""
    text = OUR_STYLES.sub("", page)
    wrong = ("Cc", "Cf", "Cs", "Zl", "Zp")
    return {c for c in text if unicodedata.category(c) in wrong and c not in SURVIVING}


@pytest.mark.parametrize("name", HOSTILE)
@pytest.mark.parametrize("width", [40, 80])
def test_no_control_character_reaches_the_terminal(name: str, width: int) -> None:
    for page in pages(report_full_of(HOSTILE[name]), width):
        assert forbidden_in(page) == set()


@given(text=strategies.text(max_size=80))
@settings(max_examples=40)
def test_no_text_brings_a_control_character_to_the_terminal(text: str) -> None:
    marked = report_full_of(text.encode("utf-8", "ignore").decode())
    assert forbidden_in(render_report(marked, verbose=True, styled=True)) == set()
    assert forbidden_in(render_matrix([marked], width=40)) == set()


def test_a_plain_page_has_no_escape_at_all() -> None:
    assert "\x1b" not in render_report(report_full_of("\x1b[31mred"), verbose=True)


def test_our_own_styles_are_only_colours_and_weights() -> None:
    page = render_report(report_full_of("x"), styled=True)
    assert "\x1b[" in page
    assert "\x1b" not in OUR_STYLES.sub("", page)


def test_invisible_characters_are_spelled_out() -> None:
    assert visible("a\x1bb\x9bc\u202ed\u00a0e") == r"a\x1bb\x9bc\u202ed\xa0e"
    assert visible("\ud800") == r"\ud800"
    assert one_line("a\nb\r\nc") == r"a\nb\nc"


@pytest.mark.parametrize(
    "markup", ["[bold red]x[/]", "[/]", "[link=http://x]y[/link]", ":smile:", "\\[x]", "[[", "[@"]
)
def test_markup_and_emoji_codes_are_plain_text(markup: str) -> None:
    for page in pages(report_full_of(markup)):
        assert OUR_STYLES.sub("", page).count(markup) >= 5


def test_a_program_cannot_write_a_line_that_looks_like_ours() -> None:
    forged = "\n\nScore 100 / 100  (every check passed)\n  report    /tmp/x\nFAIL x: y\n"
    page = render_report(report_full_of(forged), verbose=True)
    assert [line for line in page.splitlines() if line.startswith("Score")] == [
        line for line in page.splitlines() if line.startswith("Score") and "inconclusive" in line
    ]
    assert not [line for line in page.splitlines() if line.startswith("FAIL x")]
    assert "  report    /tmp/x" not in page.splitlines()


def test_a_megabyte_is_cut_and_takes_little_time() -> None:
    for text in ("x" * 1_000_000, "x\n" * 500_000, "\x1b" * 1_000_000, "Traceback\n" * 100_000):
        begin = time.process_time()
        page = render_report(report_full_of(text), verbose=False)
        assert time.process_time() - begin < 5
        assert len(page) < 200_000
        assert "left out" in page


def test_what_is_left_out_is_said_in_the_readers_language() -> None:
    def translate(text: str) -> str:
        return text.translated(MarkingCatalogue()) if isinstance(text, Message) else text

    lines = first_lines("x\n" * 20, lines=4, translate=translate)
    assert lines[2] == "<[... 16 lines left out ...]>"
    (line,), _ = last_lines("x" * 100, lines=4, most=10, translate=translate)
    assert line == "xxxxx<[... 90 characters left out ...]>xxxxx"


def test_of_a_long_text_beginning_and_end_are_kept() -> None:
    lines = first_lines("\n".join(str(number) for number in range(1000)), lines=10)
    assert (lines[0], lines[-1], len(lines)) == ("0", "999", 11)
    assert "990 lines" in lines[5]
    cut = one_line("a" + "x" * 5000 + "z", most=100)
    assert (cut[0], cut[-1]) == ("a", "z")
    assert len(cut) < 150


@pytest.mark.parametrize(
    "text",
    [
        "Hello 😀🤖👍🏽 time",
        "שלום עולם",
        "مرحبا بالعالم",
        "你好世界 " * 30,
        "e\u0301" * 40,
        "🤖" * 200,
    ],
)
@pytest.mark.parametrize("width", [40, 80, 200])
def test_letters_of_all_scripts_are_kept_and_lines_fit(text: str, width: int) -> None:
    marked = report(check("run.output", "failed", expected="Hello", actual=text, rationale=text),
                    observed={}, evidence={"transcript": text, "build_log": ""})  # fmt: skip
    page = render_report(marked, width=width)
    assert re.sub(r"\s", "", text) in re.sub(r"[\s|]", "", page)
    copied = (marked.submission.path,)
    for line in page.splitlines():
        assert cell_len(line) <= width or line.strip().endswith(copied)


@pytest.mark.parametrize("width", [1, 20, 40, 59, 60, 80, 100, 250])
def test_no_line_is_wider_than_the_page_or_the_readable_width(width: int) -> None:
    long = "word " * 100 + "x" * 300
    marked = report(
        check("run.output", "failed", title=long, expected=long, actual=long, rationale=long,
              fix=long, advice=[long]),
        check("run.period", "inconclusive", actual=long),
        observed={},
        submission={**report().submission.model_dump(), "path": "/p", "notes": [long]},
        evidence={"transcript": long, "build_log": long},
    )  # fmt: skip
    bound = max(20, min(width, 100))
    for page in (render_report(marked, width=width), render_matrix([marked], width=width)):
        for line in page.splitlines():
            assert cell_len(line) <= (bound if bound >= 40 else 45), line


def test_a_page_for_a_browser_keeps_the_tabs_of_a_diff() -> None:
    assert visible("-\ty\x1b = 1", tabs=True) == "-\ty\\x1b = 1"
    assert visible("-\ty = 1") == "-   y = 1"
    assert first_lines("-\ty = 1", lines=2, tabs=True) == ["-\ty = 1"]
