"""Results for GitHub Classroom's reporter: `<STEP-ID>_RESULTS`, JSON in base64.

By autograding-grading-reporter/src: the notice for the classroom and the table both add up
`tests[].score`, out of the runner's `max_score`; a result without tests counts nothing. So every
adjustment after the checks is a test of its own.
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
# the reporter prints these texts, and GitHub's runner executes commands in printed lines
# (actions/runner, ActionCommand.cs): `::command` after spaces, `##[command]` anywhere
COMMAND = re.compile(r"^(\s*:)(?=:)|(##)(?=\[)", re.MULTILINE)


def results(entry: GradebookEntry, *, show_hidden: bool = False) -> dict[str, Any]:
    """Return the runner's result; hidden checks are one test, because students can read the log."""
    report, translate = entry.report, Translator(entry.lang)
    if report is None or entry.final is None:
        nothing = say("There are no points yet.")
        message = entry.problem or (report.message if report else "") or nothing
        tests = [_test(translate(SUBMISSION), 0, "error", one_line(translate(message)))]
        return _result("error", entry, tests)
    shown = [m for m in marks(entry) if show_hidden or m.check.visibility == "visible"]
    hidden = [m for m in marks(entry) if m not in shown]
    tests = [
        _test(_name(mark, report), mark.points or 0, _status(mark), check_text(mark, report))
        for mark in shown
    ]
    if hidden:
        tests.append(_hidden(hidden, translate))
    for adjustment in adjustments(entry):
        status = "pass" if adjustment.points > 0 else "fail"
        tests.append(_test(translate(adjustment.why), adjustment.points, status))
    if not tests:
        tests = [_test(translate(SUBMISSION), entry.final, "pass")]
    states = {test["status"] for test in tests}
    worst = next((state for state in ("error", "fail") if state in states), "pass")
    return _result(worst, entry, tests)


def encoded(found: dict[str, Any]) -> str:
    """Return the value of the reporter's variable."""
    return base64.b64encode(json.dumps(found, allow_nan=False).encode()).decode("ascii")


def github_output(found: dict[str, Any]) -> str:
    """Return the line for the file `$GITHUB_OUTPUT` that sets the step's `result`."""
    return f"result={encoded(found)}\n"


def variable(step: str) -> str:
    """Return the name of the reporter's variable for the step with this id."""
    return f"{step.strip().upper()}_RESULTS"


def _result(status: str, entry: GradebookEntry, tests: list[dict[str, Any]]) -> dict[str, Any]:
    return {"version": 1, "status": status, "max_score": rounded(entry.max_score), "tests": tests}


def _test(name: str, score: float, status: str, message: str = "") -> dict[str, Any]:
    return {
        "name": _escaped(name),
        "status": status,
        "message": _escaped(message.strip()),
        "line_no": 0,
        "test_code": "",
        "execution_time": "0ms",
        "score": rounded(score),
    }


def _escaped(text: str) -> str:
    """Return a text without commands for GitHub's runner."""
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
    return _test(f"{translate(UNSEEN)} ({points(given)}/{points(most)})", given, status)
