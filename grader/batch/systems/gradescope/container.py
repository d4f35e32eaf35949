"""Marks a submission inside Gradescope's container and keeps `results.json` up to date.

Gradescope reads the file when the autograder ends or runs out of time. So it is written before the
first check and replaced atomically after each one. The grader never reads it.
"""

from __future__ import annotations

import contextlib
import json
import os
import sys
import traceback
from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path
from typing import Any

import click

from grader.base.errors import GraderError
from grader.base.folder import Folder
from grader.base.i18n.message import joined, say
from grader.base.i18n.translator import Translator, chosen_language
from grader.base.plain_text import one_line
from grader.batch.policy import penalty
from grader.batch.systems.gradescope import write as gradescope
from grader.course.assignment import Assignment
from grader.report import events
from grader.report.blocks import UNSEEN
from grader.report.model import CheckResult, Report
from grader.verdict.mark import grade
from grader.verdict.order import Order, make_orders

RESULTS = "results.json"
METADATA = "submission_metadata.json"
CLONED = ("GitHub", "Bitbucket")
MOST_METADATA = 10_000_000  # bytes; it contains earlier results
OUR_FAULT = say(
    "The grader failed, not your package. Please tell your instructor: the reason is in the "
    "output that instructors see."
)


@dataclass
class ResultsFile:
    """Keeps `results.json` up to date while a submission is marked."""

    folder: Path
    order: Order
    extra: dict[str, Any]
    finished: list[CheckResult] = field(default_factory=list)

    def __call__(self, event: events.Event) -> None:
        """Add a finished check and write the file again."""
        if isinstance(event, events.CheckFinished):
            self.finished.append(event.result)
            self.write(self._so_far())

    def start(self) -> None:
        """Write the file that counts if no check ever finishes."""
        self.write(self._so_far())

    def write(self, found: dict[str, Any]) -> None:
        """Replace the file, which belongs to root, in a folder that others cannot write to."""
        found = {**found, "extra_data": {**found.get("extra_data", {}), **self.extra}}
        self.folder.mkdir(parents=True, exist_ok=True)
        with Folder.open(self.folder) as folder:
            folder.close_to_others()
            folder.replace(RESULTS, gradescope.results_json(found).encode("ascii"))

    def failed(self) -> None:
        """Write that the grader failed, together with the results so far."""
        found, fault = self._so_far(), Translator(self.order.lang)(OUR_FAULT)
        self.write({**found, "output": f"{fault}\n{found['output']}"})

    def _so_far(self) -> dict[str, Any]:
        """Return the results of the checks that have finished."""
        assignment = self.order.assignment
        finished = {result.id for result in self.finished}
        report = _empty_report(self.order)
        report = report.model_copy(
            update={"checks": list(self.finished), "score": sum(r.score for r in self.finished)}
        )
        left = [use for use in assignment.checks if use.id not in finished]
        names = [use.id if use.visibility == "visible" else UNSEEN for use in left]
        found = gradescope.results(report)
        lang = self.order.lang
        tests = found["tests"] or gradescope.problem(OUR_FAULT, lang=lang)["tests"]
        if not names:
            return {**found, "tests": tests}
        cut_off = say(
            "Marking was cut off here. These checks have not run yet: {checks}",
            checks=joined(*dict.fromkeys(names), by=", "),
        )
        output = f"{found['output']}{Translator(lang)(cut_off)}\n"
        return {**found, "output": output, "tests": tests}


def run(
    autograder: Path,
    *,
    assignment: str | None = None,
    keys: Path | None = None,
    distro: str = "jazzy",
    sandbox: str = "account",
    lang: str | None = None,
) -> int:
    """Mark `<autograder>/submission`; return 0 for a verdict, 3 if the grader failed.

    `results/results.json` is written in each case. `lang` is the language of what the student reads
    (default: the environment's).
    """
    results = autograder / "results"
    metadata = read_metadata(autograder / METADATA)
    try:
        order = order_for(autograder, metadata, assignment, distro, sandbox, keys=keys, lang=lang)
    except GraderError as error:
        click.echo(f"grader: {error}", err=True)
        _write_problem(results, lang or chosen_language(os.environ))
        return error.exit_status
    file = ResultsFile(results, order, _extra(metadata))
    file.start()
    try:
        report = grade(order, file)
        file.write(gradescope.results(report, penalty=late_points(report, metadata, order)))
    except GraderError as error:
        click.echo(f"grader: {error}", err=True)
        file.failed()
        return 3
    except (
        Exception
    ):  # a fault of the grader: the instructor sees the trace, the student only OUR_FAULT
        traceback.print_exc(file=sys.stderr)
        file.failed()
        return 3
    click.echo(f"{order.name or 'the submission'}: {report.score:g} of {report.max_score:g} points")
    return 0


def read_metadata(path: Path) -> dict[str, Any]:
    """Return Gradescope's `submission_metadata.json`, {} if there is no readable one."""
    with contextlib.suppress(OSError, ValueError, RecursionError):
        if path.stat().st_size <= MOST_METADATA:
            found = json.loads(path.read_bytes())
            return found if isinstance(found, dict) else {}
    return {}


def student_name(metadata: dict[str, Any]) -> str | None:
    """Return the names of the submitters, None if the metadata has none."""
    users = metadata.get("users")
    named = [u.get("name") for u in users if isinstance(u, dict)] if isinstance(users, list) else []
    names = [one_line(name, most=60) for name in named if isinstance(name, str) and name.strip()]
    return ", ".join(names) or None


def order_for(
    autograder: Path,
    metadata: dict[str, Any],
    assignment: str | None,
    distro: str,
    sandbox: str,
    *,
    keys: Path | None = None,
    lang: str | None = None,
) -> Order:
    """Return the order to mark Gradescope's submission."""
    submission = autograder / "submission"
    name = student_name(metadata)
    order = make_orders(
        submission, assignment, distro, sandbox, (), name=name, keys=keys, lang=lang
    )[0]
    dated = _with_due_date(order.assignment, metadata)
    # uploaded files have lost their exec bits, a clone has not
    cloned = metadata.get("submission_method") in CLONED
    return replace(order, assignment=dated, modes_kept=cloned)


def _with_due_date(assignment: Assignment, metadata: dict[str, Any]) -> Assignment:
    """Return the assignment with Gradescope's due date if its policy has none."""
    theirs = metadata.get("assignment")
    due = _instant(theirs.get("due_date")) if isinstance(theirs, dict) else None
    if assignment.policy.due is not None or due is None or due.tzinfo is None:
        return assignment
    policy = assignment.policy.model_copy(update={"due": due})
    return assignment.model_copy(update={"policy": policy})


def _instant(text: object) -> datetime | None:
    try:
        return datetime.fromisoformat(str(text).replace("Z", "+00:00"))
    except ValueError:
        return None


def late_points(report: Report, metadata: dict[str, Any], order: Order) -> float:
    """Return the points that the policy takes for lateness, by Gradescope's time stamp."""
    submitted = _instant(metadata.get("created_at"))
    if submitted is None or submitted.tzinfo is None:
        return 0
    return penalty(report.score, report.max_score, submitted, order.assignment.policy)


def _extra(metadata: dict[str, Any]) -> dict[str, Any]:
    known = {name: metadata.get(name) for name in ("id", "created_at")}
    kept = {name: value for name, value in known.items() if isinstance(value, str | int)}
    return {"submission": kept} if kept else {}


def _write_problem(results: Path, lang: str) -> None:
    results.mkdir(parents=True, exist_ok=True)
    with Folder.open(results) as folder:
        text = gradescope.results_json(gradescope.problem(OUR_FAULT, lang=lang))
        folder.replace(RESULTS, text.encode("ascii"))


def _empty_report(order: Order) -> Report:
    """Return the report of a submission before its first check."""
    assignment = order.assignment
    return Report.model_validate(
        {
            "assignment": {
                "id": assignment.id,
                "title": assignment.title,
                "sha256": assignment.sha256,
                "due": assignment.policy.deadline,
                "feedback": assignment.feedback,
            },
            "submission": {"name": order.name or "", "path": "", "sha256": ""},
            "environment": {"distro": order.distro.name, "ros": "wheels", "sandbox": "account"},
            "status": "graded",
            "lang": order.lang,
            "score": 0,
            "max_score": assignment.max_score,
            "checks": [],
            "started": "",
        }
    )
