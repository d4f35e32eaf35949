"""Checks that a report, or a ledger, is what the grader wrote: `grader verify`."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from grader.base.errors import GraderError
from grader.base.shown import shown
from grader.base.signing import PublicKey
from grader.batch.find_evidence import FoundEvidence
from grader.batch.ledger import Ledger
from grader.batch.ledger_file import PlantedInError
from grader.verdict.evidence_file import EvidenceFile, changed_files, differences, is_as_written
from grader.verdict.take_in import take_in_for


@dataclass
class Findings:
    """Lines of a name and what was found, and what is wrong; nothing is wrong if `faults` is empty."""

    lines: list[tuple[str, str]] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)

    def say(self, name: str, text: str, *, wrong: bool = False) -> None:
        """Add a line, and a fault if it is wrong."""
        self.lines.append((name, text))
        if wrong:
            self.faults.append(text)


def verify_report(found: FoundEvidence, key: PublicKey | None, submission: Path | None) -> Findings:
    """Compare a report, its evidence, their signature and, if it is given, the submission."""
    findings = Findings()
    evidence = EvidenceFile.from_bytes(found.content)
    if found.ledger is None:
        _verify_signature(findings, found, key)
    else:
        findings.say("signature", f"that of the ledger: grader verify {found.ledger}")
    digest = hashlib.sha256(found.report_file.read_bytes()).hexdigest()
    changes = list(differences(evidence, found.report))
    if found.ledger is not None:  # the ledger has exactly this report
        findings.say("report", f"as in {found.ledger}")
    elif digest != evidence.report or changes:
        findings.say("report", "changed since the evidence was written", wrong=True)
        for change in changes:
            findings.say("", change)
    else:
        findings.say("report", "as it was written")
    _verify_digest(findings, found.content)
    marked = evidence.taken_in()
    if marked.sha256 != evidence.recording.submission:
        findings.say(
            "evidence", "its submission and its recording do not belong together", wrong=True
        )
    if submission is None:
        findings.say("submission", "not compared (--submission PATH compares it)")
        return findings
    given = take_in_for(evidence.assignment, submission, modes_kept=marked.modes == "recorded")
    if given.sha256 == marked.sha256:
        findings.say("submission", "the one that was marked")
    else:
        names = ", ".join(changed_files(marked, given)[:10]) or "other copies beside the package"
        findings.say("submission", f"not the one that was marked: {names}", wrong=True)
    return findings


def _verify_digest(findings: Findings, content: bytes) -> None:
    agrees = is_as_written(content)
    if agrees is None:
        findings.say("evidence", "not compared: an earlier grader wrote no hash of it")
    elif agrees:
        findings.say("evidence", "as it was written")
    else:
        findings.say("evidence", "changed since it was written", wrong=True)


def _verify_signature(findings: Findings, found: FoundEvidence, key: PublicKey | None) -> None:
    if found.signature is None:
        text = "none" if key is not None else "none (grader keygen makes a key for later verdicts)"
        findings.say("signature", text, wrong=key is not None)
    elif key is None:
        findings.say("signature", "not checked: give the public key with --key", wrong=True)
    elif key.verifies(found.signature, found.content):
        findings.say("signature", f"good, by {key.fingerprint}")
    else:
        text = f"wrong: evidence.json was changed, or {key.fingerprint} did not sign it"
        findings.say("signature", text, wrong=True)


def verify_ledger(
    path: Path,
    key: PublicKey | None,
    head: str,
    *,
    progress: Callable[[int, int], None] = lambda _done, _of: None,
) -> Findings:
    """Check the chain of a ledger, its signatures, and that each verdict agrees with its evidence.

    `head` is a hash that was noted earlier: it must be in the chain. `progress` is called with the
    number of verdicts that were compared, and of all.
    """
    findings = Findings()
    try:
        ledger = Ledger(path, makes=False)
    except PlantedInError as error:
        findings.say("ledger", error.message, wrong=True)
        return findings
    with ledger:
        chain = ledger.check_chain(key)
        verdicts, counts = ledger.verdict_ids(), ledger.counts()
        count = chain.head.count
        rest = sum(counts.values()) - counts["verdict"] - counts["override"]
        numbers = [
            _counted(counts["verdict"], "verdict"),
            _counted(counts["override"], "correction"),
            _counted(rest, "other row"),
        ]
        if chain.removed:
            numbers.append(f"{chain.removed} removed")
        findings.say("ledger", f"{path}: {', '.join(numbers)}")
        findings.say("head", shown(chain.head.hash))
        for fault in chain.faults:
            findings.say("chain", fault, wrong=True)
        if not chain.faults:
            findings.say("chain", "unbroken")
        if head and head not in chain.hashes:
            text = f"{head} is not in the chain: rows were removed at its end, or it was made anew"
            findings.say("head", text, wrong=True)
        by = f", checked with {key.fingerprint}" if key is not None else ", not checked"
        findings.say("signatures", f"{chain.signed} of {count}{by if chain.signed or key else ''}")
        _verify_evidence(findings, ledger, verdicts, progress)
    return findings


def _counted(count: int, what: str) -> str:
    return f"{count} {what}" if count == 1 else f"{count} {what}s"


def _verify_evidence(
    findings: Findings,
    ledger: Ledger,
    verdicts: list[int],
    progress: Callable[[int, int], None],
) -> None:
    agree, without = 0, 0
    for number, verdict in enumerate(verdicts, start=1):
        progress(number, len(verdicts))
        fault = ""
        try:
            content = ledger.evidence(verdict)
            if not content:
                without += 1
                continue
            evidence = EvidenceFile.from_bytes(content)
            changes = list(differences(evidence, ledger.report(verdict)))
            fault = f"its report differs: {'; '.join(changes)}" if changes else ""
        except GraderError as error:
            fault = error.message
        if fault:
            findings.say("evidence", f"verdict {verdict}: {fault}", wrong=True)
        else:
            agree += 1
    missing = f", {without} have none" if without else ""
    findings.say("evidence", f"{agree} of {len(verdicts)} verdicts agree with theirs{missing}")
