"""What GitHub Classroom's reporter reads: `<STEP-ID>_RESULTS`, JSON in base64.

By autograding-grading-reporter/src: the notice for the classroom and the table both add up
`tests[].score`, against the runner's `max_score`; a result without tests counts nothing. Every
point that is taken or given after the checks is therefore a test of its own.
"""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Sequence
from typing import Any

from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from grader.base.plain_text import one_line, points
from grader.batch.check_text import check_text, headline
from grader.batch.model import GradebookEntry
from grader.batch.points import Mark, adjustments, marks, rounded
from grader.report.model import Report

UNSEEN = say("Hidden checks")
SUBMISSION = say("The submission")
# the reporter prints what it gets, and GitHub's runner obeys printed lines (actions/runner,
# ActionCommand.cs): `::command` after blanks, `##[command]` anywhere
COMMAND = re.compile(r"^(\s*:)(?=:)|(##)(?=\[)", re.MULTILINE)


def results(entry: GradebookEntry, *, show_hidden: bool = False) -> dict[str, Any]:
    """Return the runner's result; hidden checks are one test (the log is the student's to read)."""
    report, translate = entry.report, Translator(entry.lang)
    if report is None or entry.final is None:
        nothing = say("There are no points yet.")
        message = entry.problem or (report.message if report else "") or nothing
        tests = [_line(translate(SUBMISSION), 0, "error", one_line(translate(message)))]
        return _result("error", entry, tests)
    shown = [m for m in marks(entry) if show_hidden or m.check.visibility == "visible"]
    hidden = [m for m in marks(entry) if m not in shown]
    tests = [
        _line(_name(mark, report), mark.points or 0, _status(mark), check_text(mark, report))
        for mark in shown
    ]
    if hidden:
        tests.append(_hidden(hidden, translate))
    for adjustment in adjustments(entry):
        tests.append(
            _line(
                translate(adjustment.why),
                adjustment.points,
                "pass" if adjustment.points > 0 else "fail",
            )
        )
    if not tests:
        tests = [_line(translate(SUBMISSION), entry.final, "pass")]
    states = {test["status"] for test in tests}
    worst = next((state for state in ("error", "fail") if state in states), "pass")
    return _result(worst, entry, tests)


def encoded(found: dict[str, Any]) -> str:
    """Return the value of the variable."""
    return base64.b64encode(json.dumps(found, allow_nan=False).encode()).decode("ascii")


def github_output(found: dict[str, Any]) -> str:
    """Return the line for the file `$GITHUB_OUTPUT`, by which a step hands its `result` on."""
    return f"result={encoded(found)}\n"


def variable(step: str) -> str:
    """Return the name of the reporter's variable for the step (the runner) of this id."""
    return f"{step.strip().upper()}_RESULTS"


def _result(status: str, entry: GradebookEntry, tests: list[dict[str, Any]]) -> dict[str, Any]:
    return {"version": 1, "status": status, "max_score": rounded(entry.max_score), "tests": tests}


def _line(name: str, score: float, status: str, message: str = "") -> dict[str, Any]:
    return {
        "name": _inert(name),
        "status": status,
        "message": _inert(message.strip()),
        "line_no": 0,
        "test_code": "",
        "execution_time": "0ms",
        "score": rounded(score),
    }


def _inert(text: str) -> str:
    """Return a text that is no command to GitHub's runner, whichever line of a log it is in."""
    return COMMAND.sub(lambda found: f"{found[0]} ", text)


def _name(mark: Mark, report: Report) -> str:
    check = mark.check
    given = "-" if mark.points is None else points(mark.points)
    name = f"{one_line(check.id, most=60)} ({given}/{points(check.max_score)})"
    return name if mark.passed else f"{name}: {headline(mark, report)}"


def _status(mark: Mark) -> str:
    if mark.points is None:
        return "error"
    return "pass" if mark.passed else "fail"


def _hidden(hidden: Sequence[Mark], translate: Translator) -> dict[str, Any]:
    given = sum(mark.points or 0 for mark in hidden)
    most = sum(mark.check.max_score for mark in hidden)
    status = "pass" if all(mark.passed for mark in hidden) else "fail"
    return _line(f"{translate(UNSEEN)} ({points(given)}/{points(most)})", given, status)
