"""The reports of one submission on several distros side by side: `matrix.json`, schema 1.

It contains what can differ between distros; everything else is in the reports, whose paths it
gives relative to `matrix.json`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from pydantic import ConfigDict, Field

from grader.base.part import Part
from grader.report.model import (
    AssignmentInfo,
    CheckStatus,
    Mistake,
    Report,
    SubmissionInfo,
    Visibility,
)


class _Part(Part):
    model_config = ConfigDict(populate_by_name=True)


class Cell(_Part):
    """The result of one check on one distro."""

    status: CheckStatus
    score: float
    max_score: float
    mistakes: list[Mistake]


class CheckAcross(_Part):
    """One check on the distros that have it; `differs` if not all verdicts are equal.

    Verdicts are equal if status, score and the ids of the mistakes are.
    """

    id: str
    title: str
    visibility: Visibility
    differs: bool
    distros: dict[str, Cell]


class Total(_Part):
    """The total on one distro, and the path of its report."""

    status: Literal["graded", "error"]
    message: str
    score: float
    max_score: float
    inconclusive: float
    report: str


class Matrix(_Part):
    """One submission on several distros."""

    schema_: Literal[1] = Field(default=1, alias="schema")
    assignment: AssignmentInfo
    submission: SubmissionInfo
    distros: dict[str, Total]
    checks: list[CheckAcross]


def matrix_of(reports: Sequence[Report]) -> Matrix:
    """Combine the reports of one submission, in their order.

    ValueError if there is none, if they are of different submissions, or two are of one distro.
    """
    if not reports:
        raise ValueError("a matrix needs at least one report")
    if len({report.submission.path for report in reports}) > 1:
        raise ValueError("a matrix is of one submission, these reports are of several")
    by_distro = {report.environment.distro: report for report in reports}
    if len(by_distro) < len(reports):
        raise ValueError("a matrix has one report of each distro, these reports repeat one")
    return Matrix(
        assignment=reports[0].assignment,
        submission=reports[0].submission,
        distros={
            distro: Total(
                status=report.status,
                message=report.message,
                score=report.score,
                max_score=report.max_score,
                inconclusive=report.inconclusive,
                report=f"{distro}/report.json",
            )
            for distro, report in by_distro.items()
        },
        checks=[_across(check_id, by_distro) for check_id in _ids(reports)],
    )


def _ids(reports: Sequence[Report]) -> list[str]:
    return list(dict.fromkeys(check.id for report in reports for check in report.checks))


def _across(check_id: str, by_distro: dict[str, Report]) -> CheckAcross:
    found = {
        distro: check
        for distro, report in by_distro.items()
        for check in report.checks
        if check.id == check_id
    }
    first = next(iter(found.values()))
    verdicts = {
        (check.status, check.score, tuple(mistake.id for mistake in check.mistakes))
        for check in found.values()
    }
    hidden = [c.visibility for c in found.values() if c.visibility != "visible"]
    return CheckAcross(
        id=check_id,
        title=first.title,
        visibility=hidden[0] if hidden else "visible",
        differs=len(verdicts) > 1 or len(found) < len(by_distro),
        distros={
            distro: Cell(
                status=check.status,
                score=check.score,
                max_score=check.max_score,
                mistakes=check.mistakes,
            )
            for distro, check in found.items()
        },
    )
