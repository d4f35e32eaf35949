"""The report on one screen: what is wrong, what to do, and nothing that scrolls away."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from grader.course.after import After, after_lesson
from grader.course.find import lessons_of
from grader.course.folder import own_course
from grader.report.detail import Detail
from grader.report.feedback import with_feedback
from grader.report.model import Mistake, Where
from grader.report.notice import for_terminal
from grader.report.one_screen import SCREEN, Lead, State, one_screen
from grader.report.wrap import rows
from tests.report.samples import check, failing_report, misspelt_module, report

LEAD = Lead(rest="the same command with --all", own_code=True)
LONG = "A sentence about the network of the terminal in which nobody has sourced anything. " * 9


def many_failures(**fields: Any) -> str:
    failed = [
        check(f"run.own_{n}", "failed", actual=LONG, where=Where(file="a/b.py", line=n))
        for n in range(12)
    ]
    long = {"actual": LONG, "rationale": LONG, "fix": LONG}
    return one_screen(report(misspelt_module().model_copy(update=long), *failed, **fields), LEAD)


@pytest.mark.parametrize("lang", ["en", "ko"])
def test_the_longest_report_fits_on_a_screen_and_names_the_rest(lang: str) -> None:
    page = many_failures(lang=lang)
    assert rows(page, 80) <= SCREEN - LEAD.around
    change = "+            'test_node = my_robot_controller.my_first_node:main'"
    for needed in ("setup.py:23", change, "run.own_0", "--all"):
        assert needed in page


def test_a_short_failure_is_complete() -> None:
    page = one_screen(failing_report(), LEAD)
    assert rows(page, 80) <= SCREEN - LEAD.around
    words = " ".join(page.split())
    assert "Score 55 / 100" in words
    assert "Fix entry_point.mapping (in setup.py, line 23), save, and run check again." in words
    assert "checks skipped (30 points)" in words
    assert "pass  " not in page


def test_a_failure_of_a_run_stands_with_the_values_that_were_drawn() -> None:
    runs = [{"name": "drives", "drawn": {"radius": 0.7, "who": "ben"}}]
    wrong = {"actual": "angular.z: 1.0", "mistakes": [Mistake(id="topic.wrong_value")]}
    of_run = check("run.own", "failed", **wrong)
    page = one_screen(report(of_run, runs=runs), LEAD)
    assert "drawn     radius = 0.7, who = ben\n" in page
    points = with_feedback(report(of_run, runs=runs), Detail.POINTS)
    assert "radius" not in one_screen(points, LEAD)
    assert "radius" not in one_screen(failing_report(runs=runs), LEAD)  # of a file, not of a run


def test_what_passed_is_one_line_and_what_comes_next() -> None:
    after = [("learned", "A package"), ("next", "A publisher: make lab LESSON=draw_circle")]
    page = one_screen(report(), Lead(rest="", after=after)).splitlines()
    assert page[0].startswith("Score 100 / 100: every check passed")
    assert [line.split()[0] for line in page[1:]] == ["learned", "next"]


BUILD = "cd ~/ros2_ws/src && rm -r build install log"


def test_what_is_next_for_the_student_comes_first_whatever_failed() -> None:
    state = State(next=BUILD, found="you built in ~/ros2_ws/src")
    lead = replace(LEAD, state=state)
    page = one_screen(failing_report(), lead)
    assert page.index("you built in ~/ros2_ws/src") < page.index(BUILD) < page.index("FAIL ")
    assert "Fix entry_point.mapping" not in page  # (one thing)
    assert rows(page, 80) <= SCREEN - lead.around
    passed = one_screen(report(), replace(lead, after=[("learned", "A"), ("next", "Lesson 2")]))
    assert BUILD in passed
    assert "Lesson 2" not in passed
    of_first = one_screen(failing_report(), replace(lead, state=replace(state, of_first=True)))
    assert "Score 55 / 100" in of_first
    assert of_first.index("FAIL entry_point.mapping") < of_first.index(BUILD)


def test_a_long_command_on_the_page_is_read_by_a_shell_as_one() -> None:
    words = [f"word{n}" for n in range(30)]
    page = one_screen(report(), replace(LEAD, state=State(next=f"touch {' '.join(words)}")))
    begin = page.index("touch ")
    assert page[begin:].replace("\\\n", " ").split()[1:31] == words


def test_a_path_is_a_link_that_a_terminal_opens() -> None:
    url = "file://here/home/anna/setup.py"
    lead = Lead(rest="", links={"setup.py": url})
    assert f"\x1b]8;;{url}\x1b\\setup.py:23\x1b]8;;\x1b\\" in one_screen(failing_report(), lead)
    assert "\x1b]8" not in one_screen(failing_report(), LEAD)


def test_a_notice_is_broken_at_words_and_a_command_is_not() -> None:
    lines = for_terminal(f"{LONG}\n  cp {'x' * 100}", 80).split("\n")
    assert max(map(len, lines[:-1])) <= 80
    assert " ".join(" ".join(lines[:-1]).split()) == LONG.strip()
    assert lines[-1] == f"  cp {'x' * 100}"


@pytest.mark.parametrize("lang", ["en", "ko"])
def test_every_lesson_says_what_was_learned_and_what_is_next(lang: str) -> None:
    lessons = lessons_of(own_course())
    for n, lesson in enumerate(lessons):
        after = after_lesson(lesson, lang=lang, distro="kilted")
        assert after.documentation.startswith("https://docs.ros.org/en/kilted/")
        assert after.id == "".join(lessons[n + 1 : n + 2])
        assert bool(after.title) == bool(after.id)
        assert (lang == "ko") == any("가" <= letter <= "힣" for letter in after.learned)
        assert after.learned
    assert after_lesson("no_lesson", lang=lang, distro="jazzy") == After()


def test_another_failure_keeps_its_last_word_and_its_place_is_translated() -> None:
    no_entry = "console_scripts에 항목이 없습니다"
    second = check(
        "entry_point.mapping", "failed", actual=no_entry, where=Where(file="setup.py", line=26)
    )
    short = check("run.own", "failed", actual="짧음", where=Where(file="setup.py", line=26))
    skipped = [check(f"run.{n}", "skipped", blocked_by="source.node_file") for n in range(3)]
    first = check("source.node_file", "failed", actual="a")
    page = one_screen(report(first, second, short, *skipped, lang="ko"), LEAD)
    assert f"entry_point.mapping: {no_entry}" in page
    assert "run.own: 짧음 (setup.py, 26번 줄)" in page
    assert "검사 3개 생략" in page
