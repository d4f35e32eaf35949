"""Gradescope: its export, its results.json and the autograder archive for it."""

# the modules are imported when needed: --help must not pay for them
# ruff: noqa: PLC0415

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from grader.batch.systems.system import Reader, RosterForm, RosterKey, System

if TYPE_CHECKING:
    from grader.batch.sheet import Sheet
    from grader.report.model import Report


def _reader() -> Reader:
    from grader.batch.systems.gradescope import read

    return read


def _roster_key(_sheet: Sheet, header: Sequence[str]) -> RosterKey | None:
    return RosterKey(None) if "sid" in header and "email" in header else None


def _results(report: Report, _show_hidden: bool) -> str:
    """Return results.json; Gradescope itself hides what students must not see."""
    from grader.batch.systems.gradescope import write

    return write.results_json(write.results(report))


SYSTEM = System(
    name="gradescope",
    title="Gradescope",
    priority=4,
    download="Gradescope's export",
    reader=_reader,
    roster=RosterForm(key=_roster_key),
    reports={"gradescope": _results},
)
