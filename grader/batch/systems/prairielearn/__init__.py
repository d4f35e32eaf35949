"""PrairieLearn: its results.json."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grader.batch.systems.system import System

if TYPE_CHECKING:
    from grader.report.model import Report


def _results(report: Report, show_hidden: bool) -> str:
    from grader.batch.points import single  # noqa: PLC0415 - --help must not pay for it
    from grader.batch.systems.prairielearn import write  # noqa: PLC0415

    return write.results_json(write.results(single(report), show_hidden=show_hidden))


SYSTEM = System(name="prairielearn", title="PrairieLearn", reports={"prairielearn": _results})
