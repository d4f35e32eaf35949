"""Takes in what an assignment asks for: its package, and the packages beside it."""

from __future__ import annotations

from pathlib import Path

from grader.course.assignment import Assignment
from grader.package.submission import Submission, take_in


def take_in_for(
    assignment: Assignment,
    path: Path,
    *,
    name: str | None = None,
    modes_kept: bool = True,
    at_work: bool = False,
) -> Submission:
    """Take in a submission for an assignment; see `take_in`."""
    return take_in(
        path,
        package=assignment.package,
        node_file=assignment.node_file,
        others=assignment.others,
        name=name,
        modes_kept=modes_kept,
        at_work=at_work,
    )
