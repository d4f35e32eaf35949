"""What a student would read about a mutant: the report with no more than the feedback allows."""

from __future__ import annotations

from grader.report.feedback import handed_back, with_rules, without_hidden
from grader.report.model import Report
from grader.validate.matrix import MutantResult

AUTOMATIC = "(made by validate)"


def as_student_reads(row: MutantResult, feedback: str) -> Report | None:
    """Return a mutant's report as it would be handed back, None if the mutant was not marked.

    `feedback` is a word of `grader.report.detail.WORDS`, or `AS_POLICY`. The submission's name is
    the mutant's, and its path is where the mutant is described.
    """
    if row.marked.report is None:
        return None
    report = without_hidden(handed_back(with_rules(row.marked.report, feedback)))
    update = {
        "name": row.mutant.name,
        "student_id": None,
        "path": row.mutant.where or AUTOMATIC,
    }
    who = report.submission.model_copy(update=update)
    return report.model_copy(update={"submission": who})


def heading(row: MutantResult) -> str:
    """Return the line above a mutant's report: its name, and what is expected of it."""
    mutant = row.mutant
    if mutant.equivalent:
        return f"== {mutant.name}: every check must pass ({mutant.equivalent})"
    where = " or ".join(mutant.families)
    return f"== {mutant.name}: {where} must fail" + (
        f", first with {mutant.mistake}" if mutant.mistake else ""
    )
