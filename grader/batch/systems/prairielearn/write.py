"""PrairieLearn's `/grade/results/results.json` (docs/externalGrading.md).

An unreadable submission is not gradable, so the student loses no attempt. The file may have at most
1 MB: texts are shortened step by step until it fits; points are always complete.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from grader.base.plain_text import first_lines, last_lines, one_line, points, shorten
from grader.batch.check_text import check_text
from grader.batch.model import GradebookEntry
from grader.batch.points import Mark, adjustments, marks, rounded
from grader.report.blocks import UNSEEN
from grader.report.model import Report
from grader.report.tracebacks import folded

MOST_BYTES = 1_000_000
# from generous to strict, the first that fits is used: check_lines, log_lines, check_characters
TEXT_LIMITS = ((12, 400, 100_000), (12, 60, 8_000), (6, 20, 2_000), (2, 0, 300), (1, 0, 0))
MOST_NAME = 200


@dataclass(frozen=True)
class TextLimits:
    """The lines of each text of a check, lines of the output, and characters of each check."""

    check_lines: int
    log_lines: int
    check_characters: int


def results(entry: GradebookEntry, *, show_hidden: bool = False) -> dict[str, Any]:
    """Return the results of an entry; hidden checks have points but no name or text."""
    for limits in TEXT_LIMITS:
        found = _results(entry, TextLimits(*limits), show_hidden=show_hidden)
        if len(results_json(found)) <= MOST_BYTES:  # ASCII: characters are bytes
            break
    return found


def results_json(found: dict[str, Any]) -> str:
    """Return results as the text of the file."""
    return json.dumps(found, allow_nan=False) + "\n"


def _results(entry: GradebookEntry, limits: TextLimits, *, show_hidden: bool) -> dict[str, Any]:
    report = entry.report
    if report is None or entry.status in ("ungradable", "error") or entry.final is None:
        return _ungradable(entry)
    most = entry.max_score
    score = min(max(entry.final / most, 0.0), 1.0) if most > 0 else 0.0
    return {
        "gradable": True,
        "score": rounded(score),
        "message": _message(entry),
        "output": _output(report, limits.log_lines, Translator(entry.lang)),
        "images": [],
        "tests": [
            _test(mark, report, limits, show=show_hidden or mark.check.visibility == "visible")
            for mark in marks(entry)
        ],
    }


def _ungradable(entry: GradebookEntry) -> dict[str, Any]:
    message = entry.report.message if entry.report is not None else ""
    why = entry.problem or message or say("The submission could not be graded.")
    text = "\n".join(first_lines(Translator(entry.lang)(why), lines=10))
    return {"gradable": False, "format_errors": [text], "message": text, "tests": []}


def _message(entry: GradebookEntry) -> str:
    final, most = points(entry.final or 0), points(entry.max_score)
    lines = [say("{points} of {most} points", points=final, most=most)]
    lines += [adjustment.text for adjustment in adjustments(entry)]
    return "\n".join(Translator(entry.lang)(line) for line in lines)


def _output(report: Report, lines: int, translate: Translator) -> str:
    if not lines:
        return ""
    found = []
    for title, text in (
        (say("What colcon build printed"), report.evidence.build_log),
        (say("What ros2 run printed"), report.evidence.transcript),
    ):
        if text.strip():
            shown, _ = last_lines(folded(text, translate=translate), lines=lines)
            found += [f"{translate(title)}:", *shown, ""]
    return "\n".join(found)


def _test(mark: Mark, report: Report, limits: TextLimits, *, show: bool) -> dict[str, Any]:
    check, translate = mark.check, Translator(report.lang)
    test: dict[str, Any] = {
        "name": one_line(check.id, most=60) if show else translate(UNSEEN),
        "description": one_line(check.title, most=MOST_NAME) if show else "",
        "points": mark.points or 0.0,
        "max_points": rounded(check.max_score),
    }
    if mark.points is None:
        test["message"] = translate(say("These points could be neither given nor taken."))
    elif mark.correction and show:
        test["message"] = translate(mark.correction)
    if show:
        text = check_text(mark, report, lines=limits.check_lines)
        test["output"] = (
            shorten(text, most=limits.check_characters) if limits.check_characters else ""
        )
    return test
