"""The evidence of a report: the file beside it, or that in the ledger of its class."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from grader.base.errors import UsageError
from grader.batch.ledger import Ledger
from grader.batch.override import LEDGER
from grader.report.files import EVIDENCE, REPORT, SIGNATURE, read_report
from grader.report.model import Report


@dataclass(frozen=True)
class FoundEvidence:
    """A report and its evidence.

    `report_file` is the report's file; `signature` is None if there is none. Of evidence from a
    ledger, `ledger` is that file: its chain holds the signature.
    """

    report: Report
    report_file: Path
    content: bytes
    signature: bytes | None = None
    ledger: Path | None = None


def find_evidence(path: Path, *, ledger: Path | None = None) -> FoundEvidence:
    """Return the evidence of a report; `path` is report.json or its folder.

    `ledger` is that of the report's class (default: the one in the class' folder). Raises
    UsageError if the report or its evidence is missing or cannot be read.
    """
    file = path / REPORT if path.is_dir() else path
    report = read_report(file)
    content = _read(file.with_name(EVIDENCE))
    if content is not None and ledger is None:
        return FoundEvidence(report, file, content, _read(file.with_name(SIGNATURE)))
    place = ledger or _ledger_above(file)
    if place is None:
        raise UsageError(
            f"there is no {EVIDENCE} beside {file}, and no ledger in the folders above",
            remedy="Name the ledger of the class with --ledger. Graders before 0.2 kept no evidence.",
        )
    with Ledger(place, makes=False) as opened:
        try:
            found = opened.evidence(opened.verdict_of_report(report))
        except KeyError:
            raise UsageError(
                f"the ledger {place} has no verdict with this report: {file}",
                remedy="The report was changed, or it is of another class.",
            ) from None
    if not found:
        raise UsageError(
            f"the ledger {place} has no evidence of this report: {file}",
            remedy="It was marked by an older grader. To mark it again: grader grade-all --regrade.",
        )
    return FoundEvidence(report, file, found, ledger=place)


def _ledger_above(file: Path) -> Path | None:
    """Return the ledger of the class folder that a report is in: `<out>/<student>/<distro>/`."""
    place = file.resolve().parent.parent.parent / LEDGER
    return place if place.is_file() else None


def _read(file: Path) -> bytes | None:
    try:
        return file.read_bytes()
    except FileNotFoundError:
        return None
    except OSError as error:
        raise UsageError(f"{file} cannot be read: {error.strerror}") from None
