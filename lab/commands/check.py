"""`lab check`: the instructor's checks, and the result in the student's progress."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.i18n.message import msg
from grader.cli import options

if TYPE_CHECKING:
    from grader.report.model import Report
    from lab.guide.progress import FailedCheck


@click.command(
    help=msg(
        "Run your instructor's checks on your package: the same verdict, by the visible checks. The "
        "result is kept in your own workspace."
    )
)
@click.argument("path", type=click.Path(path_type=Path), required=False)
@options.assignment
@click.option("--distro", metavar="NAME", help=msg("The ROS 2 distro (default: this terminal's)."))
@options.sandbox
@options.limits
@options.lang
@click.option("--explain", is_flag=True, help=msg("Show everything about each failure at once."))
@options.verbose
def check(
    path: Path | None,
    assignment: str | None,
    distro: str | None,
    sandbox: str,
    limits: tuple[str, ...],
    lang: str | None,
    explain: bool,
    verbose: bool,
) -> int:
    """Run the checks and keep the result."""
    from grader.cli.check import Hints, check_own  # noqa: PLC0415 - keeps --help fast
    from grader.ros.distro import DEFAULT  # noqa: PLC0415

    named = distro or os.environ.get("ROS_DISTRO") or DEFAULT
    return check_own(
        path,
        assignment,
        named,
        sandbox,
        limits,
        lang,
        verbose=verbose,
        hints=Hints(explain=explain, command="lab hint"),
        heard=keep_result,
    )


def keep_result(report: Report) -> None:
    """Keep a report's score and first failure in the progress, if it is of the lab's lesson."""
    from lab.guide.opened import opened_lab  # noqa: PLC0415 - keeps --help fast
    from lab.guide.progress import now  # noqa: PLC0415

    lab = opened_lab()
    if report.assignment.id == lab.assignment.id:
        passed = report.all_passed or lab.progress().passed
        lab.keep(
            score=report.score,
            max_score=report.max_score,
            passed=passed,
            checked=now(),
            failed=_first_failure(report),
        )


def _first_failure(report: Report) -> FailedCheck | None:
    """Return what a student may know of the failure to look at first, hint by hint."""
    from grader.report.detail import HINTS  # noqa: PLC0415 - keeps --help fast
    from grader.report.feedback import first_failure, for_lab  # noqa: PLC0415
    from lab.guide.found import CHANGED  # noqa: PLC0415
    from lab.guide.progress import FailedCheck  # noqa: PLC0415

    seen = for_lab(report, report.assignment.feedback, hints=HINTS)
    check = first_failure(seen.checks)
    if check is None:
        return None
    place = check.where.file if check.where is not None else ""
    if check.where is not None and check.where.line:
        place = f"{place}:{check.where.line}"
    found = check.actual.partition("\n")[0] or check.title
    changed = "\n".join(CHANGED.findall(check.patch))
    return FailedCheck(
        id=check.id,
        found=f"{check.id}: {found}" + (f" ({place})" if place else ""),
        hints=[text for text in (check.rationale, check.fix, changed) if text],
    )
