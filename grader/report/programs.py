"""Which program of which run a check is about: its command and what it printed."""

from __future__ import annotations

from collections.abc import Iterator

from grader.report.model import CheckResult, Report, RunInfo, Transcript


def command_for(check: CheckResult | None, report: Report) -> str:
    """Return the command that started the check's node in its run, else the first of the report.

    "" if nothing was started.
    """
    if check is None or not check.node:
        return report.observed.command
    commands = [
        command
        for run in report.runs
        if check.run in ("", run.name)
        for node, command in _commands(run)
        if node == check.node
    ]
    return commands[0] if commands else report.observed.command


def _commands(run: RunInfo) -> Iterator[tuple[str, str]]:
    yield run.node, run.observed.command
    for other in run.others:
        yield other.node, other.command


def transcript_for(check: CheckResult, report: Report) -> Transcript | None:
    """Return what the check's own program printed; None if the report has it of no single program."""
    for one in report.evidence.programs if check.node else ():
        if one.node == check.node and check.run in ("", one.run):
            return one
    return None
