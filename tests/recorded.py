"""Verdicts from recorded evidence: real checks, diagnosis, fixes and report, without a build or a run.

`mark` finds the recording of exactly this submission and replays it (about 15 ms). The variable
GRADER_TESTS_EVIDENCE chooses otherwise: `record` marks for real and writes the recording
(`make recordings`), `real` marks for real and compares with the recording (`make test-long`).
"""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

from grader.base.unheard import unheard
from grader.course.assignment import Assignment
from grader.package.submission import Submission
from grader.report.events import Listener
from grader.report.model import Report
from grader.sandbox.limits import Limits
from grader.verdict.evidence_file import Judged
from grader.verdict.mark import Keep, replay
from grader.verdict.mark import mark as mark_for_real
from grader.verdict.order import Order
from grader.verdict.recording import Recording
from tests import filled, marking, processes

FOLDER = processes.ROOT / "tests" / "recordings" / "evidence"
MODES = ("replay", "record", "real")
MODE = os.environ.get("GRADER_TESTS_EVIDENCE", "replay")
assert MODE in MODES, f"GRADER_TESTS_EVIDENCE is one of {MODES}"


def mark(
    path: Path,
    *,
    assignment: Assignment = marking.ASSIGNMENT,
    listener: Listener = unheard,
    lang: str = "en",
) -> Report:
    """Return the report of a package, by default from its recording."""
    order = marking.order(path, assignment=assignment, lang=lang)
    return mark_submission(marking.taken_in(path, assignment), order, listener)


def mark_submission(
    submission: Submission,
    order: Order,
    listener: Listener = unheard,
    *,
    keep: Keep | None = None,
    **_: object,
) -> Report:
    """Return the report of a submission, with the arguments of `grader.verdict.mark.mark`."""
    file = file_of(submission)
    if MODE == "record":
        if not file.exists():
            _record(submission, order, file)
    elif not file.exists():
        raise AssertionError(f"there is no recording of {submission.name}: run make recordings")
    recording = Recording.from_bytes(file.read_bytes(), name=str(file))
    report = replay(
        recording,
        submission,
        order.assignment,
        listener,
        lang=order.lang,
        student_id=order.student_id,
    )
    assert filled.unfilled(report) == []
    if keep is not None:
        keep(Judged(submission, recording))
    if MODE == "real":
        real = marking.outcomes(mark_for_real(submission, order, unheard))
        assert real == marking.outcomes(report), f"{file.name} is not what happens now"
    return report


def file_of(submission: Submission) -> Path:
    """Return the file of a submission's recording: it is named by the submission's content."""
    return FOLDER / f"{submission.sha256[:24]}.json"


def _record(submission: Submission, order: Order, file: Path) -> None:
    kept: list[Judged] = []
    # the default limits: a busy machine must not reach them
    mark_for_real(submission, replace(order, limits=Limits()), unheard, keep=kept.append)
    file.parent.mkdir(parents=True, exist_ok=True)
    part = file.with_suffix(f".{os.getpid()}")
    part.write_bytes(kept[0].recording.to_bytes())
    part.replace(file)
