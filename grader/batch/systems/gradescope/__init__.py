"""Gradescope: its export, its results.json and the autograder archive for it."""

from __future__ import annotations

from collections.abc import Sequence

from grader.base.i18n.message import say
from grader.batch.sheet import Sheet
from grader.batch.systems.gradescope import read, write
from grader.batch.systems.system import Download, RosterForm, RosterKey, System
from grader.report.model import Report


def _roster_key(_sheet: Sheet, header: Sequence[str]) -> RosterKey | None:
    return RosterKey(None) if "sid" in header and "email" in header else None


def _results(report: Report, _show_hidden: bool) -> str:
    """Return results.json; Gradescope itself hides what students must not see."""
    return write.results_json(write.results(report))


SYSTEM = System(
    name="gradescope",
    title="Gradescope",
    priority=4,
    download=Download(say("Gradescope's export"), read),
    roster=RosterForm(key=_roster_key),
    reports={"gradescope": _results},
)
