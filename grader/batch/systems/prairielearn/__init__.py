"""PrairieLearn: its results.json."""

from __future__ import annotations

from grader.batch.points import single
from grader.batch.systems.prairielearn import write
from grader.batch.systems.system import System
from grader.report.feedback import handed_back
from grader.report.model import Report


def _results(report: Report, show_hidden: bool) -> str:
    seen = handed_back(report, show_hidden=show_hidden)
    return write.results_json(write.results(single(seen), show_hidden=show_hidden))


SYSTEM = System(name="prairielearn", title="PrairieLearn", reports={"prairielearn": _results})
