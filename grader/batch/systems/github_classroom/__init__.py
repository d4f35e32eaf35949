"""GitHub Classroom: its clones, and the results for its reporter."""

from __future__ import annotations

from collections.abc import Sequence

from grader.batch.points import single
from grader.batch.sheet import Sheet
from grader.batch.systems.github_classroom import read, write
from grader.batch.systems.system import Download, RosterForm, RosterKey, System
from grader.report.feedback import handed_back
from grader.report.model import Report


def _roster_key(_sheet: Sheet, header: Sequence[str]) -> RosterKey | None:
    for name in ("identifier", "roster identifier"):  # in the roster, and in the grades
        if name in header and "github username" in header:
            return RosterKey(header.index(name))
    return None


def _github(report: Report, show_hidden: bool) -> str:
    seen = handed_back(report, show_hidden=show_hidden)
    return write.github_output(write.results(single(seen), show_hidden=show_hidden))


SYSTEM = System(
    name="github_classroom",
    title="GitHub Classroom",
    priority=1,
    download=Download("clones of GitHub Classroom's repositories", read),
    usernames=True,
    keeps_modes=True,
    roster=RosterForm(key=_roster_key, is_identity=True),
    reports={"github": _github},
)
