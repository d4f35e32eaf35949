"""`grader validate --show`: what a student would read about a mutant."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.report.detail import AS_POLICY, WORDS, FeedbackRules
from grader.report.terminal import render_report
from grader.validate.marking import Marked
from grader.validate.matrix import MutantResult
from grader.validate.mutant import Mutant
from grader.validate.shown import as_student_reads
from grader.verdict.checks.all import QUOTES
from tests import processes, recorded
from tests.corpus.broken import BROKEN
from tests.corpus.build import write

NAME = "text_capital"
FIX = "Hello time: "
PLAIN = {"expected", "found", "where"}
WORDS_OF = {  # what each level shows of a failed check, by the labels of the page
    "score": set(),
    "where": PLAIN,
    "hints": PLAIN | {"why", "fix"},
    "full": PLAIN | {"why", "fix", "change"},
}


@pytest.fixture
def row(tmp_path: Path) -> MutantResult:
    package = next(package for package in BROKEN if package.name == NAME)
    report = recorded.mark(write(package, tmp_path))
    mutant = Mutant(
        name=NAME, edits=(), families=("run.output",), mistake="run.wrong_text", where="here:3"
    )
    return MutantResult(mutant, Marked({"run.output": "failed"}, report=report))


def shown(row: MutantResult, feedback: str) -> str:
    report = as_student_reads(row, feedback)
    assert report is not None
    return render_report(report, quotes=QUOTES)


def labels(page: str) -> set[str]:
    return {word for line in page.splitlines() for word in line.split()[:1]}


@pytest.mark.parametrize("feedback", WORDS)
def test_no_more_is_shown_than_the_feedback_gives(feedback: str, row: MutantResult) -> None:
    wanted = WORDS_OF[feedback]
    assert labels(shown(row, feedback)) & WORDS_OF["full"] == wanted


def test_by_default_the_assignments_feedback_decides(row: MutantResult) -> None:
    report = row.marked.report
    assert report is not None
    rules = FeedbackRules(after_due="where")
    info = report.assignment.model_copy(update={"feedback": rules})
    strict = Marked(row.marked.status, report=report.model_copy(update={"assignment": info}))
    assert shown(MutantResult(row.mutant, strict), AS_POLICY) == shown(row, "where")
    assert shown(row, AS_POLICY) == shown(row, "full")


def test_the_page_says_which_mutant_it_is_about_and_where_that_is(row: MutantResult) -> None:
    page = shown(row, "full")
    assert NAME in page
    assert "here:3" in page


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (("--show", "marker_misng"), "Did you mean 'marker_missing'?"),
        (("--show", "all", "--static"), "leave out --static"),
        (("--feedback", "full"), "--feedback is about --show"),
    ],
)
def test_what_cannot_be_shown_is_a_usage_error(words: tuple[str, ...], says: str) -> None:
    done = processes.run(processes.grader("validate", "hello_time", *words), timeout=60)
    assert (done.returncode, says in done.stderr) == (2, True), done.stderr


@pytest.mark.prefix
@pytest.mark.parametrize(
    ("lesson", "name", "check", "says"),
    [
        pytest.param(
            *("start_stop", "pen without a width and a colour", "pen.down", "width: 0"),
            marks=pytest.mark.long,
        ),
        pytest.param(
            *("own_message", "timer does not wait for a pose", "run.stays", "NoneType"),
            marks=pytest.mark.long,
        ),
        pytest.param(
            *("own_message", "publishes without a pose", "distance.waits", "a message at 0.5 s"),
            marks=pytest.mark.long,
        ),
    ],
)
def test_a_lesson_fails_what_it_asks_for_and_the_student_reads_it(
    lesson: str, name: str, check: str, says: str
) -> None:
    """The mutant is built and run, fails where mutants.yaml says, and its report is plain text."""
    words = ("validate", lesson, "--show", name, "--limit", "build_seconds=600")
    done = processes.run(processes.grader(*words), timeout=900)
    assert done.returncode == 0, done.stdout + done.stderr
    assert f"== {name}: {check} must fail" in done.stdout
    assert labels(done.stdout) >= WORDS_OF["where"]
    assert says in done.stdout
    assert "\x1b" not in done.stdout
