"""Clones of students' repositories: GitHub Classroom's (retired in 2026), and Classroom 50's."""

from __future__ import annotations

from collections.abc import Sequence

from grader.base.i18n.message import say
from grader.batch.sheet import Sheet
from grader.batch.systems.github_classroom import read
from grader.batch.systems.system import Download, RosterForm, RosterKey, System


def _roster_key(_sheet: Sheet, header: Sequence[str]) -> RosterKey | None:
    for name in ("identifier", "roster identifier"):  # in the roster, and in the grades
        if name in header and "github username" in header:
            return RosterKey(header.index(name))
    return None


SYSTEM = System(
    name="github_classroom",
    title="GitHub Classroom",
    priority=1,
    download=Download(say("clones of Classroom 50's or GitHub Classroom's repositories"), read),
    usernames=True,
    keeps_modes=True,
    roster=RosterForm(key=_roster_key, is_identity=True),
)
