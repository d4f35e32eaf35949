"""The command that checks a report, or a ledger, against its evidence and signatures."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.cli import options

if TYPE_CHECKING:
    from grader.base.signing import PublicKey
    from grader.batch.verify import Findings

SQLITE = b"SQLite format 3\0"


@click.command("verify")
@click.argument("path", type=click.Path(path_type=Path, exists=True))
@click.option(
    "--key",
    "public_key",
    type=options.GivenFile(),
    help="The public key of whoever signed (default: that of this installation).",
)
@click.option(
    "--submission",
    type=click.Path(path_type=Path, exists=True),
    help="The submission, to see whether it is the one that was marked.",
)
@click.option("--head", default="", metavar="HASH", help="A ledger's head that was noted earlier.")
@options.ledger
def verify(
    path: Path, public_key: Path | None, submission: Path | None, head: str, ledger: Path | None
) -> int:
    """Check that PATH (a report.json, its folder, or a ledger) is what the grader wrote.

    A report is compared with its evidence, the evidence with its own hash and its signature. Of a
    ledger, every row is checked: nothing was changed, removed or inserted.

    Exit status: 0 all agrees, 1 something does not, 2 it cannot be read.
    """
    from grader.base.signing import own_key, read_public_key  # noqa: PLC0415 - keeps --help fast
    from grader.batch.find_evidence import find_evidence  # noqa: PLC0415
    from grader.batch.verify import verify_ledger, verify_report  # noqa: PLC0415

    key: PublicKey | None = None
    if public_key is not None:
        key = read_public_key(public_key)
    else:
        own = own_key()
        key = own.public if own is not None else None
    if _is_ledger(path):
        findings = verify_ledger(path, key, head, progress=_progress)
    else:
        findings = verify_report(find_evidence(path, ledger=ledger), key, submission)
    _print(findings)
    return 1 if findings.faults else 0


def _is_ledger(path: Path) -> bool:
    if not path.is_file():
        return False
    with path.open("rb") as file:
        return file.read(len(SQLITE)) == SQLITE


def _progress(done: int, of: int) -> None:
    if sys.stderr.isatty():
        click.echo(f"\r{done} of {of} verdicts compared", nl=done == of, err=True)


def _print(findings: Findings) -> None:
    width = max(len(name) for name, _ in findings.lines)
    for name, text in findings.lines:
        click.echo(f"{name:<{width}}  {text}")
    if findings.faults:
        click.echo(f"\n{len(findings.faults)} of these should not be so.", err=True)
