"""A check in plain text, as systems show it below a test's name."""

from __future__ import annotations

from grader.gradebook.points import Mark
from grader.report.blocks import UNSEEN
from grader.report.blocks import WORDS
from grader.report.blocks import block
from grader.report.blocks import roots
from grader.report.model import Report
from grader.report.page import Page
from grader.report.plain import first_lines
from grader.report.plain import one_line

WIDTH = 100  # columns
LINES = 12  # of one text


def check_text(mark: Mark, report: Report, *, lines: int = LINES) -> str:
    """Return all that is known of a check, without control characters, ended by a newline."""
    check = mark.check
    if check.status == "passed":
        told = [line for advice in check.advice for line in first_lines(advice, lines=lines)]
    elif check.status == "skipped":
        told = [_skipped(mark, report)]
    else:
        page = Page(width=WIDTH, styled=False)
        block(page, check, lines=lines)
        told = str(page).rstrip("\n").split("\n")
    told += [mark.correction] if mark.correction else []
    return "".join(f"{line}\n" for line in told or ["Passed."])


def headline(mark: Mark) -> str:
    """Return what was found in one line: a failed check's `actual`, else its state."""
    check = mark.check
    found = one_line(check.actual) if check.status == "failed" else ""
    return found or WORDS[check.status]


def _skipped(mark: Mark, report: Report) -> str:
    """Say why it was not asked; a check that is not shown is not named to who may see this one."""
    names = [
        one_line(other.id, most=60)
        if other.visibility == "visible" or mark.check.visibility != "visible"
        else UNSEEN
        for other in roots(mark.check, report.checks)
    ]
    known = " and ".join(dict.fromkeys(names))
    return f"Not asked because {known} did not pass." if known else one_line(mark.check.actual)
