"""Gradescope's `results.json` (autograder_samples/docs/specs.md) for one report.

Gradescope decides who sees a test with the visibility `hidden` or `after_due_date`; the text above
the tests and the other tests never name it.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from datetime import datetime, timezone
from typing import Any

from grader.base.i18n.message import say
from grader.base.i18n.translator import SOURCE, Translator
from grader.base.plain_text import first_lines, one_line, points
from grader.batch.check_text import check_text
from grader.batch.model import GradebookEntry, Override
from grader.batch.points import Mark, adjustments, in_points, marks, rounded, single
from grader.report.detail import IN_FILES, Detail
from grader.report.feedback import with_feedback
from grader.report.model import Report

MOST = 200  # characters of a name


def results(
    report: Report,
    *,
    penalty: float = 0,
    overrides: Sequence[Override] = (),
    now: datetime | None = None,
) -> dict[str, Any]:
    """Return the results for a report; `penalty` are the points taken for lateness.

    `now` (default: the present) decides what students get to know of a failed check.
    """
    entry = single(for_gradescope(report, now), penalty=penalty, overrides=overrides)
    return {
        "score": entry.final or 0.0,
        "execution_time": round(report.timing.total, 3),
        "output": _output(entry, report),
        "output_format": "text",
        "test_output_format": "text",
        "test_name_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "extra_data": _extra(report),
        "tests": [_test(mark, report) for mark in marks(entry)],
    }


def for_gradescope(report: Report, now: datetime | None = None) -> Report:
    """Return a report as Gradescope may show it.

    Gradescope shows a test with the visibility `after_due_date` when its own due date has passed,
    and one that is `hidden` to instructors only: they keep what they have.
    """
    rules, due = report.assignment.feedback, report.assignment.due
    now = now or datetime.now(timezone.utc)
    after = IN_FILES[rules.after_due]
    levels = {"hidden": Detail.LINE, "after_due_date": after}
    of = {c.id: levels[c.visibility] for c in report.checks if c.visibility in levels}
    return with_feedback(report, rules.handed_back(due, now), of=of)


def results_json(found: dict[str, Any]) -> str:
    r"""Return results as ASCII text with `\n` line ends."""
    return json.dumps(found, indent=1, allow_nan=False) + "\n"


def problem(text: str, *, total: float = 0, lang: str = SOURCE) -> dict[str, Any]:
    """Return results without points that show `text` to the student."""
    translate = Translator(lang)
    output = "\n".join(first_lines(translate(text), lines=20))
    found: dict[str, Any] = {"score": 0.0, "output": output, "output_format": "text"}
    name = translate(say("The grader"))
    tests = [{"name": name, "score": 0.0, "output": output, "status": "failed"}]
    tests[0] |= {"max_score": total} if total else {}
    return {**found, "visibility": "visible", "stdout_visibility": "hidden", "tests": tests}


def _test(mark: Mark, report: Report) -> dict[str, Any]:
    check = mark.check
    test: dict[str, Any] = {
        "name": f"{one_line(check.id, most=60)}: {one_line(check.title, most=MOST)}",
        "name_format": "text",
        "score": mark.points or 0.0,
        "max_score": rounded(check.max_score),
        "output": check_text(mark, report),
        "output_format": "text",
        "visibility": check.visibility,
        "extra_data": {"check": check.id, "status": check.status},
    }
    if mark.points is not None:  # without it the check is neither passed nor failed
        test["status"] = "passed" if mark.passed else "failed"
    return test


def _output(entry: GradebookEntry, report: Report) -> str:
    final, most = points(entry.final or 0), points(report.max_score)
    lines: list[str] = [say("{points} of {most} points", points=final, most=most)]
    if report.status == "error":
        lines = [say("The grader failed, not your package. Please tell your instructor.")]
    open_ = sum(mark.check.max_score for mark in marks(entry) if mark.points is None)
    if open_:
        lines.append(say("{points} could be neither given nor taken.", points=in_points(open_)))
    lines += [adjustment.text for adjustment in adjustments(entry)]
    lines += [line for note in report.submission.notes for line in first_lines(note, lines=3)]
    if report.observed.command:
        command = one_line(report.observed.command, most=1_000)
        lines.append(say("Run with: {command}", command=command))
    translate = Translator(report.lang)
    return "".join(f"{translate(line)}\n" for line in lines)


def _extra(report: Report) -> dict[str, Any]:
    """Return what identifies the report; Gradescope stores it with the submission."""
    return {
        "report": {
            "schema": report.schema_,
            "assignment": report.assignment.id,
            "assignment_sha256": report.assignment.sha256,
            "submission_sha256": report.submission.sha256,
            "distro": report.environment.distro,
            "grader": report.environment.grader,
            "started": report.started,
        }
    }
