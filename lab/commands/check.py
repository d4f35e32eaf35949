"""`lab check`: the instructor's checks, and the result in the student's progress."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.i18n.message import msg, say
from grader.cli import options

if TYPE_CHECKING:
    from grader.report.model import Report
    from grader.report.one_screen import State
    from lab.guide.opened import OpenedLab
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
    """Run the checks and keep the result.

    They build the package anew, so whether the student's own build can run here is said below.
    """
    from grader.cli.check import Hints, check_own  # noqa: PLC0415 - keeps --help fast
    from grader.ros.distro import DEFAULT  # noqa: PLC0415
    from lab.other_ros import say_other_ros  # noqa: PLC0415

    named = distro or os.environ.get("ROS_DISTRO") or DEFAULT
    status = check_own(
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
    if status in (0, 1):  # there is a verdict
        say_other_ros(lang)
    return status


def keep_result(report: Report) -> State | None:
    """Keep a report's score and first failure in the progress, if it is of the lab's work.

    Return what the guide says now: the page begins with the same.
    """
    from grader.report.one_screen import State  # noqa: PLC0415 - keeps --help fast
    from lab.guide.opened import opened_lab  # noqa: PLC0415
    from lab.guide.progress import now  # noqa: PLC0415

    lab = opened_lab(report.lang)
    place = Path(report.submission.path).resolve()
    is_own = place.is_relative_to(lab.workspace.resolve())
    if not is_own or report.assignment.id != lab.assignment.id:
        return None
    passed = report.all_passed or lab.progress().passed
    lab.keep(
        score=report.score,
        max_score=report.max_score,
        passed=passed,
        checked=now(),
        sha256=report.submission.sha256,
        all_passed=report.all_passed,
        failed=_first_failure(report, lab),
    )
    task = lab.task(os.environ, look=True)
    if task.action is None:
        return None
    failed = lab.progress().failed
    is_told = failed is not None and task.action.found == failed.found  # (by the check itself)
    found = "" if is_told else task.action.found
    return State(next=task.action.next, found=found, of_first=task.of_check)


def _first_failure(report: Report, lab: OpenedLab) -> FailedCheck | None:
    """Return what a student may know of the failure to look at first, hint by hint."""
    from grader.report.detail import HINTS  # noqa: PLC0415 - keeps --help fast
    from grader.report.feedback import first_failure, for_lab  # noqa: PLC0415
    from lab.guide.found import difference, hints_in  # noqa: PLC0415
    from lab.guide.progress import FailedCheck  # noqa: PLC0415

    seen = for_lab(report, report.assignment.feedback, hints=HINTS)
    check = first_failure(seen.checks)
    if check is None:
        return None
    file = check.where.file if check.where is not None else ""
    line = check.where.line if check.where is not None else None
    place = f"{file}:{line}" if line else file
    first, *more = check.actual.split("\n") if check.actual else [check.title]
    if len(check.mistakes) > 1 and more:  # the cause stands below what was seen of it
        first = f"{first}: {more[0]}"
    elif check.actual and (wanted := check.expected.partition("\n")[0]):  # nothing else explains it
        first = lab.translate(say("{found}; expected: {expected}", found=first, expected=wanted))
    kinds = {use.id: use.kind for use in lab.assignment.checks}
    return FailedCheck(
        id=check.id,
        found=f"{check.id}: {first}" + (f" ({place})" if place else ""),
        kind=kinds.get(check.id, check.id),
        mistake=check.mistakes[0].id if check.mistakes else "",
        file=file,
        line=line or 0,
        hints=list(hints_in(check)),
        difference=difference(check) if check.actual else "",
    )
