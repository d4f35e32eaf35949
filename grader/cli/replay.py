"""The command that judges a report's evidence again."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from grader.cli import options


@click.command("replay")
@click.argument("path", metavar="REPORT", type=click.Path(path_type=Path, exists=True))
@options.assignment
@options.keys
@options.ledger
@options.whole
@options.verbose
def replay(
    path: Path,
    assignment: str | None,
    keys: Path | None,
    ledger: Path | None,
    whole: bool,
    verbose: bool,
) -> int:
    """Judge a report's evidence again, without running anything, and compare the verdicts.

    REPORT is a report.json or its folder. The checks, diagnosis and fixes of this grader look at
    the recorded build and run. With --assignment they use that assignment's points and texts. --all
    and --verbose print the new report too.

    Exit status: 0 the same verdict, 1 another one, 2 the evidence cannot be read.
    """
    import grader  # noqa: PLC0415 - keeps --help fast
    from grader.batch.find_evidence import find_evidence  # noqa: PLC0415
    from grader.report import terminal  # noqa: PLC0415
    from grader.verdict.checks.all import QUOTES  # noqa: PLC0415
    from grader.verdict.evidence_file import EvidenceFile, differences  # noqa: PLC0415
    from grader.verdict.mark import replay as judge_again  # noqa: PLC0415
    from grader.verdict.order import load_with_hidden  # noqa: PLC0415
    from grader.verdict.own_checks import read_own_checks  # noqa: PLC0415

    found = find_evidence(path, ledger=ledger)
    evidence = EvidenceFile.from_bytes(found.content)
    wanted = evidence.assignment if assignment is None else load_with_hidden(assignment, keys)
    if assignment is None and keys is not None:
        wanted = wanted.model_copy(update={"own_checks": read_own_checks(keys)})
    again = judge_again(
        evidence.recording,
        evidence.taken_in(),
        wanted,
        lang=evidence.lang,
        student_id=found.report.submission.student_id or "",
    )
    if whole or verbose:
        terminal.print_report(
            again, quotes=QUOTES, file=sys.stdout, verbose=verbose, show_hidden=True, path=None
        )
    changes = list(differences(evidence, again))
    before, now = evidence.recording.environment.grader, grader.__version__
    if before != now:
        click.echo(f"marked by grader {before}, judged again by {now}")
    if not changes:
        click.echo(
            f"the same verdict: {again.score:g} of {again.max_score:g}, {len(again.checks)} checks"
        )
        return 0
    click.echo(f"another verdict: {found.report.score:g} -> {again.score:g}")
    for line in changes:
        click.echo(f"  {line}")
    return 1
