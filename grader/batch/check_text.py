"""A check as plain text, which systems show below a test's name, in the report's language."""

from __future__ import annotations

from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from grader.base.plain_text import first_lines, one_line
from grader.batch.points import Mark
from grader.report.blocks import UNSEEN, WORDS, all_of, block, roots
from grader.report.model import Report

WIDTH = 100  # columns
LINES = 12  # of one text


def check_text(mark: Mark, report: Report, *, lines: int = LINES) -> str:
    """Return everything about a check, without control characters, ending with a newline."""
    check, translate = mark.check, Translator(report.lang)
    if check.status == "passed":
        text = [line for advice in check.advice for line in first_lines(advice, lines=lines)]
    elif check.status == "skipped":
        text = [translate(_skipped(mark, report))]
    else:
        from grader.report.page import Page  # noqa: PLC0415 - slow, and rarely needed

        page = Page(width=WIDTH, styled=False, translate=translate)
        block(page, check, lines=lines)
        text = str(page).rstrip("\n").split("\n")
    text += [translate(mark.correction)] if mark.correction else []
    return "".join(f"{line}\n" for line in text or [translate(say("Passed."))])


def headline(mark: Mark, report: Report) -> str:
    """Return the outcome in one line: a failed check's `actual`, or the state."""
    check = mark.check
    found = one_line(check.actual) if check.status == "failed" else ""
    return found or Translator(report.lang)(WORDS[check.status])


def _skipped(mark: Mark, report: Report) -> str:
    """Return why a check was skipped; a visible check does not name a hidden one."""
    names = [
        one_line(other.id, most=60)
        if other.visibility == "visible" or mark.check.visibility != "visible"
        else UNSEEN
        for other in roots(mark.check, report.checks)
    ]
    if not names:
        return one_line(mark.check.actual)
    return say("Not run because {checks} did not pass.", checks=all_of(names))
