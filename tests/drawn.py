"""One package run again and again with other drawn values: it is built once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from grader.base.i18n.translator import Translator
from grader.course.assignment import Assignment
from grader.course.draw import Values
from grader.package.submission import Submission
from grader.report.model import CheckResult
from grader.ros.distro import find_distro
from grader.run.session import Session
from grader.run.workspace import save
from grader.sandbox.choose import open_sandbox
from grader.verdict.evaluate import evaluate_checks
from grader.verdict.evidence import Evidence
from tests.marking import LIMITS

SECONDS = 3_600.0  # for all runs together


def results_over(
    submission: Submission, assignment: Assignment, draws: Iterable[Values]
) -> Iterator[tuple[Values, dict[str, CheckResult]]]:
    """Yield the results of the checks for each draw, by their ids."""
    distro = find_distro("jazzy")
    limits = LIMITS.override(assignment.limits)
    sandbox = open_sandbox("bubblewrap", distro, limits, interfaces=assignment.interfaces)
    deadline = sandbox.run_clock.now() + SECONDS
    with Session(sandbox, assignment.on(distro), deadline=deadline) as session:
        built = session.build(submission)
        session._built = save(sandbox)
        for values in draws:
            drawn = assignment.with_drawn(values).on(distro)
            evidence = Evidence(
                drawn,
                submission,
                build=lambda: built,
                run=lambda: session.run(lambda _: None),
                run_of=lambda plan: session.run_plan(plan, lambda _: None),
            )
            evidence.distro = distro
            for _ in evaluate_checks(evidence, Translator("en")):
                pass
            yield values, evidence.results


def solution(lesson: str, root: Path) -> Path:
    """Return the folder of a lesson's solution."""
    return root / "grader" / "keys" / lesson / "solution"
